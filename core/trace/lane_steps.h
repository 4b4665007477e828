// The steps of a tile (trace/tile_tracer.h) that are computed in lanes: trace/lanes/ compiled once an
// instruction set, like the kernels. Scalar is the one that the others are tested against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "core/parallel/tiles.h"
#include "core/trace/lane_texture.h"
#include "core/trace/map_lanes.h"
#include "core/trace/ray_queue.h"
#include "core/trace/shared.h"
#include "core/trace/trace_options.h"
#include "pinocchio/ray_offset.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A pixel's number within its tile: row by row.
inline constexpr int kTileBits = 5;
static_assert(1 << kTileBits == TileGrid::kTileSize);

class EnvironmentLight;

// The scene's arrays as the lanes read them.
struct SceneArrays {
  const glm::vec3 *positions, *normals;
  const glm::uvec3* triangles;
  const std::uint32_t* triangle_materials;
  const Material* materials;
  const Mesh* mesh;  // of materials with maps (trace/map_lanes.h); null: there are none

  [[nodiscard]] static SceneArrays of(const Mesh& mesh);
};

struct BounceLight {
  shared::LightParams params;
  int slot;  // of the mask, and of its shadow queue; -1: casts no shadow
  bool has_size;
  std::uint32_t index;  // in the scene
};

// What happens where rays meet triangles.
struct Bounce {
  SceneArrays scene{};
  RayOffset offset{};
  const TraceOptions* options = nullptr;
  const Footprint* footprint = nullptr;  // of the rays, for textures
  const BounceLight* lights = nullptr;
  std::size_t light_count = 0;
  glm::vec3 ambient_light{0.0f};
  bool visible = false;       // the rays are the camera's
  bool adds_ambient = false;  // and emission
  bool attenuates = false;    // some material takes light that goes through it
  bool adds_light = false;    // lights that cast none add theirs to `radiance`, shadow rays carry it
  // Whether anything is sampled, and where: the whole picture's pixel that is (0, 0) in the queues, the
  // distance of the picture's samples in pixels, and the first dimension of the rays' generation.
  bool samples = false;
  glm::uvec2 corner{0};
  std::uint32_t scale = 1, dimension = 0;
  const EnvironmentLight* environment = nullptr;  // that lights the points; null: none does

  // Where it goes. Queues have room for all rays of the step; null: not wanted.
  RayQueue* shadow = nullptr;  // one a slot
  // Likewise: to where lifted shadow rays start; their `pixel` is that ray's place in its queue.
  RayQueue* ways_up = nullptr;
  RayQueue *sky = nullptr, *sky_ways_up = nullptr;  // of the environment, likewise
  RayQueue *mirrored = nullptr, *refracted = nullptr, *straight = nullptr;
  RayQueue* diffuse = nullptr;  // that look for light from other surfaces
  float* radiance = nullptr;    // RGBA of a tile's pixels
};

// What rays see, a column each, with room behind the last ray for a packet; null: not wanted.
struct SeenColumns {
  float* depth = nullptr;  // along an axis
  float *position[3] = {}, *normal[3] = {};
  float* albedo[3] = {};
};

struct LaneSteps {
  // Directions and origins of the rays of the tile at `corner`; their pixels are set.
  void (*camera_rays)(const shared::ViewParams& view, glm::ivec2 corner, RayQueue& rays);
  // Drops the rays whose triangle is kNoTriangle; the others stay in order.
  void (*keep_hits)(RayQueue& rays);
  // Appends to the bounce's queues. All rays have hit.
  void (*bounce)(const Bounce& bounce, const RayQueue& rays);
  // What the camera's rays see. All have hit. Of the bounce: the scene and the rays' footprint.
  void (*see)(const Bounce& bounce, const glm::vec3& axis, const RayQueue& rays, const SeenColumns& to);
  // Points 0 to count - 1 of `dimension`, of the pixels (x, y); for tests. count: a multiple of 16.
  void (*samples)(const shared::Sampling& of, const std::uint32_t* x, const std::uint32_t* y,
                  std::uint32_t dimension, float* u, float* v, std::size_t count);
  // x^y for x > 0, of `count` pairs, a multiple of 16; for tests.
  void (*power)(const float* x, const float* y, float* result, std::size_t count);
  SampleTexture sample_texture;  // for tests
};

enum class Isa;  // pinocchio/tracer.h
// The processor has them.
[[nodiscard]] const LaneSteps& lane_steps(Isa isa);

namespace scalar {
extern const LaneSteps kSteps;
}
namespace sse4 {
extern const LaneSteps kSteps;
}
namespace avx2 {
extern const LaneSteps kSteps;
}
namespace avx512 {
extern const LaneSteps kSteps;
}

}  // namespace pinocchio
