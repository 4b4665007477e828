#include "core/reference/reference_tracer.h"

#include "core/reference/reference_shading.h"

namespace pinocchio {

ReferenceTracer::Pixel ReferenceTracer::pixel(const shared::ViewParams& view, int x, int y, int depth) const {
  const ReferenceRay ray = reference_pixel_ray(view, x, y);
  const ReferenceHit hit = tree_.closest_hit(ray);
  Pixel pixel;
  pixel.triangle = hit.triangle;
  if (!hit.valid()) return pixel;
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit);
  const glm::dvec3 own = direct(surface, pixel.mask), mirrored = bounced(surface, depth);
  pixel.reflection = glm::vec3(mirrored);
  pixel.color = glm::vec4(glm::vec3(own + mirrored), 1.0f);
  return pixel;
}

// The surface's light without mirrors and glass. Sets bit i of `bits` where casting light i reaches it.
glm::dvec3 ReferenceTracer::direct(const ReferenceSurface& surface, unsigned& bits) const {
  glm::dvec3 sum =
      surface.ambient * glm::dvec3(scene_.ambient_light) + glm::dvec3(surface.material->emission);
  int slot = -1;
  for (const Light& light : scene_.lights) {
    if (light.casts_shadow) ++slot;
    const std::optional<ReferenceLight> incident = reference_light(light, surface);
    if (!incident) continue;
    if (light.casts_shadow) {
      if (tree_.occluded(incident->shadow)) continue;
      bits |= 1u << slot;
    }
    sum += reference_phong(surface, *incident);
  }
  return sum;
}

// Ir(R) + It(T), following `depth` bounces at most.
glm::dvec3 ReferenceTracer::bounced(const ReferenceSurface& surface, int depth) const {
  glm::dvec3 sum(0.0);
  if (depth <= 0) return sum;
  for (const ReferenceBounce& bounce : reference_bounces(surface))
    if (bounce.weight != glm::dvec3(0.0)) sum += bounce.weight * seen(bounce.ray, depth - 1);
  return sum;
}

glm::dvec3 ReferenceTracer::seen(const ReferenceRay& ray, int depth) const {
  const ReferenceHit hit = tree_.closest_hit(ray);
  if (!hit.valid()) return glm::dvec3(0.0);
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit);
  unsigned bits = 0;
  return direct(surface, bits) + bounced(surface, depth);
}

ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y) {
  const glm::dvec2 at = glm::dvec2(view.first) + glm::dvec2(x, y);
  return {glm::dvec3(view.eye),
          glm::dvec3(view.corner) + at.x * glm::dvec3(view.step_x) + at.y * glm::dvec3(view.step_y)};
}

}  // namespace pinocchio
