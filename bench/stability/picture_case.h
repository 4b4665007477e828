// The stability suite's pictures: cases where GPU and CPU see different triangles, and where the camera moves
// faster than the CPU can follow. Every scene is closed and has ambient light, so that no pixel
// may be black.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/stability/stress_case.h"
#include "pinocchio/engine.h"

namespace pinocchio::stability {

// A way to split a frame between GPU and CPU.
struct DrawMethod {
  std::string name;
  Processor composite = Processor::gpu;
  Exchange exchange = Exchange::sync;
};
// The default first.
[[nodiscard]] std::vector<DrawMethod> all_draw_methods();

// Trials are pixels. Seconds are those of the whole drawing.
struct PictureFailureCount : FailureCount {
  std::uint64_t other_ids = 0;  // pixels where the rasteriser and the ray see different triangles
  double worst_there = 0.0;     // the largest difference of such a pixel to the ray traced picture, linear
  double mean_error = 0.0;      // of all pixels to the ray traced picture of the same camera, linear
  std::uint64_t holes = 0;      // reprojected: pixels without a value in any older frame
};

struct PictureStressCase {
  std::string_view name;
  // side: pixels of a square picture.
  PictureFailureCount (*run)(Engine& engine, const DrawMethod& method, int side);
  std::string_view failure = "black or NaN pixels";
};

// Grazing and sub-pixel triangles, near-plane clipping, leaves with holes, z-fighting planes; a fast
// rotation, a cut, object edges.
[[nodiscard]] std::span<const PictureStressCase> picture_cases();

}  // namespace pinocchio::stability
