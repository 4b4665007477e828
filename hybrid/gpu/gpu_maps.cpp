#include "hybrid/gpu/gpu_maps.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/shade/gltf_surface.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Layouts and bits of shaders/map_fetch.glsl.
struct UseTexels {
  glm::vec4 place{0.0f}, axes{0.0f}, rest{0.0f};
};
constexpr std::size_t kUses = kMapUses.size();
struct MapTexels {
  std::array<UseTexels, kUses> uses;  // as MaterialMaps::uses()
  glm::vec4 base_metallic, emissive_roughness, specular, more, strengths, alpha_rule;
  LayerTexels layers;
};
constexpr std::size_t kTexelsOfMaps = sizeof(MapTexels) / sizeof(glm::vec4);
static_assert(kTexelsOfMaps == 3 * kUses + 8);
enum : unsigned {
  kBlends = 1u << kUses,
  kSecondTexcoords = kBlends << 1,
  kOcclusionIsShared = kBlends << 2,
  kLayersVary = kBlends << 3
};

// A texel of a level is split over two floats, exact up to 2^24 each.
constexpr std::size_t kPlaceDigit = 4096;

// Where each texture's levels are, and all of them: first texel, width and height.
struct LevelTable {
  std::vector<std::size_t> begin;
  std::vector<glm::vec4> levels;

  explicit LevelTable(const Mesh& mesh) {
    std::size_t next = 0;
    for (const Texture& texture : mesh.textures) {
      begin.push_back(levels.size());
      for (int i = 0; i < texture.levels(); ++i) {
        const glm::ivec2 size = texture.blocks.size(i);
        levels.emplace_back(next / kPlaceDigit, next % kPlaceDigit, size.x, size.y);
        next += as_size(size.x) * as_size(size.y);
      }
    }
  }
};

std::vector<glm::u8vec4> all_texels(const Mesh& mesh) {
  std::vector<glm::u8vec4> texels;
  for (const Texture& texture : mesh.textures) {
    for (int i = 0; i < texture.levels(); ++i) {
      const Image<glm::u8vec4> level = texture.blocks.level(i);
      texels.insert(texels.end(), level.pixels().begin(), level.pixels().end());
    }
  }
  if (texels.empty()) texels.resize(1);  // a texture buffer cannot be empty
  return texels;
}

bool is_read(const Mesh& mesh, const TextureUse& use) {
  return use.used() && !(use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords).empty();
}

// `place`: of the texture's levels in the buffer.
UseTexels use_texels(const Texture& texture, std::size_t place, const TextureUse& use) {
  const glm::mat3x2& m = use.uv_from_texcoord;
  const int bits =
      (use.uv_set == 1 ? 1 : 0) | (use.nearest ? 2 : 0) | as_int(use.wrap_u) << 2 | as_int(use.wrap_v) << 4;
  return {.place = glm::vec4(place, texture.levels(), texture.size()),
          .axes = {m[0], m[1]},
          .rest = {m[2], bits, 0.0f}};
}

MapTexels map_texels(const Mesh& mesh, const MaterialMaps& m, const LevelTable& table) {
  const auto flag = [](bool b) { return b ? 1.0f : 0.0f; };
  const GltfSurface& s = m.surface;
  MapTexels t{
      .uses = {},
      .base_metallic = glm::vec4(s.base_color, s.metallic),
      .emissive_roughness = glm::vec4(s.emissive, s.roughness),
      .specular = glm::vec4(s.specular_color, s.specular),
      .more = glm::vec4(s.ior, s.transmission, flag(s.volume), flag(s.unlit)),
      .strengths = glm::vec4(m.normal_scale, m.occlusion.used() ? m.occlusion_strength : 0.0f,
                             flag(m.from_gltf) + flag(m.from_gltf && m.coat_is_mapped), m.alpha_channel),
      .alpha_rule =
          glm::vec4(m.effective_alpha_mode(), m.alpha_factor, m.alpha_cutoff, flag(m.vertex_colors)),
      .layers = layer_texels(s.layers)};
  const auto uses = m.uses();
  for (std::size_t i = 0; i < kUses; ++i) {
    if (!is_read(mesh, *uses[i])) continue;
    const auto texture = as_size(uses[i]->texture);
    t.uses[i] =
        use_texels(mesh.textures[texture], mesh.maps.size() * kTexelsOfMaps + table.begin[texture], *uses[i]);
  }
  return t;
}

