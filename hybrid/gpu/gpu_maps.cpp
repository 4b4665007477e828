#include "hybrid/gpu/gpu_maps.h"

#include <algorithm>
#include <span>

namespace pinocchio {
namespace {

// A texture's first texel is split over two floats, exact up to 2^24 each.
constexpr std::size_t kPlaceDigit = 4096;

// Layouts of shaders/map_fetch.glsl.
struct UseTexels {
  glm::vec4 place{0.0f}, axes{0.0f}, rest{0.0f};
};
struct MapTexels {
  UseTexels base_color, metallic_roughness, normal, occlusion, emissive, alpha;
  glm::vec4 base_metallic, emissive_roughness, specular, more, strengths, alpha_rule;
};
static_assert(sizeof(MapTexels) == 24 * sizeof(glm::vec4));
struct DielectricTexels {  // sent where some material has one of these
  UseTexels specular, specular_color, transmission;
};
static_assert(sizeof(DielectricTexels) == 9 * sizeof(glm::vec4));
struct LayerTexels {  // likewise
  glm::vec4 coat, sheen;
  UseTexels clearcoat, clearcoat_roughness, sheen_color, sheen_roughness;
};
static_assert(sizeof(LayerTexels) == 14 * sizeof(glm::vec4));

std::vector<std::size_t> first_texels(const Mesh& mesh) {
  std::vector<std::size_t> first;
  std::size_t next = 0;
  for (const Texture& texture : mesh.textures) {
    first.push_back(next);
    next += texture.texels.pixels().size() + texture.smaller_levels.size();
  }
  return first;
}

std::vector<glm::u8vec4> all_texels(const Mesh& mesh) {
  std::vector<glm::u8vec4> texels;
  for (const Texture& texture : mesh.textures) {
    texels.insert(texels.end(), texture.texels.pixels().begin(), texture.texels.pixels().end());
    texels.insert(texels.end(), texture.smaller_levels.begin(), texture.smaller_levels.end());
  }
  if (texels.empty()) texels.resize(1);  // a texture buffer cannot be empty
  return texels;
}

UseTexels use_texels(const Mesh& mesh, const std::vector<std::size_t>& first, const TextureUse& use) {
  UseTexels t;
  if (!use.used() || (use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords).empty()) return t;
  const auto i = static_cast<std::size_t>(use.texture);
  const Texture& texture = mesh.textures[i];
  const glm::mat3x2& m = use.uv_from_texcoord;
  const int bits = (use.uv_set == 1 ? 1 : 0) | (use.nearest ? 2 : 0) | static_cast<int>(use.wrap_u) << 2 |
                   static_cast<int>(use.wrap_v) << 4;
  t.place = {static_cast<float>(first[i] / kPlaceDigit), static_cast<float>(first[i] % kPlaceDigit),
             static_cast<float>(texture.texels.width()), static_cast<float>(texture.texels.height())};
  t.axes = {m[0], m[1]};
  t.rest = {m[2], static_cast<float>(texture.levels()), static_cast<float>(bits)};
  return t;
}

template <class T>
void append_texels(const T& texels, std::vector<glm::vec4>& to) {
  const auto* const first = reinterpret_cast<const glm::vec4*>(&texels);
  to.insert(to.end(), first, first + sizeof(T) / sizeof(glm::vec4));
}

std::vector<glm::vec4> map_texels(const Mesh& mesh, bool dielectric, bool layers) {
  const std::vector<std::size_t> first = first_texels(mesh);
  const auto flag = [](bool b) { return b ? 1.0f : 0.0f; };
  std::vector<glm::vec4> all;
  for (const MaterialMaps& m : mesh.maps) {
    const GltfSurface& s = m.surface;
    const auto use = [&](const TextureUse& u) { return use_texels(mesh, first, u); };
    append_texels(MapTexels{.base_color = use(m.base_color),
                            .metallic_roughness = use(m.metallic_roughness),
                            .normal = use(m.normal),
                            .occlusion = use(m.occlusion),
                            .emissive = use(m.emissive),
                            .alpha = use(m.alpha),
                            .base_metallic = glm::vec4(s.base_color, s.metallic),
                            .emissive_roughness = glm::vec4(s.emissive, s.roughness),
                            .specular = glm::vec4(s.specular_color, s.specular),
                            .more = glm::vec4(s.ior, s.transmission, flag(s.volume), flag(s.unlit)),
                            .strengths = glm::vec4(m.normal_scale, m.occlusion_strength,
                                                   flag(m.from_gltf) + flag(m.from_gltf && m.coat_is_mapped),
                                                   static_cast<float>(m.alpha_channel)),
                            .alpha_rule = glm::vec4(static_cast<float>(m.alpha_mode), m.alpha_factor,
                                                    m.alpha_cutoff, flag(m.vertex_colors))},
                  all);
    if (dielectric)
      append_texels(DielectricTexels{use(m.specular), use(m.specular_color), use(m.transmission)}, all);
    if (layers)
      append_texels(
          LayerTexels{.coat = glm::vec4(s.clearcoat, s.clearcoat_roughness, s.sheen_roughness, 0.0f),
                      .sheen = glm::vec4(s.sheen_color, 0.0f),
                      .clearcoat = use(m.clearcoat),
                      .clearcoat_roughness = use(m.clearcoat_roughness),
                      .sheen_color = use(m.sheen_color),
                      .sheen_roughness = use(m.sheen_roughness)},
          all);
  }
  return all;
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
  const bool dielectric = std::ranges::any_of(mesh.maps, [](const auto& m) { return m.maps_dielectric(); });
  if (dielectric) definitions_.emplace_back("HAS_DIELECTRIC_MAPS");
  const bool layers = std::ranges::any_of(mesh.maps, [](const auto& m) { return m.maps_layers(); });
  if (layers) definitions_.emplace_back("HAS_LAYER_MAPS");
  maps_ = buffer_of(map_texels(mesh, dielectric, layers), GL_RGBA32F, sizeof(glm::vec4));
  texels_ = shares_textures ? shares_textures->texels_ : nullptr;
  if (!texels_)
    texels_ =
        std::make_shared<const gl::TextureBuffer>(buffer_of(all_texels(mesh), GL_RGBA8, sizeof(glm::u8vec4)));
  vertex_count_ = static_cast<int>(mesh.positions.size());
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
