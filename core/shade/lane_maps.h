// Materials with maps as the lanes read them (trace/lanes/maps.h).
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/mesh.h"

namespace pinocchio {

inline constexpr unsigned kMostLanes = 16;
inline constexpr int kMostLevels = 31;  // a side has less than 2^31 texels

struct LaneTexture {
  const void* texels;                // of all levels, in blocks (pinocchio/texture.h), 32 bits each
  const float* linear_from_srgb8;    // 256; null: the texture is no colour
  unsigned maps;                     // bit i: row i of kMapUses reads it
  const std::uint32_t* least_green;  // Texture's; null: it has none
};

struct TextureLevel {
  std::uint32_t first;  // texel
  float width, height;
};

// Textures of one material with the same coordinates, size and filter, which are read together.
struct TexturePlace {
  const glm::vec2* texcoords;    // the UV set's, one a vertex
  float uv_from_texcoord[3][2];  // by column
  TextureLevel level[kMostLevels];
  int levels;
  Wrap wrap_u, wrap_v;
  bool nearest;
  unsigned maps;  // all textures'
  const LaneTexture* textures;
  int count;
};

struct LaneMaps {
  const MaterialMaps* maps;
  const TexturePlace* places;
  int count;
  const TexturePlace* alpha;  // null: there is no such texture
};

// What a packet's textures are read at, a column each, and what they hold.
struct TexturePoints {
  using Column = float[kMostLanes];
  alignas(64) Column uv[2];
  alignas(64) Column change_x[2], change_y[2];  // of uv from a pixel to the next; zero: not filtered
  alignas(64) Column texel[12][4];              // output, by texture: RGBA; a colour's A is not set
};

// Reads the place's textures of which some are in `maps`.
using SampleTextures = void (*)(const TexturePlace& place, unsigned lanes, unsigned maps,
                                TexturePoints& points);

// The maps of a mesh, which must outlive this.
class LaneMapsOf {
 public:
  explicit LaneMapsOf(const Mesh& mesh);
  LaneMapsOf(const LaneMapsOf&) = delete;
  LaneMapsOf& operator=(const LaneMapsOf&) = delete;

  // In the order of Mesh::maps; null: there are none.
  [[nodiscard]] const LaneMaps* data() const { return maps_.empty() ? nullptr : maps_.data(); }

 private:
  std::vector<LaneMaps> maps_;
  std::vector<TexturePlace> places_;
  std::vector<LaneTexture> textures_;
};

// The coordinates of its UV set; empty: there are none, and the texture is white.
[[nodiscard]] const std::vector<glm::vec2>& texcoords_of(const Mesh& mesh, const TextureUse& use);
[[nodiscard]] bool is_readable(const Mesh& mesh, const TextureUse& use);

// Without textures.
[[nodiscard]] TexturePlace texture_place(const Mesh& mesh, const TextureUse& use);
[[nodiscard]] LaneTexture lane_texture(const Mesh& mesh, const TextureUse& use, bool is_color, unsigned maps);

}  // namespace pinocchio