std::vector<glm::vec4> maps_and_levels(const Mesh& mesh) {
  const LevelTable table(mesh);
  std::vector<glm::vec4> all;
  for (const MaterialMaps& m : mesh.maps) {
    const MapTexels texels = map_texels(mesh, m, table);
    const auto* const first = reinterpret_cast<const glm::vec4*>(&texels);
    all.insert(all.end(), first, first + kTexelsOfMaps);
  }
  all.insert(all.end(), table.levels.begin(), table.levels.end());
  return all;
}

// MAP_USES.
unsigned bits_of_uses(const Mesh& mesh) {
  unsigned bits = 0;
  for (const MaterialMaps& m : mesh.maps) {
    for (std::size_t i = 0; i < kUses; ++i) {
      const MapUse& row = kMapUses[i];
      const TextureUse& use = m.*row.use;
      if (!is_read(mesh, use)) continue;
      bits |= 1u << i;
      if (use.uv_set == 1) bits |= kSecondTexcoords;
      // Where light goes through, layers are left out.
      if (has_layers(m) && (row.of_layers || row.use == &MaterialMaps::transmission)) bits |= kLayersVary;
    }
    if (m.blends()) bits |= kBlends;
  }
  const auto shares = [](const MaterialMaps& m) {
    return !m.occlusion.used() || m.occlusion == m.metallic_roughness;
  };
  return std::ranges::all_of(mesh.maps, shares) ? bits | kOcclusionIsShared : bits;
}

// Both sets of texture coordinates, one after the other: OpenGL 3.3 has 16 units, so they share one.
std::vector<glm::vec2> both_sets(const Mesh& mesh) {
  std::vector<glm::vec2> all = mesh.texcoords;
  if (all.empty() || !mesh.texcoords1.empty()) all.resize(mesh.positions.size());
  all.insert(all.end(), mesh.texcoords1.begin(), mesh.texcoords1.end());
  return all;
}

template <class T>
gl::TextureBuffer buffer_of(const std::vector<T>& data, GLenum format, std::size_t bytes_per_texel) {
  return {std::span<const T>(data), format, bytes_per_texel};
}

}  // namespace

GpuMaps::GpuMaps(const Mesh& mesh, const GpuMaps* shares_textures) {
  if (mesh.maps.empty()) return;
  definitions_.emplace_back("HAS_MAPS");
  has_holes_ = std::any_of(mesh.maps.begin(), mesh.maps.end(), [](const auto& m) { return m.has_holes(); });
  definitions_.push_back("MAP_USES " + std::to_string(bits_of_uses(mesh)));
  maps_ = buffer_of(maps_and_levels(mesh), GL_RGBA32F, sizeof(glm::vec4));
  texels_ = shares_textures ? shares_textures->texels_ : nullptr;
  if (!texels_)
    texels_ =
        std::make_shared<const gl::TextureBuffer>(buffer_of(all_texels(mesh), GL_RGBA8, sizeof(glm::u8vec4)));
  vertex_count_ = as_int(mesh.positions.size());
  texcoords_ = buffer_of(both_sets(mesh), GL_R32F, sizeof(float));
  if (!mesh.colors.empty()) definitions_.emplace_back("HAS_COLORS");
  if (!mesh.tangents.empty()) definitions_.emplace_back("HAS_TANGENTS");
  std::vector<glm::vec4> quads = mesh.colors;
  quads.insert(quads.end(), mesh.tangents.begin(), mesh.tangents.end());
  if (!quads.empty()) vertex_quads_ = buffer_of(quads, GL_RGBA32F, sizeof(glm::vec4));
}

void GpuMaps::update_tangents(const Mesh& mesh, std::size_t first_vertex, std::size_t vertices) {
  if (mesh.maps.empty() || mesh.tangents.empty()) return;
  vertex_quads_.write(mesh.colors.size() + first_vertex,
                      std::span(mesh.tangents).subspan(first_vertex, vertices));
}

int GpuMaps::bind(const gl::Program& program, int first_unit) const {
  if (definitions_.empty()) return first_unit;
  int unit = first_unit;
  program.set("maps_buffer", unit++, maps_);
  program.set("texcoords", unit++, texcoords_);
  program.set("texels", unit++, *texels_);
  if (vertex_quads_.name() != 0) program.set("vertex_quads", unit++, vertex_quads_);
  program.set("vertex_count", vertex_count_);
  return unit;
}

}  // namespace pinocchio
