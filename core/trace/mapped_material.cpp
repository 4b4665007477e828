#include "core/trace/mapped_material.h"

#include "core/trace/shared_maps.h"

namespace pinocchio {
namespace {

static_assert(static_cast<int>(Wrap::repeat) == shared::kWrapRepeat &&
              static_cast<int>(Wrap::mirror) == shared::kWrapMirror &&
              static_cast<int>(Wrap::clamp) == shared::kWrapClamp);
static_assert(static_cast<int>(AlphaMode::opaque) == shared::kAlphaOpaque &&
              static_cast<int>(AlphaMode::mask) == shared::kAlphaMask &&
              static_cast<int>(AlphaMode::blend) == shared::kAlphaBlend);

template <class T>
T weighted(const std::vector<T>& of_vertices, const glm::uvec3& corners, const glm::vec3& weights) {
  return weights.x * of_vertices[corners.x] + weights.y * of_vertices[corners.y] +
         weights.z * of_vertices[corners.z];
}

shared::TextureParams params_of(const Mesh& mesh, const TextureUse& use) {
  const Texture& texture = mesh.textures[static_cast<std::size_t>(use.texture)];
  const int count = texture.texels.width() * texture.texels.height();
  return {{texture.texels.pixels().data(), texture.smaller_levels.data(), count},
          texture.texels.size(),
          texture.levels(),
          use.uv_set,
          use.uv_from_texcoord,
          static_cast<int>(use.wrap_u),
          static_cast<int>(use.wrap_v),
          use.nearest};
}

// The triangle as look-ups see it.
class Lookup {
 public:
  Lookup(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights)
      : mesh_(mesh), corners_(mesh.triangles[triangle]), weights_(weights) {}

  [[nodiscard]] glm::vec4 at(const TextureUse& use, bool is_color) const {
    if (!readable(use)) return glm::vec4(1.0f);
    const glm::vec2 uv = use.uv_from_texcoord * glm::vec3(weighted(texcoords(use), corners_, weights_), 1.0f);
    return shared::sample_level(params_of(mesh_, use), uv, 0, is_color);
  }

  [[nodiscard]] glm::vec4 filtered(const TextureUse& use, bool is_color, const MapPoint& point) const {
    if (!readable(use)) return glm::vec4(1.0f);
    const shared::TextureParams params = params_of(mesh_, use);
    shared::TexturePoint where{
        use.uv_from_texcoord * glm::vec3(weighted(texcoords(use), corners_, weights_), 1.0f), glm::vec2(0.0f),
        glm::vec2(0.0f)};
    if (params.levels > 1 && point.spread.direction != glm::vec3(0.0f)) {
      const Edges e = edges(use);
      where.change_x =
          shared::uv_change(point.spread.x, point.spread.direction, e.ab, e.ac, e.uv_ab, e.uv_ac);
      where.change_y =
          shared::uv_change(point.spread.y, point.spread.direction, e.ab, e.ac, e.uv_ab, e.uv_ac);
    }
    return shared::sample_texture(params, where, is_color);
  }

  [[nodiscard]] glm::vec3 normal(const TextureUse& use, float scale, const MapPoint& point) const {
    if (!readable(use)) return point.n_shading;
    const Edges e = edges(use);
    const glm::vec4 tangent =
        mesh_.tangents.empty() ? glm::vec4(0.0f) : weighted(mesh_.tangents, corners_, weights_);
    const float side = point.leaving ? -1.0f : 1.0f;
    return side * shared::mapped_normal(side * point.n_shading, tangent, e.ab, e.ac, e.uv_ab, e.uv_ac,
                                        glm::vec3(filtered(use, false, point)), scale);
  }

  [[nodiscard]] glm::vec4 color() const {
    return mesh_.colors.empty() ? glm::vec4(1.0f) : weighted(mesh_.colors, corners_, weights_);
  }

 private:
  struct Edges {
    glm::vec3 ab, ac;
    glm::vec2 uv_ab, uv_ac;
  };

