#include "core/trace/settled/known_lights.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math/components.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Nothing is certain if a light is nearer to the triangle's plane than this share of the largest coordinate:
// rounding could move it to the other side.
constexpr double kLeastShare = 0x1p-12;

// Edges, and distances to a light, outside these are not judged: in single precision, products of them could
// overflow or round to 0.
constexpr double kLeastLength = 1e-9, kMostLength = 1e7;

// How much of a light's brightness is left out for roundings.
constexpr double kLess = 1.0 - 1e-3;

// A part of a triangle, its normals on the viewer's side.
struct Facet {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal{0.0};               // unit
  std::array<glm::dvec3, 3> normals{};  // interpolated at the corners
  double most = 0.0;                    // the largest coordinate

  // None: the triangle is too thin, too small or too large.
  static std::optional<Facet> of(const Mesh& mesh, const PartOfMesh& part, bool from_front) {
    const glm::uvec3& corners = mesh.triangles[part.triangle];
    std::array<glm::dvec3, 3> p, normals;
    Facet facet;
    for (int i = 0; i < 3; ++i) {
      p[as_size(i)] = glm::dvec3(mesh.positions[corners[i]]);
      normals[as_size(i)] = glm::dvec3(mesh.normals[corners[i]]);
      facet.most = std::max(facet.most, largest_component(glm::abs(p[as_size(i)])));
    }
    const glm::dvec3 ab = p[1] - p[0], ac = p[2] - p[0], n = glm::cross(ab, ac);
    const double b = glm::length(ab), c = glm::length(ac), length = glm::length(n);
    if (!(kLeastLength < std::min(b, c) && std::max(b, c) < kMostLength && kCertainSine * b * c < length))
      return {};
    facet.normal = (from_front ? 1.0 : -1.0) / length * n;
    const TrianglePart weights = part.number ? part_of_inside(*part.number) : whole_inside();
    // Interpolated normals are turned to the viewer with the triangle's own, which stands for them where they
    // are zero.
    const bool turned = std::ranges::any_of(
        normals, [&](const glm::dvec3& vertex) { return glm::dot(vertex, facet.normal) < 0.0; });
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3& at = weights[i];
      facet.corners[i] = at.x * p[0] + at.y * p[1] + at.z * p[2];
      const glm::dvec3 mixed = at.x * normals[0] + at.y * normals[1] + at.z * normals[2];
      facet.normals[i] = mixed == glm::dvec3(0.0) ? facet.normal : turned ? -mixed : mixed;
    }
    return facet;
  }

  // True if the normals at the corners, and so all between them, are on the triangle's side that `normal` is
  // on.
  [[nodiscard]] bool is_smooth() const {
    return std::ranges::all_of(
        normals, [&](const glm::dvec3& n) { return kCertainCosine * glm::length(n) < glm::dot(normal, n); });
  }
};

// The least and greatest of some numbers.
struct Range {
  double lo = INFINITY, hi = -INFINITY;
  void add(double x) {
    lo = std::min(lo, x);
    hi = std::max(hi, x);
  }
};

// A light, as the points of a facet see it.
class LightAtFacet {
 public:
  LightAtFacet(const MaskLight& light, const Facet& facet) : light_(light.params) {
    const bool far = light_.kind == shared::kLightDirectional;
    for (const glm::dvec3& p : facet.corners) {
      const glm::dvec3 way = far ? -glm::dvec3(light_.direction) : glm::dvec3(light_.position) - p;
      const double length = glm::length(way);
      const glm::dvec3 unit = way / length;
      distance_.add(far ? 1.0 : length);
      cosine_.add(glm::dot(facet.normal, unit));
      for (const glm::dvec3& n : facet.normals) {
        of_normals_.add(glm::dot(n, unit) / glm::length(n));
        scaled_.add(glm::dot(n, way) / glm::length(n));
      }
      in_cone_.add(-glm::dot(unit, glm::dvec3(light_.direction)));
    }
    if (far) return;
    const double plane = std::abs(glm::dot(facet.normal, glm::dvec3(light_.position) - facet.corners[0]));
    const double most = std::max(facet.most, largest_component(glm::abs(glm::dvec3(light_.position))));
    is_certain_ = kLeastShare * most < plane && kLeastLength < distance_.lo && distance_.hi < kMostLength;
  }

