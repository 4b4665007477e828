#include "bench/peers/embree_scatter.h"

#include <algorithm>
#include <cmath>

namespace pinocchio {
namespace {

void push(const SurfaceInteraction& surface, const glm::vec3& direction, const glm::vec3& throughput,
          float least, std::vector<PathRay>& out) {
  if (std::max({throughput.x, throughput.y, throughput.z}) < least) return;
  out.push_back({{offset_origin(surface, direction), kInfinity, direction}, throughput});
}

// Mirrors about the shading normal, or about the geometric normal if the ray would enter the surface.
glm::vec3 mirrored(const SurfaceInteraction& surface) {
  const glm::vec3 direction = glm::reflect(-surface.to_viewer, surface.n_shading);
  return glm::dot(direction, surface.n_geometric) > 0.0f
             ? direction
             : glm::reflect(-surface.to_viewer, surface.n_geometric);
}

// Refracts in the same way; zero beyond the critical angle. glm::refract takes the inverse of eta.
glm::vec3 refracted(const SurfaceInteraction& surface, float eta) {
  const glm::vec3 direction = glm::refract(-surface.to_viewer, surface.n_shading, 1.0f / eta);
  return glm::dot(direction, surface.n_geometric) < 0.0f
             ? direction
             : glm::refract(-surface.to_viewer, surface.n_geometric, 1.0f / eta);
}

// The share of unpolarised light that a smooth dielectric mirrors (Fresnel). eta: the index on the far side
// divided by the index on the near side; cos_in in [0, 1].
float fresnel_dielectric(float cos_in, float eta) {
  const float sin2_out = (1.0f - cos_in * cos_in) / (eta * eta);
  if (sin2_out >= 1.0f) return 1.0f;
  const float cos_out = std::sqrt(1.0f - sin2_out);
  const float parallel = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  const float perpendicular = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

}  // namespace

void scatter(const SurfaceInteraction& surface, const glm::vec3& throughput, float least,
             std::vector<PathRay>& out) {
  const shared::MaterialPoint& m = surface.material;
  const float cos_in = std::clamp(glm::dot(surface.n_shading, surface.to_viewer), 0.0f, 1.0f);
  const glm::vec3 own = surface.alpha < 1.0f ? throughput * surface.alpha : throughput;
  if (m.transmittance.x + m.transmittance.y + m.transmittance.z > 0.0f) {
    const float eta = surface.leaving ? 1.0f / m.ior : m.ior;
    const glm::vec3 through = refracted(surface, eta);
    // If the two normals disagree, there may be no refracted ray although Fresnel's share is not zero.
    const float share = through == glm::vec3(0.0f) ? 1.0f : fresnel_dielectric(cos_in, eta);
    push(surface, mirrored(surface), own * share, least, out);
    push(surface, through, own * (1.0f - share) * m.transmittance, least, out);
  } else if (m.reflectance.x + m.reflectance.y + m.reflectance.z > 0.0f) {
    const float grazing = m.fresnel ? std::pow(1.0f - cos_in, 5.0f) : 0.0f;
    push(surface, mirrored(surface), own * (m.reflectance + (1.0f - m.reflectance) * grazing), least, out);
  }
  if (surface.alpha < 1.0f)
    push(surface, -surface.to_viewer, throughput * (1.0f - surface.alpha), least, out);
}

}  // namespace pinocchio
