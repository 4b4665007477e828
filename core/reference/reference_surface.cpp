#include "core/reference/reference_surface.h"

#include <algorithm>
#include <cmath>

#include "core/image/tonemap.h"
#include "core/math/components.h"

namespace pinocchio {
namespace {

// The tracer allows itself 32 roundings of float; a few hundred of double cost nothing here, and are a
// million times less.
constexpr double kPointError = 512.0 * 0x1p-53;

int wrap(int i, int n) {
  const int r = i % n;
  return r < 0 ? r + n : r;
}

// Bilinear, repeating, linear light.
glm::dvec3 texture_color(const Texture& texture, const glm::dvec2& texcoord) {
  const glm::ivec2 size = texture.texels.size();
  const glm::dvec2 at = glm::fract(texcoord) * glm::dvec2(size) - 0.5;
  const glm::dvec2 base = glm::floor(at), f = at - base;
  const auto texel = [&](int dx, int dy) {
    const glm::u8vec4& t = texture.texels.at(wrap(static_cast<int>(base.x) + dx, size.x),
                                             wrap(static_cast<int>(base.y) + dy, size.y));
    return glm::dvec3(srgb8_to_linear(t.r), srgb8_to_linear(t.g), srgb8_to_linear(t.b));
  };
  const glm::dvec3 upper = (1.0 - f.x) * texel(0, 0) + f.x * texel(1, 0);
  const glm::dvec3 lower = (1.0 - f.x) * texel(0, 1) + f.x * texel(1, 1);
  return (1.0 - f.y) * upper + f.y * lower;
}

glm::dvec3 color_factor(const Mesh& mesh, const Material& m, const glm::uvec3& corners,
                        const glm::dvec3& weights) {
  if (m.diffuse_texture < 0 || mesh.texcoords.empty()) return glm::dvec3(1.0);
  const glm::dvec2 texcoord = weights.x * glm::dvec2(mesh.texcoords[corners.x]) +
                              weights.y * glm::dvec2(mesh.texcoords[corners.y]) +
                              weights.z * glm::dvec2(mesh.texcoords[corners.z]);
  return texture_color(mesh.textures[static_cast<std::size_t>(m.diffuse_texture)], texcoord);
}

// A triangle's own normal has no length where it has no area, vertex normals none where they cancel.
glm::dvec3 unit_or(const glm::dvec3& n, double least_square, const glm::dvec3& otherwise) {
  const double square = glm::dot(n, n);
  return square > least_square ? n / std::sqrt(square) : otherwise;
}

}  // namespace

ReferenceSurface reference_surface(const Mesh& mesh, const ReferenceRay& ray, const ReferenceHit& hit) {
  const glm::uvec3 corners = mesh.triangles[hit.triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
  const glm::dvec3 ab = b - a, ac = c - a;

  ReferenceSurface s;
  s.to_viewer = -glm::normalize(ray.direction);
  s.p_world = a + hit.weights.y * ab + hit.weights.z * ac;
  s.error =
      kPointError * (largest_component(s.p_world) + std::max(largest_component(ab), largest_component(ac)));

  s.n_geometric = unit_or(glm::cross(ab, ac), 0.0, s.to_viewer);
  const glm::dvec3 interpolated = hit.weights.x * glm::dvec3(mesh.normals[corners.x]) +
                                  hit.weights.y * glm::dvec3(mesh.normals[corners.y]) +
                                  hit.weights.z * glm::dvec3(mesh.normals[corners.z]);
  s.n_shading = unit_or(interpolated, 1e-12, s.n_geometric);
  // Where winding and vertex normals disagree about the outside, the normals are right.
  if (glm::dot(s.n_geometric, s.n_shading) < 0.0) s.n_geometric = -s.n_geometric;
  s.leaving = glm::dot(s.n_geometric, s.to_viewer) < 0.0;
  if (s.leaving) {
    s.n_geometric = -s.n_geometric;
    s.n_shading = -s.n_shading;
  }

  s.material = &mesh.material_of(hit.triangle);
  const glm::dvec3 color = color_factor(mesh, *s.material, corners, hit.weights);
  s.ambient = glm::dvec3(s.material->ambient) * color;
  s.diffuse = glm::dvec3(s.material->diffuse) * color;
  return s;
}

glm::dvec3 leave(const ReferenceSurface& surface, const glm::dvec3& direction) {
  const double side = glm::dot(surface.n_geometric, direction) < 0.0 ? -surface.error : surface.error;
  return surface.p_world + side * surface.n_geometric;
}

}  // namespace pinocchio
