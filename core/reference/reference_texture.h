#pragma once

#include <glm/glm.hpp>

#include "core/reference/reference_maps.h"

namespace pinocchio {

// A texture at a triangle's hit, in double precision.
class ReferenceTexture {
 public:
  ReferenceTexture(const Mesh& mesh, const ReferenceHit& hit, const TextureUse& use);

  // False: it is white everywhere.
  [[nodiscard]] bool there() const { return texture_ != nullptr; }
  // RGBA, 0 to 1, with linear colour: at the point, and as the mean over the pixel's footprint.
  [[nodiscard]] glm::dvec4 at_point(bool is_color) const;
  [[nodiscard]] glm::dvec4 mean(const ReferenceSpread& spread, bool is_color) const;
  // The derivatives of the triangle's point by u and v; zero if the coordinates have no area.
  [[nodiscard]] glm::dmat2x3 point_by_texcoord() const;

 private:
  [[nodiscard]] glm::dvec2 texcoord_by_move(const glm::dvec3& spread, const glm::dvec3& direction) const;
  [[nodiscard]] glm::dvec4 interpolated(const glm::dvec2& texcoord, int level, bool is_color) const;
  [[nodiscard]] glm::dvec4 texel(int level, std::int64_t x, std::int64_t y, bool is_color) const;

  const TextureUse& use_;
  const Texture* texture_ = nullptr;
  glm::dvec2 texcoord_{0.0}, uv_ab_{0.0}, uv_ac_{0.0};
  glm::dvec3 ab_{0.0}, ac_{0.0};
};

}  // namespace pinocchio
