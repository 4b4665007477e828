#include "core/reference/reference_texture.h"

#include <algorithm>
#include <cmath>

#include "core/image/tonemap.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

std::int64_t positive_modulo(std::int64_t i, std::int64_t n) {
  return (i % n + n) % n;
}

std::int64_t wrapped(std::int64_t i, std::int64_t n, Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return positive_modulo(i, n);
    case Wrap::mirror: {
      const std::int64_t within = positive_modulo(i, 2 * n);
      return within < n ? within : 2 * n - 1 - within;
    }
    case Wrap::clamp:
      break;
  }
  return std::clamp<std::int64_t>(i, 0, n - 1);
}

}  // namespace

ReferenceTexture::ReferenceTexture(const Mesh& mesh, const ReferenceHit& hit, const TextureUse& use)
    : use_(use) {
  const std::vector<glm::vec2>& of_vertices = use.uv_set == 1 ? mesh.texcoords1 : mesh.texcoords;
  if (use.texture < 0 || of_vertices.empty()) return;
  texture_ = &mesh.textures[use.texture];
  const glm::uvec3& t = mesh.triangles[hit.triangle];
  const auto uv = [&](std::uint32_t vertex) {
    return glm::dmat3x2(use.uv_from_texcoord) * glm::dvec3(glm::dvec2(of_vertices[vertex]), 1.0);
  };
  texcoord_ = hit.weights.x * uv(t.x) + hit.weights.y * uv(t.y) + hit.weights.z * uv(t.z);
  uv_ab_ = uv(t.y) - uv(t.x);
  uv_ac_ = uv(t.z) - uv(t.x);
  ab_ = glm::dvec3(mesh.positions[t.y]) - glm::dvec3(mesh.positions[t.x]);
  ac_ = glm::dvec3(mesh.positions[t.z]) - glm::dvec3(mesh.positions[t.x]);
}

glm::dvec4 ReferenceTexture::at_point(bool is_color) const {
  return texture_ ? interpolated(texcoord_, 0, is_color) : glm::dvec4(1.0);
}

// Up to eight taps along the longer side of the pixel's parallelogram, each interpolated between two levels.
glm::dvec4 ReferenceTexture::mean(const ReferenceSpread& spread, bool is_color) const {
  if (!texture_ || texture_->levels() == 1 || spread.direction == glm::dvec3(0.0)) return at_point(is_color);
  const glm::dvec2 size(texture_->size());
  const glm::dvec2 across = texcoord_by_move(spread.x, spread.direction);
  const glm::dvec2 down = texcoord_by_move(spread.y, spread.direction);
  const double longer = std::max(glm::length(across * size), glm::length(down * size));
  if (!(longer > 1.0 && longer < 1e18)) return at_point(is_color);
  const glm::dmat2 area(across * size, down * size);
  const double height = std::max(std::abs(glm::determinant(area)) / longer, 1.0);
  const int taps = std::clamp(std::ceil(longer / height), 1.0, 8.0);
  const glm::dvec2 side = glm::length(across * size) > glm::length(down * size) ? across : down;
  const double lod = std::clamp(std::log2(longer / taps), 0.0, texture_->levels() - 1.0);
  const int level = lod;
  glm::dvec4 sum(0.0);
  for (int k = 0; k < taps; ++k) {
    const glm::dvec2 at = texcoord_ + ((k + 0.5) / taps - 0.5) * side;
    sum += (level + 1.0 - lod) * interpolated(at, level, is_color);
    if (lod > level) sum += (lod - level) * interpolated(at, level + 1, is_color);
  }
  return sum / as_double(taps);
}

glm::dmat2x3 ReferenceTexture::point_by_texcoord() const {
  const glm::dmat2 uv_by_edges(uv_ab_, uv_ac_);
  if (glm::determinant(uv_by_edges) == 0.0) return glm::dmat2x3(0.0);
  return glm::dmat2x3(ab_, ac_) * glm::inverse(uv_by_edges);
}

// The change of the texture coordinate if the point moves by `spread`, and along `direction` back to the
// triangle's plane: spread = u ab + v ac + w direction.
glm::dvec2 ReferenceTexture::texcoord_by_move(const glm::dvec3& spread, const glm::dvec3& direction) const {
  const glm::dmat3 parts(ab_, ac_, direction);
  if (glm::determinant(parts) == 0.0) return glm::dvec2(0.0);
  const glm::dvec3 uvw = glm::inverse(parts) * spread;
  return uvw.x * uv_ab_ + uvw.y * uv_ac_;
}

glm::dvec4 ReferenceTexture::interpolated(const glm::dvec2& texcoord, int level, bool is_color) const {
  const glm::ivec2 size = texture_->blocks.size(level);
  glm::dvec2 within = texcoord;
  for (int axis = 0; axis < 2; ++axis)
    if ((axis == 0 ? use_.wrap_u : use_.wrap_v) == Wrap::clamp)
      within[axis] = std::clamp(within[axis], 0.0, 1.0);
  const glm::dvec2 at = within * glm::dvec2(size) - (use_.nearest ? 0.0 : 0.5);
  const glm::dvec2 base = glm::floor(at);
  const auto x = static_cast<std::int64_t>(base.x), y = static_cast<std::int64_t>(base.y);
  if (use_.nearest) return texel(level, x, y, is_color);
  const glm::dvec2 f = at - base;
  const glm::dvec4 upper =
      (1.0 - f.x) * texel(level, x, y, is_color) + f.x * texel(level, x + 1, y, is_color);
  const glm::dvec4 lower =
      (1.0 - f.x) * texel(level, x, y + 1, is_color) + f.x * texel(level, x + 1, y + 1, is_color);
  return (1.0 - f.y) * upper + f.y * lower;
}

glm::dvec4 ReferenceTexture::texel(int level, std::int64_t x, std::int64_t y, bool is_color) const {
  const glm::ivec2 size = texture_->blocks.size(level);
  const glm::u8vec4& t = texture_->blocks.at(level, as_int(wrapped(x, size.x, use_.wrap_u)),
                                             as_int(wrapped(y, size.y, use_.wrap_v)));
  if (!is_color) return glm::dvec4(t) / 255.0;
  return {srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b), t.a / 255.0};
}

}  // namespace pinocchio
