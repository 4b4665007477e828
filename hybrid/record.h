#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/trace/passes.h"

namespace pinocchio {

// The stages of a frame, in the order a frame goes through them; names as in the figures.
enum class Stage { raster, readback, trace_shadow, trace_reflection, upload, composite, present };
inline constexpr std::array<std::string_view, 7> kStageNames{"raster", "readback",  "trace_shadow", "trace_reflection",
                                                             "upload", "composite", "present"};

// What one frame cost.
struct FrameRecord {
  std::array<double, kStageNames.size()> stage_ms{};  // 0: the plan has no such stage
  double frame_ms = 0.0;                              // camera sampled to picture delivered
  std::size_t id_bytes = 0;                           // GPU to CPU
  std::size_t mask_bytes = 0, reflection_bytes = 0;   // CPU to GPU
  RayCounts rays;

  [[nodiscard]] double& operator[](Stage stage) { return stage_ms[static_cast<std::size_t>(stage)]; }
};

// Adds the time until it goes out of scope to one stage.
class StageTimer {
 public:
  StageTimer(FrameRecord& record, Stage stage) : milliseconds_(record[stage]) {}
  ~StageTimer() {
    milliseconds_ += std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  double& milliseconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace pinocchio
