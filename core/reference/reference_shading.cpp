#include "core/reference/reference_shading.h"

#include <algorithm>
#include <cmath>

namespace pinocchio {
namespace {

double square(double x) {
  return x * x;
}

// Between the two cones, as KHR_lights_punctual has it.
double cone_share(const Light& light, const glm::dvec3& to_light) {
  const double cos_angle = -glm::dot(to_light, glm::dvec3(light.direction));
  const double outer = light.cos_outer, width = static_cast<double>(light.cos_inner) - outer;
  return square(std::clamp((cos_angle - outer) / std::max(width, 1e-6), 0.0, 1.0));
}

// Share of unpolarised light that a smooth dielectric mirrors (Born and Wolf, Principles of Optics, 1.5.2).
// eta: index where the light goes over index where it comes from.
double fresnel(double cos_in, double eta) {
  const double sin2_out = (1.0 - square(cos_in)) / square(eta);  // Snell
  if (sin2_out >= 1.0) return 1.0;
  const double cos_out = std::sqrt(1.0 - sin2_out);
  const double parallel = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  const double perpendicular = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  return 0.5 * (square(parallel) + square(perpendicular));
}

// Chiang, Li and Burley 2019: less light the nearer the facet is to turning away.
double smoothing_at(const ReferenceSurface& s, const glm::dvec3& to_light) {
  const double g = std::min(1.0, glm::dot(s.n_geometric, to_light) /
                                     (glm::dot(s.n_shading, to_light) * glm::dot(s.n_shading, s.n_geometric)));
  return -g * g * g + g * g + g;
}

// About the shading normal, unless that sends the ray into the surface; then about the geometric one.
glm::dvec3 mirrored(const ReferenceSurface& s) {
  const auto about = [&s](const glm::dvec3& n) { return 2.0 * glm::dot(n, s.to_viewer) * n - s.to_viewer; };
  const glm::dvec3 direction = about(s.n_shading);
  return glm::dot(direction, s.n_geometric) > 0.0 ? direction : about(s.n_geometric);
}

// Likewise out of the surface. Zero where all is mirrored.
glm::dvec3 refracted(const ReferenceSurface& s, double eta) {
  const auto through = [&](const glm::dvec3& n) {
    const double cos_in = glm::dot(n, s.to_viewer);
    const double cos2_out = 1.0 - (1.0 - square(cos_in)) / square(eta);
    if (cos2_out < 0.0) return glm::dvec3(0.0);
    return (cos_in * n - s.to_viewer) / eta - std::sqrt(cos2_out) * n;
  };
  const glm::dvec3 direction = through(s.n_shading);
  return glm::dot(direction, s.n_geometric) < 0.0 ? direction : through(s.n_geometric);
}

ReferenceBounce bounce(const ReferenceSurface& s, const glm::dvec3& direction, const glm::dvec3& weight) {
  if (direction == glm::dvec3(0.0)) return {};
  return {weight, {leave(s, direction), direction}};
}

}  // namespace

std::optional<ReferenceLight> reference_light(const Light& light, const ReferenceSurface& surface,
                                              Terminator terminator) {
  ReferenceLight result;
  result.radiance = glm::dvec3(light.color) * static_cast<double>(light.intensity);
  const bool directional = light.kind == Light::Kind::directional;
  if (directional) {
    result.to_light = -glm::dvec3(light.direction);
  } else {
    const glm::dvec3 offset = glm::dvec3(light.position) - surface.p_world;
    const double distance = glm::length(offset);
    if (distance == 0.0 || distance > static_cast<double>(light.range)) return std::nullopt;
    result.to_light = offset / distance;
    if (light.falloff == Light::Falloff::inverse_square) result.radiance /= std::max(square(distance), 1e-12);
    if (light.kind == Light::Kind::spot) result.radiance *= cone_share(light, result.to_light);
  }
  if (result.radiance == glm::dvec3(0.0)) return std::nullopt;
  if (glm::dot(surface.n_shading, result.to_light) <= 0.0) return std::nullopt;
  const bool turned_away = glm::dot(surface.n_geometric, result.to_light) <= 0.0;
  const bool can_lift = lifts(terminator) && surface.lift != glm::dvec3(0.0);
  if (turned_away && !(can_lift && glm::dot(surface.n_vertices, result.to_light) > 0.0)) return std::nullopt;
  const bool lifted = can_lift && (turned_away || terminator == Terminator::displaced);
  const glm::dvec3 origin = lifted ? leave_lifted(surface) : leave(surface, result.to_light);
  if (lifted && terminator == Terminator::turned_away) {
    const glm::dvec3 from = leave(surface, surface.n_geometric);
    result.way_up = ReferenceRay{from, origin - from, 1.0};
  }
  if (terminator == Terminator::smoothed) result.radiance *= smoothing_at(surface, result.to_light);
  result.shadow = directional ? ReferenceRay{origin, result.to_light}
                              : ReferenceRay{origin, glm::dvec3(light.position) - origin, 1.0};
  return result;
}

glm::dvec3 reference_phong(const ReferenceSurface& s, const ReferenceLight& light) {
  const double n_dot_l = glm::dot(s.n_shading, light.to_light);
  const double r_dot_v = glm::dot(2.0 * n_dot_l * s.n_shading - light.to_light, s.to_viewer);
  const double highlight = r_dot_v > 0.0 ? std::pow(r_dot_v, s.material.shininess) : 0.0;
  return light.radiance * (s.material.diffuse * n_dot_l + s.material.specular * highlight);
}

std::array<ReferenceBounce, 3> reference_bounces(const ReferenceSurface& s) {
  const ReferenceMaterial& m = s.material;
  const double cos_in = std::clamp(glm::dot(s.n_shading, s.to_viewer), 0.0, 1.0), own = m.alpha;
  const ReferenceBounce straight =
      own < 1.0 ? bounce(s, -s.to_viewer, glm::dvec3(1.0 - own)) : ReferenceBounce{};
  if (m.transmits()) {
    const double ior = m.ior, eta = s.leaving ? 1.0 / ior : ior;
    const glm::dvec3 through = refracted(s, eta);
    // Where the two normals disagree there may be no way through although Fresnel has a share for it.
    const double share = through == glm::dvec3(0.0) ? 1.0 : fresnel(cos_in, eta);
    return {bounce(s, mirrored(s), glm::dvec3(own * share)),
            bounce(s, through, own * (1.0 - share) * m.transmittance), straight};
  }
  if (!m.reflects()) return {ReferenceBounce{}, ReferenceBounce{}, straight};
  // Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
  const double grazing = m.fresnel ? std::pow(1.0 - cos_in, 5.0) : 0.0;
  const glm::dvec3 share = m.reflectance + (1.0 - m.reflectance) * grazing;
  return {bounce(s, mirrored(s), own * share), ReferenceBounce{}, straight};
}

}  // namespace pinocchio
