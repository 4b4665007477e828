#include "core/trace/lit_proof.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/trace/shaft.h"
#include "core/trace/surface.h"

namespace pinocchio {
namespace {

// Sines and lengths (of unit vectors) below this are too near zero to be sure of their sign.
constexpr double kSure = 1e-4;

// A cell, with what its pixels' normals and lights are made of.
struct Cell {
  Piece piece;
  std::array<glm::dvec3, 3> n_shading;  // at the corners, not of unit length, on the piece's side
  const Material* material;
};

// Nothing where the normals do not agree on the side that is seen.
std::optional<Cell> make_cell(const Mesh& mesh, const CellPlace& place) {
  const auto& [triangle, back, weights] = place;
  const glm::uvec3& ids = mesh.triangles[triangle];
  const std::array<glm::vec3, 3> corners{mesh.positions[ids.x], mesh.positions[ids.y], mesh.positions[ids.z]};
  const glm::dvec3 a(corners[0]), ab = glm::dvec3(corners[1]) - a, ac = glm::dvec3(corners[2]) - a;
  const glm::dvec3 cross = glm::cross(ab, ac);
  if (!(glm::length(cross) > 0.0)) return std::nullopt;
  const glm::dvec3 n_winding = glm::normalize(cross);

  Cell cell;
  cell.material = &mesh.material_of(triangle);
  cell.piece.triangle = triangle;
  cell.piece.n = back ? -n_winding : n_winding;
  const glm::vec3 n(cell.piece.n), edge_ab = corners[1] - corners[0], edge_ac = corners[2] - corners[0];
  cell.piece.lift_least = least_error_bound_offset(edge_ab, edge_ac);
  cell.piece.lift_most = 0.0;
  std::array<double, 3> agree;
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = weights[i].x, c = weights[i].y;
    cell.piece.corners[i] = a + b * ab + c * ac;
    cell.piece.lift_most = std::max<double>(cell.piece.lift_most,
                                            error_bound_offset(cell.piece.corners[i], n, edge_ab, edge_ac));
    cell.n_shading[i] = (1.0 - b - c) * glm::dvec3(mesh.normals[ids.x]) +
                        b * glm::dvec3(mesh.normals[ids.y]) + c * glm::dvec3(mesh.normals[ids.z]);
    agree[i] = glm::dot(cell.n_shading[i], cell.piece.n);
  }
  const auto none = [](const glm::dvec3& v) { return v == glm::dvec3(0.0); };
  if (std::all_of(cell.n_shading.begin(), cell.n_shading.end(), none)) {  // shared::shading_normal
    cell.n_shading.fill(cell.piece.n);
    agree.fill(1.0);
  }
  // shared::face_viewer turns both normals to the viewer, as one.
  const auto [least, most] = std::minmax_element(agree.begin(), agree.end());
  if (!(*least >= kSure || *most <= -kSure)) return std::nullopt;
  if (*most < 0.0)
    for (glm::dvec3& normal : cell.n_shading) normal = -normal;
  return cell;
}

// Bounds over a cell's points: sines between the light and the surface, and how far the light is.
struct Incidence {
  double geometric_least, geometric_most, shading_least, shading_most;
  double distance_most;
};

Incidence incidence_of(const Cell& cell, const shared::LightParams& light) {
  const bool parallel = light.kind == shared::kLightDirectional;
  Incidence r{kInfinity, -kInfinity, kInfinity, -kInfinity, 0.0};
  std::array<glm::dvec3, 3> ways;
  double normal_most = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    ways[i] = parallel ? -glm::dvec3(light.direction) : glm::dvec3(light.position) - cell.piece.corners[i];
    r.distance_most = std::max(r.distance_most, glm::length(ways[i]));
    normal_most = std::max(normal_most, glm::length(cell.n_shading[i]));
  }
  // Normal and way are both linear over the cell: their product is a mixture of the products at the corners.
  for (const glm::dvec3& way : ways) {
    const double geometric = glm::dot(cell.piece.n, way) / r.distance_most;
    r.geometric_least = std::min(r.geometric_least, geometric);
    r.geometric_most = std::max(r.geometric_most, geometric);
    for (const glm::dvec3& n : cell.n_shading) {
      const double shading = glm::dot(n, way) / (normal_most * r.distance_most);
      r.shading_least = std::min(r.shading_least, shading);
      r.shading_most = std::max(r.shading_most, shading);
    }
  }
  return r;
}

// No more than the light brings any point of the cell (of radiance, before the material).
glm::vec3 least_radiance(const Cell& cell, const shared::LightParams& light, double distance_most) {
  if (light.kind == shared::kLightDirectional) return light.radiance;
  if (!(distance_most < static_cast<double>(light.range) * (1.0 - kSure))) return glm::vec3(0.0f);
  double strength = light.inverse_square ? 1.0 / std::max(distance_most * distance_most, 1e-12) : 1.0;
  if (light.kind == shared::kLightSpot) {
    if (light.cos_outer < 0.0f) return glm::vec3(0.0f);  // the points it reaches are no convex set
    double cos_least = 1.0;
    for (const glm::dvec3& p : cell.piece.corners)
      cos_least = std::min(
          cos_least, glm::dot(glm::normalize(p - glm::dvec3(light.position)), glm::dvec3(light.direction)));
    const double wide = std::max(static_cast<double>(light.cos_inner) - light.cos_outer, 1e-6);
    const double cone = std::clamp((cos_least - kSure - light.cos_outer) / wide, 0.0, 1.0);
    strength *= cone * cone;
  }
  return light.radiance * static_cast<float>(strength);
}

// Whether every point's light is above the least for which rays are fired (and above nothing).
bool bright(const Cell& cell, const shared::LightParams& light, const Incidence& incidence,
            float least_light) {
  const glm::vec3 radiance = least_radiance(cell, light, incidence.distance_most);
  const bool textured = cell.material->diffuse_texture >= 0;  // it may be black
  const glm::vec3 diffuse = textured ? glm::vec3(0.0f) : cell.material->diffuse;
  const glm::vec3 most =
      radiance * (diffuse * static_cast<float>(incidence.shading_least) + cell.material->specular);
  constexpr float kLeastNormal = 1e-30f;
  return std::max({radiance.r, radiance.g, radiance.b}) > kLeastNormal &&
         (least_light <= 0.0f || std::max({most.r, most.g, most.b}) > 1.001f * least_light);
}

}  // namespace

Proof prove(const Mesh& mesh, const BspTree& tree, const CellPlace& place, const shared::LightParams& light,
            float least_light) {
  const std::optional<Cell> cell = make_cell(mesh, place);
  if (!cell) return Proof::none;
  const Incidence incidence = incidence_of(*cell, light);
  if (incidence.geometric_most < -kSure || incidence.shading_most < -kSure) return Proof::turned_away;
  if (!(incidence.geometric_least > kSure && incidence.shading_least > kSure)) return Proof::none;
  if (!bright(*cell, light, incidence, least_light)) return Proof::none;
  const std::optional<Shaft> shaft = Shaft::of(cell->piece, light);
  return shaft && shaft->clear(tree) ? Proof::lit : Proof::none;
}

}  // namespace pinocchio
