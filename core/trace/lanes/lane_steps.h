// The steps of a tile (tiles/tile_tracer.h) that are computed in lanes: trace/lanes/, compiled once for each
// instruction set, like the kernels. The others are tested against the scalar one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <tuple>

#include "core/parallel/tiles.h"
#include "core/shade/footprint.h"
#include "core/shade/lane_maps.h"
#include "core/shade/shared.h"
#include "core/trace/rays/passed_surfaces.h"
#include "core/trace/rays/ray_queue.h"
#include "core/trace/rays/trace_options.h"
#include "pinocchio/frame_arrays.h"
#include "pinocchio/ray_offset.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A pixel's number within its tile: row by row.
inline constexpr int kTileBits = TileGrid::kTileBits;

// Where light that is found at random is kept apart for the filter (core/denoise), its rays have their
// pixel's number plus this; twice this if the random choice was made at a surface that is seen in a sharp
// mirror or through glass.
inline constexpr std::uint32_t kSampledPixels = 1u << (2 * kTileBits);
// Added to both where the light comes straight from a light with a size: it is filtered by itself.
inline constexpr std::uint32_t kLampPixels = 2 * kSampledPixels;

// Smoother lobes mirror a sharp image, which the filter leaves alone: roughness 0.1, and Phong's exponent for
// it.
inline constexpr float kSharpAlpha = 0.01f, kSharpGloss = 5000.0f;

class ClearWays;
class SettledTriangles;
struct TileRays;
struct EnvironmentLight;
struct SampledPoint;

// The scene's arrays as the lanes read them.
struct SceneArrays {
  const glm::vec3 *positions, *normals;
  const glm::uvec3* triangles;
  const std::uint32_t* triangle_materials;
  const Material* materials;
  // For materials with maps; null: there are none.
  const LaneMaps* maps;
  const glm::vec4 *colors, *tangents;
  bool is_large;  // more than kLargeMesh triangles: they are fetched ahead

  // `maps`: the mesh's.
  [[nodiscard]] static SceneArrays of(const Mesh& mesh, const LaneMapsOf& maps);
};

struct BounceLight {
  shared::LightParams params;
  int slot;   // in the mask; -1: casts no shadow
  int queue;  // its shadow queue's index; -1: casts no shadow
  bool has_size;
  std::uint32_t index;              // in the scene
  ClearWays* clear_ways = nullptr;  // from visible points; null: all shadow rays are to be traced
};

// What a step computes where rays meet triangles.
struct Bounce {
  SceneArrays scene{};
  RayOffset offset{};
  const TraceOptions* options = nullptr;
  const Footprint* footprint = nullptr;  // the rays', for textures
  const BounceLight* lights = nullptr;
  std::size_t light_count = 0;
  glm::vec3 ambient_light{0.0f};
  bool visible = false;                  // the rays are the camera's
  bool adds_ambient = false;             // and emission
  bool attenuates = false;               // some material absorbs light that goes through it
  std::uint32_t eye_medium = kNoMedium;  // the material around the camera
  // Light goes straight on through glass: shadow rays carry it, and the medium that they start in.
  bool tints = false;
  bool light_later = false;  // shadow rays carry none at first; those that pass glass get it afterwards
  bool of_matt = false;      // the rays were sent by matt surfaces, which look for the environment themselves
  bool adds_light = false;   // lights that cast none add theirs to `radiance`, shadow rays carry it
  // Whether anything is sampled; the whole picture's pixel that is (0, 0) in the queues; the distance of the
  // picture's samples in pixels; the first dimension of the rays' generation.
  bool samples = false;
  glm::uvec2 corner{0};
  std::uint32_t scale = 1, dimension = 0;
  const EnvironmentLight* environment = nullptr;  // its samples light the points; null: none do
  bool one_candidate = false;  // of the environment, not kSkyCandidates: for the shadow catcher
  const EnvironmentLight* prefiltered = nullptr;  // its means light the points; null: none do
  bool lobes = false;  // directions of glossy lobes are sampled; else mirrors are sharp

  // Outputs. Queues have room for all rays of the step; null: not wanted.
  RayQueue* shadow = nullptr;  // one for each of the step's casting lights
  RayQueue* clear = nullptr;   // likewise: the pixel and the light of those that need not be traced
  // One for each of them: rays to the origins of lifted shadow rays; their `pixel` is the shadow ray's place
  // in its queue.
  RayQueue* ways_up = nullptr;
  RayQueue *sky = nullptr, *sky_ways_up = nullptr;  // to the environment and distant lights
  RayQueue* lobe_lights = nullptr;                  // from glossy lobes to lights with a size
  RayQueue *mirrored = nullptr, *refracted = nullptr, *straight = nullptr;
  RayQueue* diffuse = nullptr;  // towards light from other surfaces
  float* radiance = nullptr;    // a tile's pixels, RGBA
  float* traced = nullptr;      // RGBA: light of `prefiltered`; from kSampledPixels on, of `sampled`
  // What is added to the pixels of rays that find light at random from here on: kSampledPixels, or twice
  // that; 0: it is not kept apart.
  std::uint32_t sampled = 0;
  SampledPoint* points = nullptr;  // a tile's pixels: the surfaces, for the filter; null: not wanted
  bool lights_alone = false;       // an earlier step had the surfaces of these rays, and other lights

