// One pass over a picture's tiles: camera rays or given triangles, shadow rays, mirrored and refracted rays,
// and the composite, each if it is wanted, while the tile's rays are in the cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "core/denoise/sampled_point.h"
#include "core/parallel/workers.h"
#include "core/shade/shared.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/rays/trace_options.h"
#include "pinocchio/image.h"
#include "pinocchio/mask_image.h"
#include "pinocchio/progress.h"
#include "pinocchio/ray_counts.h"
#include "pinocchio/scene.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

class RayModel;

// The pass's input: the scene, its tree, the threads and the picture's rays.
struct TraceJob {
  const Scene& scene;  // its mesh is the tracer's
  const Tracer& tracer;
  Workers& workers;
  shared::ViewParams view;
  TraceOptions options{};
  const RayModel* model = nullptr;  // makes the camera's rays; null: `view` does
  // Tiles (TileGrid's) that are not traced where it is not 0; null: all are.
  const std::vector<std::uint8_t>* left_out = nullptr;
  // Advances with each tile; all tiles together are progress_steps.
  Progress* progress = nullptr;
  double progress_steps = 1.0;
};

// Rays that are traced together.
struct RayBatch {
  RayColumns rays;
  std::size_t count;
  int generation;  // 0: the camera's, and the shadow rays of what they see
  bool shadow;
};

// The wanted outputs; null: not wanted.
struct TileOutputs {
  glm::ivec2 size{0};  // of the samples, and of all outputs

  // Input: the visible triangle of each pixel (kNoTriangle: none); null: camera rays find it. Every scale-th
  // pixel, across and down, has a sample; scale is a power of two.
  const Image<std::uint32_t>* seen = nullptr;
  int scale = 1;

  Image<std::uint32_t>* ids = nullptr;  // the triangles that camera rays find

  // Bit i of a sample: the casting light in mask slot i reaches the visible point. 0 where nothing is seen,
  // the surface faces away, or the light brings less than job.options.light_cutoff. mask_bits: of a
  // MaskImage, at least the number of casting lights; 0: visible points fire no shadow rays, and casting
  // lights do not reach them.
  int mask_bits = 0;
  MaskImage* mask = nullptr;

  // Mirrored plus refracted light of every sample, linear, without the direct light of the visible point;
  // `depth` generations at most, and kStraightBeyond more of rays that only go straight on.
  int depth = 0;
  Image<glm::vec3>* reflection = nullptr;
  // For each tile (TileGrid's) of `reflection`, 1 if it is black, else 0. Kept beside the image from frame to
  // frame, so that what is black is not written again. Clear it after any other change of the image.
  std::vector<std::uint8_t>* black_tiles = nullptr;
  // Also in `reflection`: one sample of the environment's light, and one of light from other matt surfaces,
  // with at most `indirect` bounces.
  bool environment_light = false;
  int indirect = 0;
  // Also in `reflection`, whatever mask_bits is: the light at visible points of the casting lights in slots
  // from this one on, a multiple of 8.
  int first_added_slot = std::numeric_limits<int>::max();
  // In `reflection`, a pixel that sees nothing has the share of light that the shadow catcher lost there, in
  // all three colours.
  bool caught_in_reflection = false;

  // The composite: the reflection model's light of every light that reaches the point, plus reflection. RGBA,
  // linear; A is 1 where something is hit, and behind that job.options' background is drawn, whose A is 0, or
  // the share of light that the shadow catcher lost. With `coverage`, A is less where all that is hit blends:
  // the share of light from behind that is held back.
  Image<glm::vec4>* color = nullptr;
  bool coverage = false;
  // The part of the composite that rays decide (casting lights, reflection) is added to this image.
  Image<glm::vec3>* added = nullptr;
  // The light that is found at random: of lights with a size, the environment, rough mirrors and other
  // surfaces. It is in none of the images above then. Null: it is in them. beyond: with `sampled`, such light
  // of what is seen in sharp mirrors and through glass, apart as well; empty where no material shows any.
  Image<SampledPoint>*sampled = nullptr, *beyond = nullptr;

  // Called with every batch, from all threads. The product leaves it empty, which costs a branch a batch;
  // bench hands the rays to its peers, and tests look at their directions.
  std::function<void(const RayBatch&)> on_rays;
};

// Seconds, summed over all threads.
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

// Resizes the images to outputs.size; `added` must have that size. The same bits for any lane width and any
// number of threads.
TileResult trace_tiles(const TraceJob& job, const TileOutputs& outputs);

}  // namespace pinocchio
