#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <variant>

#include "pinocchio/conversion.h"
#include "pinocchio/exr.h"
#include "pinocchio/glm_layout.h"

namespace pinocchio {

// The caller's arrays that pictures are written to: frame after frame, row after row from the top, one value
// for each pixel. Null: the layer is not wanted, and nothing is traced for it. All arrays but `color` show
// the first sample. kLayers describes each.
struct FrameArrays {
  glm::vec4* color = nullptr;
  float* depth = nullptr;
  glm::vec3* position = nullptr;
  glm::vec3* normal = nullptr;
  glm::vec3* albedo = nullptr;
  std::uint32_t* ids = nullptr;
  std::uint32_t* objects = nullptr;
  std::uint8_t* mask = nullptr;
  glm::vec3* reflection = nullptr;
  std::uint32_t* materials = nullptr;
  std::uint32_t* primitives = nullptr;
  glm::vec2* motion = nullptr;
  // Bytes of a pixel in `mask`: slot i is bit i % 8 of byte i / 8. MaskImage::bytes_for() holds all casting
  // lights, fewer hold the lowest slots.
  std::size_t mask_bytes = 1;

  [[nodiscard]] bool wants_surfaces() const { return depth || position || normal || albedo; }
};

// The layers of a picture. kLayers has a row for each, in this order. The window shows those before
// `objects`.
enum class Layer {
  picture,
  ids,
  normals,
  mask,
  reflection,
  delay,
  depth,
  position,
  albedo,
  objects,
  materials,
  primitives,
  motion
};

// A layer as an EXR, --aov, the arrays of render_many and the window's views have it. Empty names: the layer
// is not there.
struct LayerRow {
  Layer layer;
  struct {
    std::string_view name;  // in Python
    std::variant<std::monostate, glm::vec4 * FrameArrays::*, glm::vec3 * FrameArrays::*,
                 glm::vec2 * FrameArrays::*, float * FrameArrays::*, std::uint32_t * FrameArrays::*,
                 std::uint8_t * FrameArrays::*>
        values;
    std::string_view doc;
  } array;
  struct {
    std::string_view name;                     // for --aov; empty for the colour, which is always written
    std::array<std::string_view, 4> channels;  // one for each component
    ExrChannel::Type type;
    bool by_name_only = false;  // `all` does not mean it
  } exr;
  struct {
    std::string_view name, legend;
    int ranged_axes;  // components that are shown within a range
    bool traced;      // by rays: a reprojected picture shows an older frame's
  } window;
};

inline constexpr ExrChannel::Type kHalf = ExrChannel::Type::half, kReal = ExrChannel::Type::real,
                                  kUint = ExrChannel::Type::uint;
inline constexpr std::array kLayers{
    LayerRow{Layer::picture,
             {"color", &FrameArrays::color,
              "linear RGBA, mean of the samples; A: how much of the pixel is covered"},
             {{}, {"R", "G", "B", "A"}, kHalf},
             {"picture", "the finished picture", 0, false}},
    LayerRow{Layer::ids,
             {"ids", &FrameArrays::ids, "the triangle; 0xffffffff where nothing is hit"},
             {"id", {"id.triangle"}, kUint},
             {"ids", "triangle ids, a colour each; dark: nothing is seen", 0, false}},
    LayerRow{Layer::normals,
             {"normal", &FrameArrays::normal, "world shading normal, unit; 0 where nothing is hit"},
             {"N", {"N.X", "N.Y", "N.Z"}, kHalf},
             {"normals", "shading normals, world space: red X, green Y, blue Z, from -1 (dark) to 1 (bright)",
              0, false}},
    LayerRow{Layer::mask,
             {"mask", &FrameArrays::mask,
              "bit i is set where the light in mask slot i reaches the point; uint16, uint32 or uint64 for "
              "more than "
              "8, 16 or 32 casting lights, and (h, w, n) uint64 of 64 lights each for more than 64"},
             {"shadow", {"shadow.mask"}, kUint},
             {"mask", "white lit, black in shadow, grey not asked (faces away, or nothing seen)", 0, true}},
    LayerRow{Layer::reflection,
             {"reflection", &FrameArrays::reflection, "mirrored and refracted light, linear"},
             {"reflection", {"reflection.R", "reflection.G", "reflection.B"}, kHalf},
             {"reflection", "mirrored and refracted light", 0, true}},
    LayerRow{
        Layer::delay, {}, {}, {"delay", "green: shadows and reflections are the picture's own", 0, true}},
    LayerRow{
        Layer::depth,
        {"depth", &FrameArrays::depth, "distance along the view axis, scene units; inf where nothing is hit"},
        {"Z", {"Z"}, kReal},
        {"depth", "depth along the view axis, scene units", 1, false}},
    LayerRow{Layer::position,
             {"position", &FrameArrays::position, "world position, scene units; 0 where nothing is hit"},
             {"P", {"P.X", "P.Y", "P.Z"}, kReal},
             {"position", "world position, scene units", 3, false}},
    LayerRow{Layer::albedo,
             {"albedo", &FrameArrays::albedo,
              "share of light that the surface returns: the base colour, of metals too (Phong: the matt "
              "part); linear; 0 where "
              "nothing is "
              "hit"},
             {"Albedo", {"Albedo.R", "Albedo.G", "Albedo.B"}, kHalf},
             {"albedo", "base colour, as textures and materials have it", 0, false}},
    LayerRow{
        Layer::objects,
        {"objects", &FrameArrays::objects,
         "the node that the triangle moves with, 0 where the scene has no nodes; 0xffffffff where nothing is "
         "hit"},
        {"id.node", {"id.node"}, kUint, true},
        {}},
    LayerRow{
        Layer::materials,
        {"materials", &FrameArrays::materials, "the triangle's material; 0xffffffff where nothing is hit"},
        {"id.material", {"id.material"}, kUint, true},
        {}},
    LayerRow{Layer::primitives,
             {"primitives", &FrameArrays::primitives,
              "the triangle's number within its node, from 0: its face in the mesh that the node was made "
              "of; 0xffffffff where nothing is hit"},
             {"id.primitive", {"id.primitive"}, kUint, true},
             {}},
    LayerRow{Layer::motion,
             {"motion", &FrameArrays::motion,
              "pixels from the point to its place in another frame: x to the right, y down; 0 where nothing "
              "is hit, NaN where the other frame's camera does not see the point"},
             {"motion", {"motion.X", "motion.Y"}, kReal, true},
             {}},
};

[[nodiscard]] constexpr const LayerRow& layer_row(Layer layer) {
  return kLayers[as_size(layer)];
}

}  // namespace pinocchio