  [[nodiscard, gnu::always_inline]] bool tints_at_once() const { return tints && !light_later; }
  // True if lights that are too faint get no shadow ray.
  [[nodiscard, gnu::always_inline]] bool cuts_light() const {
    return visible && options->light_cutoff > 0.0f;
  }
};

// The points that rays see, a column each, with room behind the last ray for a packet; null: not wanted.
struct SeenColumns {
  float* depth = nullptr;  // along an axis
  float *position[3] = {}, *normal[3] = {};
  float* albedo[3] = {};
};

// A layer of the visible surfaces: its array, its columns, and its value where nothing is hit.
template <class Value, class Columns>
struct SeenLayer {
  Value* FrameArrays::*array;
  Columns SeenColumns::*columns;
  Value nothing;
};
// One row for each member of SeenColumns. tiles/aov.cpp writes them all.
inline constexpr std::tuple kSeenLayers{
    SeenLayer{&FrameArrays::depth, &SeenColumns::depth, kInfinity},
    SeenLayer{&FrameArrays::position, &SeenColumns::position, glm::vec3(0.0f)},
    SeenLayer{&FrameArrays::normal, &SeenColumns::normal, glm::vec3(0.0f)},
    SeenLayer{&FrameArrays::albedo, &SeenColumns::albedo, glm::vec3(0.0f)},
};
inline constexpr std::size_t kSeenColumns = sizeof(SeenColumns) / sizeof(float*);

struct LaneSteps {
  // Sets directions and origins of the rays of the tile at `corner`, whose pixels are set.
  void (*camera_rays)(const shared::ViewParams& view, glm::ivec2 corner, RayQueue& rays);
  // Drops the rays whose triangle is kNoTriangle; the others stay in order.
  void (*keep_hits)(RayQueue& rays);
  // Finds the pixels of a tile that see settled points. Sets their `mask`, which is 0 before, to the bits of
  // the lights that reach the points, and their `ids` to kNoTriangle. Both arrays are row by row. Returns the
  // number of bits that were set.
  std::size_t (*find_settled)(SettledTriangles& settled, const SceneArrays& scene, const TileRays& rays,
                              std::uint32_t* ids, std::uint8_t* mask);
  // Writes 1 for rays that met a point where alpha lets them pass as if nothing were there, else 0.
  void (*find_holes)(const Bounce& bounce, const RayQueue& rays, std::uint32_t* holes);
  // The same for the shadow rays of a packet, within the walk.
  PassedSurfaces::InHoles lanes_in_holes;
  // Moves the rays, which have all hit, behind their triangles. ends: their light stays at t = 1. This
  // and find_holes read the bounce's scene and offset.
  void (*go_behind)(const Bounce& bounce, bool ends, RayQueue& rays);
  // Takes shadow rays straight on through the surfaces that they met: multiplies their light by what is left
  // of it (0 behind what neither transmits nor blends), and moves them behind the surface. holes: not 0 where
  // a ray passes the surface as if nothing were there. ends: their light is at t = 1. Reads the bounce's
  // scene and offset.
  void (*cross_glass)(const Bounce& bounce, const std::uint32_t* holes, bool ends, RayQueue& rays);
  // Appends to the bounce's queues. All rays have hit.
  void (*bounce)(const Bounce& bounce, const RayQueue& rays);
  // Writes what the camera's rays see. All have hit. Reads the bounce's scene and footprint. `axis`: the one
  // that depth is measured along; zero: depth is the distance.
  void (*visible_points)(const Bounce& bounce, const glm::vec3& axis, const RayQueue& rays,
                         const SeenColumns& to);
  // Adds the environment's light along rays that hit nothing to the radiance of the rays' pixels, RGBA.
  // counts_samples: where a ray with a density starts, a sample of the environment may have found the light.
  // Where the density is negative, another method has found all of it.
  void (*add_environment)(const EnvironmentLight& environment, bool counts_samples, const RayQueue& rays,
                          float* radiance);
  // Adds the environment to the tile's pixels with alpha 0, of which `color` has kTileSize a row.
  void (*paint_background)(const EnvironmentLight& environment, const shared::ViewParams& view,
                           const PixelBox& tile, glm::vec4* color);
};

enum class Isa;  // pinocchio/tracer.h
// The processor has them.
[[nodiscard]] const LaneSteps& lane_steps(Isa isa);

}  // namespace pinocchio