  [[nodiscard]] const std::vector<glm::vec2>& texcoords(const TextureUse& use) const {
    return use.uv_set == 1 ? mesh_.texcoords1 : mesh_.texcoords;
  }
  [[nodiscard]] bool readable(const TextureUse& use) const { return use.used() && !texcoords(use).empty(); }

  [[nodiscard]] Edges edges(const TextureUse& use) const {
    const auto uv = [&](std::uint32_t i) {
      return use.uv_from_texcoord * glm::vec3(texcoords(use)[i], 1.0f);
    };
    const glm::vec3& a = mesh_.positions[corners_.x];
    const glm::vec2 uv_a = uv(corners_.x);
    return {mesh_.positions[corners_.y] - a, mesh_.positions[corners_.z] - a, uv(corners_.y) - uv_a,
            uv(corners_.z) - uv_a};
  }

  const Mesh& mesh_;
  const glm::uvec3& corners_;
  const glm::vec3& weights_;
};

shared::MetallicRoughness metallic_roughness(const GltfSurface& s) {
  return {s.base_color, s.metallic,       s.roughness,    s.emissive, s.ior,
          s.specular,   s.specular_color, s.transmission, s.volume,   s.unlit};
}

float alpha_at(const MaterialMaps& maps, const Lookup& look) {
  float alpha = maps.alpha_factor * look.at(maps.alpha, false)[maps.alpha_channel];
  if (maps.vertex_colors) alpha *= look.color().a;
  return alpha;
}

}  // namespace

shared::PhongSurface plain_material(const Material& m) {
  return {{m.ambient, m.diffuse, m.specular, m.shininess, m.emission},
          m.reflectance,
          m.transmittance,
          m.ior,
          m.fresnel};
}

MappedMaterial mapped_material(const Mesh& mesh, const MapPoint& point) {
  const MaterialMaps& maps = *mesh.maps_of(point.triangle);
  const Lookup look(mesh, point.triangle, point.weights);
  shared::MapValues v{glm::vec3(look.filtered(maps.base_color, true, point)),
                      1.0f,
                      1.0f,
                      1.0f,
                      glm::vec3(look.filtered(maps.emissive, true, point)),
                      1.0f,
                      glm::vec3(1.0f),
                      1.0f};
  if (maps.vertex_colors) v.base_color *= glm::vec3(look.color());
  v.occlusion = 1.0f + maps.occlusion_strength * (look.filtered(maps.occlusion, false, point).r - 1.0f);

  MappedMaterial mapped;
  if (maps.from_gltf) {
    const glm::vec4 texel = look.filtered(maps.metallic_roughness, false, point);
    v.roughness = texel.g;
    v.metallic = texel.b;
    if (maps.maps_dielectric()) {
      v.specular = look.filtered(maps.specular, false, point).a;
      v.specular_color = glm::vec3(look.filtered(maps.specular_color, true, point));
      v.transmission = look.filtered(maps.transmission, false, point).r;
    }
    mapped.surface = shared::mapped_metallic_roughness(metallic_roughness(maps.surface), v);
  } else {
    mapped.surface = shared::mapped_phong(plain_material(mesh.material_of(point.triangle)), v);
  }
  mapped.n_shading = look.normal(maps.normal, maps.normal_scale, point);
  mapped.alpha = maps.blends() ? glm::clamp(alpha_at(maps, look), 0.0f, 1.0f) : 1.0f;
  return mapped;
}

bool is_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps || !maps->has_holes()) return false;
  return shared::is_hole(static_cast<int>(maps->alpha_mode), alpha_at(*maps, Lookup(mesh, triangle, weights)),
                         maps->alpha_cutoff);
}

bool lets_shadow_ray_pass(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights,
                          float threshold) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps) return false;
  if (!maps->blends()) return is_hole(mesh, triangle, weights);
  return alpha_at(*maps, Lookup(mesh, triangle, weights)) < threshold;
}

}  // namespace pinocchio
