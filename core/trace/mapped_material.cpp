#include "core/trace/mapped_material.h"

#include "core/trace/shared_maps.h"

namespace pinocchio {
namespace {

static_assert(static_cast<int>(Wrap::repeat) == shared::texels::kWrapRepeat &&
              static_cast<int>(Wrap::mirror) == shared::texels::kWrapMirror &&
              static_cast<int>(Wrap::clamp) == shared::texels::kWrapClamp);
static_assert(static_cast<int>(AlphaMode::opaque) == shared::kAlphaOpaque &&
              static_cast<int>(AlphaMode::mask) == shared::kAlphaMask &&
              static_cast<int>(AlphaMode::blend) == shared::kAlphaBlend);

template <class T>
T weighted(const std::vector<T>& of_vertices, const glm::uvec3& corners, const glm::vec3& weights) {
  return weights.x * of_vertices[corners.x] + weights.y * of_vertices[corners.y] +
         weights.z * of_vertices[corners.z];
}

shared::texels::TextureParams params_of(const Mesh& mesh, const TextureUse& use) {
  const Texture& texture = mesh.textures[static_cast<std::size_t>(use.texture)];
  const int count = texture.texels.width() * texture.texels.height();
  return {{texture.texels.pixels().data(), texture.smaller_levels.data(), count, linear_from_srgb8().data()},
          texture.texels.size(),
          texture.levels(),
          use.uv_set,
          use.uv_from_texcoord,
          static_cast<int>(use.wrap_u),
          static_cast<int>(use.wrap_v),
          use.nearest};
}

// The point as look-ups see it.
class Lookup {
 public:
  Lookup(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights)
      : mesh_(mesh), corners_(mesh.triangles[triangle]), weights_(weights) {
    const glm::vec3& a = mesh_.positions[corners_.x];
    ab_ = mesh_.positions[corners_.y] - a;
    ac_ = mesh_.positions[corners_.z] - a;
  }

  Lookup(const Mesh& mesh, const MapPoint& point) : Lookup(mesh, point.triangle, point.weights) {
    filters_ = point.spread.direction != glm::vec3(0.0f);
    if (!filters_) return;
    moved_x_ = shared::texels::moved_on_triangle(point.spread.x, point.spread.direction, ab_, ac_);
    moved_y_ = shared::texels::moved_on_triangle(point.spread.y, point.spread.direction, ab_, ac_);
  }

  [[nodiscard]] glm::vec4 at_point(const TextureUse& use, bool is_color) const {
    if (!readable(use)) return glm::vec4(1.0f);
    return glm::vec4(shared::texels::sample_point(params_of(mesh_, use), coordinate(use), is_color));
  }

  [[nodiscard]] glm::vec4 filtered(const TextureUse& use, bool is_color) const {
    if (!readable(use)) return glm::vec4(1.0f);
    const shared::texels::TextureParams params = params_of(mesh_, use);
    shared::texels::TexturePoint where{coordinate(use), glm::vec2(0.0f), glm::vec2(0.0f)};
    if (params.levels > 1 && filters_) {
      const Edges e = edges(use);
      where.change_x = shared::texels::uv_change(moved_x_, e.ab, e.ac);
      where.change_y = shared::texels::uv_change(moved_y_, e.ab, e.ac);
    }
    return glm::vec4(shared::texels::sample_texture(params, where, is_color));
  }

  // n: facing the viewer, as `leaving` says.
  [[nodiscard]] glm::vec3 normal(const TextureUse& use, float scale, const glm::vec3& n, bool leaving) const {
    if (!readable(use)) return n;
    const Edges e = edges(use);
    const glm::vec4 tangent =
        mesh_.tangents.empty() ? glm::vec4(0.0f) : weighted(mesh_.tangents, corners_, weights_);
    const float side = leaving ? -1.0f : 1.0f;
    return side * shared::mapped_normal(side * n, tangent, ab_, ac_, e.ab, e.ac,
                                        glm::vec3(filtered(use, false)), scale);
  }

  [[nodiscard]] glm::vec4 color() const {
    return mesh_.colors.empty() ? glm::vec4(1.0f) : weighted(mesh_.colors, corners_, weights_);
  }

 private:
  struct Edges {  // of the triangle, in texture coordinates
    glm::vec2 ab, ac;
  };

  [[nodiscard]] const std::vector<glm::vec2>& texcoords(const TextureUse& use) const {
    return use.uv_set == 1 ? mesh_.texcoords1 : mesh_.texcoords;
  }
  [[nodiscard]] bool readable(const TextureUse& use) const { return use.used() && !texcoords(use).empty(); }

  [[nodiscard]] glm::vec2 coordinate(const TextureUse& use) const {
    return use.uv_from_texcoord * glm::vec3(weighted(texcoords(use), corners_, weights_), 1.0f);
  }
  [[nodiscard]] Edges edges(const TextureUse& use) const {
    const auto uv = [&](std::uint32_t i) {
      return use.uv_from_texcoord * glm::vec3(texcoords(use)[i], 1.0f);
    };
    const glm::vec2 uv_a = uv(corners_.x);
    return {uv(corners_.y) - uv_a, uv(corners_.z) - uv_a};
  }

  const Mesh& mesh_;
  const glm::uvec3& corners_;
  const glm::vec3& weights_;
  glm::vec3 ab_, ac_;
  bool filters_ = false;
  glm::vec3 moved_x_{0.0f}, moved_y_{0.0f};  // moved_on_triangle, where it filters
};

shared::MetallicRoughness metallic_roughness(const GltfSurface& s) {
  return {s.base_color, s.metallic,       s.roughness,    s.emissive, s.ior,
          s.specular,   s.specular_color, s.transmission, s.volume,   s.unlit};
}

float alpha_at(const MaterialMaps& maps, const Lookup& look) {
  float alpha = maps.alpha_factor * look.at_point(maps.alpha, false)[maps.alpha_channel];
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
  const Lookup look(mesh, point);
  shared::MapValues v{glm::vec3(look.filtered(maps.base_color, true)),
                      1.0f,
                      1.0f,
                      1.0f,
                      glm::vec3(look.filtered(maps.emissive, true)),
                      1.0f,
                      glm::vec3(1.0f),
                      1.0f};
  if (maps.vertex_colors) v.base_color *= glm::vec3(look.color());
  // Often the three are channels of one texture.
  const glm::vec4 packed = look.filtered(maps.metallic_roughness, false);
  const float open =
      maps.occlusion == maps.metallic_roughness ? packed.r : look.filtered(maps.occlusion, false).r;
  v.occlusion = 1.0f + maps.occlusion_strength * (open - 1.0f);

  MappedMaterial mapped;
  if (maps.from_gltf) {
    v.roughness = packed.g;
    v.metallic = packed.b;
    if (maps.maps_dielectric()) {
      v.specular = look.filtered(maps.specular, false).a;
      v.specular_color = glm::vec3(look.filtered(maps.specular_color, true));
      v.transmission = look.filtered(maps.transmission, false).r;
    }
    mapped.surface = shared::mapped_metallic_roughness(metallic_roughness(maps.surface), v);
  } else {
    mapped.surface = shared::mapped_phong(plain_material(mesh.material_of(point.triangle)), v);
  }
  mapped.n_shading = look.normal(maps.normal, maps.normal_scale, point.n_shading, point.leaving);
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
