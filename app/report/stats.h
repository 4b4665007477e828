#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <vector>

#include "gl/context/context.h"
#include "pinocchio/frame.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio::app {

// {"p50", "p95", "p99"} by nearest rank; zeros where there are no values.
[[nodiscard]] nlohmann::json percentiles(std::vector<double> values);

// CPU, cores, SIMD level (`used`), OpenGL and versions. context: null where none was opened.
[[nodiscard]] nlohmann::json system_json(const gl::ContextInfo* context, Isa used = default_isa());

// The figures of a run (--stats-json): times in milliseconds, sizes in bytes, per frame. size: the pictures',
// in pixels.
[[nodiscard]] nlohmann::json figures(std::span<const FrameRecord> records, const Settings& settings,
                                     const Scene& scene, glm::ivec2 size, const gl::ContextInfo* context);

}  // namespace pinocchio::app
