// One pass over a picture's tiles: camera rays or given triangles, shadow rays, mirrored and refracted rays
// and the composite, each where it is wanted, while the tile's rays are in the cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>

#include "core/trace/passes.h"
#include "core/trace/ray_queue.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"

namespace pinocchio {

// Rays that are about to be traced together.
struct RayBatch {
  RayColumns rays;
  std::size_t count;
  int generation;  // 0: the camera's, and the shadow rays of what they see
  bool shadow;
};

// What is wanted; null: not.
struct TileOutputs {
  glm::ivec2 size{0};  // of the samples, and of all outputs

  // The triangle that each pixel sees (kNoTriangle: none), where that is known; else camera rays tell. Of
  // every scale-th pixel, across and down, there is a sample; scale is a power of two.
  const Image<std::uint32_t>* seen = nullptr;
  int scale = 1;

  Image<std::uint32_t>* ids = nullptr;  // what the camera rays tell

  // Bit i of a sample: the casting light in mask slot i reaches the visible point. 0 where nothing is seen or
  // the surface faces away, or the light brings less than job.options.light_cutoff. mask_bits: 1, 2, 4 or 8,
  // no fewer than lights that cast; 0: the visible points are asked nothing, and no light that casts reaches
  // them.
  int mask_bits = 0;
  MaskImage* mask = nullptr;

  // Mirrored plus refracted light of every sample, linear, without the direct light of the visible point;
  // `depth` generations at most.
  int depth = 0;
  Image<glm::vec3>* reflection = nullptr;
  // The same holds what the scene's environment lights, and light from other matt surfaces, `indirect`
  // bounces of it at most: one sample of each.
  bool environment_light = false;
  int indirect = 0;

  // The composite: Phong of every light that reaches the point, plus reflection. RGBA, linear; A is 1 where
  // something is hit.
  Image<glm::vec4>* color = nullptr;
  // The part of it that rays decide (lights that cast, reflection), added to what the image holds.
  Image<glm::vec3>* added = nullptr;

  // Told of every batch, by all threads.
  std::function<void(const RayBatch&)> on_rays;
};

// Seconds of all threads together.
struct TileTimes {
  double primary = 0.0, shadow = 0.0, reflection = 0.0, composite = 0.0;

  TileTimes& operator+=(const TileTimes& o) {
    primary += o.primary;
    shadow += o.shadow;
    reflection += o.reflection;
    composite += o.composite;
    return *this;
  }
  [[nodiscard]] double sum() const { return primary + shadow + reflection + composite; }
};

struct TileResult {
  RayCounts rays;
  TileTimes times;
};

// Images are resized to outputs.size, `added` must have it. The same bits for any width of lanes and any
// number of threads.
TileResult trace_tiles(const TraceJob& job, const TileOutputs& outputs);

}  // namespace pinocchio