  [[nodiscard]] bool is_in_front() const { return is_certain_ && kCertainCosine < cosine_.lo; }
  [[nodiscard]] bool is_behind() const { return is_certain_ && cosine_.hi < -kCertainCosine; }
  // True if the normals at all corners, and so all between them, have the light in front; behind.
  [[nodiscard]] bool is_in_front_of_normals() const { return kCertainCosine < of_normals_.lo; }
  [[nodiscard]] bool is_behind_normals() const { return of_normals_.hi < -kCertainCosine; }

  // The least share of the light's radiance that a point gets.
  [[nodiscard]] double least_share() const {
    if (light_.kind == shared::kLightDirectional) return 1.0;
    double share = kLess;
    if (light_.range <= 1e30f) {
      const double q = distance_.hi / (kLess * double{light_.range});
      if (!(q < 1.0)) return 0.0;
      if (light_.inverse_square) share *= 1.0 - q * q * q * q;
    }
    if (light_.inverse_square) share /= std::max(distance_.hi * distance_.hi, double{shared::kLeastSquare});
    if (light_.kind == shared::kLightSpot) {
      // Directions within less than a right angle of another one are a convex set.
      const double outer{light_.cos_outer}, width = double{light_.cos_inner} - outer;
      const double past = in_cone_.lo - 1e-4 - outer;
      if (!(in_cone_.lo > 1e-3 && past > 0.0)) return 0.0;
      const double cone = std::min(past / std::max(width, 1e-6), 1.0);
      share *= cone * cone;
    }
    return share;
  }

  // A lower bound of the cosine that shading uses, where is_in_front_of_normals().
  [[nodiscard]] double least_n_dot_l() const {
    // Interpolated normals are divided by their length, which is at most the mean of the corners'.
    return scaled_.lo / distance_.hi;
  }

 private:
  const shared::LightParams& light_;
  Range distance_, cosine_, of_normals_, scaled_, in_cone_;
  bool is_certain_ = true;
};

// A lower bound of the light that a point without textures gets, in its brightest colour. The cutoff is
// compared with most_light (lanes/steps.h), which is more.
double least_light(const Material& m, const glm::dvec3& radiance, double n_dot_l) {
  return kLess * largest_component(radiance * (glm::dvec3(m.diffuse) * n_dot_l + glm::dvec3(m.specular)));
}

enum class Reaches { all, none, unsure };

Reaches reaches(const MaskLight& light, const PartOfMesh& part, const Facet& facet, const Material& m,
                float cutoff) {
  const LightAtFacet seen(light, facet);
  const glm::dvec3 radiance(light.params.radiance);
  // Where only the interpolated normal is turned to the light, a ray may be lifted (ShadowStarts).
  if (seen.is_behind())
    return facet.is_smooth() && seen.is_behind_normals() ? Reaches::none : Reaches::unsure;
  if (!seen.is_in_front()) return Reaches::unsure;
  const double share = seen.least_share();
  constexpr double kLeastRadiance = 1e-15;  // far above what rounds to 0
  if (!(kLeastRadiance < share * largest_component(radiance))) return Reaches::unsure;
  if (m.maps < 0) {
    if (!facet.is_smooth() || !seen.is_in_front_of_normals()) return Reaches::unsure;
    if (!(double{cutoff} < least_light(m, share * radiance, seen.least_n_dot_l()))) return Reaches::unsure;
  }
  const ClearWays::Way way = light.ways->known_way(part.triangle);
  const bool clear =
      way == ClearWays::Way::clear || (way == ClearWays::Way::by_part && part.number &&
                                       light.ways->is_part_known_clear(part.triangle, *part.number));
  return clear ? Reaches::all : Reaches::unsure;
}

}  // namespace

// Of glTF's model without textures the light is not bounded from below.
bool may_know_lights(const Material& m) {
  return m.maps >= 0 || !m.is_microfacet();
}

std::optional<std::uint8_t> known_lights(const Mesh& mesh, const PartOfMesh& part, bool from_front,
                                         const std::vector<MaskLight>& lights, float cutoff) {
  if (lights.empty()) return 0;
  const std::optional<Facet> facet = Facet::of(mesh, part, from_front);
  if (!facet) return {};
  const Material& m = mesh.materials[mesh.triangle_materials[part.triangle]];
  unsigned bits = 0;
  for (const MaskLight& light : lights) {
    const Reaches found = reaches(light, part, *facet, m, cutoff);
    if (found == Reaches::unsure) return {};
    if (found == Reaches::all) bits |= 1u << light.bit;
  }
  return static_cast<std::uint8_t>(bits);
}

}  // namespace pinocchio
