// Textures and vertex colours at a point of a triangle, one at a time.
#pragma once

#include "bench/one_ray/shared_maps.h"
#include "core/shade/footprint.h"
#include "pinocchio/conversion.h"
#include "pinocchio/mesh.h"

namespace pinocchio {

static_assert(as_int(Wrap::repeat) == shared::texels::kWrapRepeat &&
              as_int(Wrap::mirror) == shared::texels::kWrapMirror &&
              as_int(Wrap::clamp) == shared::texels::kWrapClamp);

// A point of a triangle at which maps are looked up.
struct MapPoint {
  std::uint32_t triangle;
  glm::vec3 weights;    // barycentric
  glm::vec3 n_shading;  // faces the viewer
  bool leaving;         // the surface is seen from behind
  RaySpread spread{};   // the area that textures are averaged over
};

template <class T>
[[nodiscard]] T weighted(const std::vector<T>& of_vertices, const glm::uvec3& corners,
                         const glm::vec3& weights) {
  return weights.x * of_vertices[corners.x] + weights.y * of_vertices[corners.y] +
         weights.z * of_vertices[corners.z];
}

[[nodiscard]] inline shared::texels::TextureParams params_of(const Mesh& mesh, const TextureUse& use) {
  const Texture& texture = mesh.textures[as_size(use.texture)];
  return {{&texture.blocks, linear_from_srgb8().data()},
          texture.size(),
          texture.levels(),
          use.uv_set,
          use.uv_from_texcoord,
          as_int(use.wrap_u),
          as_int(use.wrap_v),
          use.nearest};
}

// Reads textures and vertex colours at one point.
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
    moved_x_ = shared::moved_on_triangle(point.spread.x, point.spread.direction, ab_, ac_);
    moved_y_ = shared::moved_on_triangle(point.spread.y, point.spread.direction, ab_, ac_);
  }

  [[nodiscard]] glm::vec4 at_point(const TextureUse& use, bool is_color) const {
    if (!readable(use)) return glm::vec4(1.0f);
    return glm::vec4(shared::texels::sample_point(params_of(mesh_, use), coordinate(use), is_color));
  }

  [[nodiscard]] bool readable(const TextureUse& use) const { return use.used() && !texcoords(use).empty(); }

  [[nodiscard]] shared::texels::TexturePoint point_on(const TextureUse& use) const {
    shared::texels::TexturePoint where{coordinate(use), glm::vec2(0.0f), glm::vec2(0.0f)};
    if (filters_ && mesh_.textures[as_size(use.texture)].levels() > 1) {
      const Edges e = edges(use);
      where.change_x = shared::uv_change(moved_x_, e.ab, e.ac);
      where.change_y = shared::uv_change(moved_y_, e.ab, e.ac);
    }
    return where;
  }

  // `texel`: the normal map's; n: facing the viewer, as `leaving` says.
  [[nodiscard]] glm::vec3 normal(const TextureUse& use, float scale, const glm::vec3& texel,
                                 const glm::vec3& n, bool leaving) const {
    if (!readable(use)) return n;
    const Edges e = edges(use);
    const glm::vec4 tangent =
        mesh_.tangents.empty() ? glm::vec4(0.0f) : weighted(mesh_.tangents, corners_, weights_);
    const float side = leaving ? -1.0f : 1.0f;
    return side *
           shared::mapped_normal(side * n, glm::vec3(tangent), tangent.w, ab_, ac_, e.ab, e.ac, texel, scale);
  }

  // Not filtered.
  [[nodiscard]] float alpha(const MaterialMaps& maps) const {
    float alpha = maps.alpha_factor * at_point(maps.alpha, false)[maps.alpha_channel];
    if (maps.vertex_colors) alpha *= color().a;
    return alpha;
  }

  [[nodiscard]] glm::vec4 color() const {
    return mesh_.colors.empty() ? glm::vec4(1.0f) : weighted(mesh_.colors, corners_, weights_);
  }

 private:
  struct Edges {  // the triangle's, in texture coordinates
    glm::vec2 ab, ac;
  };

  [[nodiscard]] const std::vector<glm::vec2>& texcoords(const TextureUse& use) const {
    return use.uv_set == 1 ? mesh_.texcoords1 : mesh_.texcoords;
  }

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
  glm::vec3 weights_;
  glm::vec3 ab_, ac_;
  bool filters_ = false;
  glm::vec3 moved_x_{0.0f}, moved_y_{0.0f};  // moved_on_triangle, where it filters
};

}  // namespace pinocchio
