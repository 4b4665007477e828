#include "core/reference/reference.h"

#include <cassert>

#include "core/parallel/tiles.h"
#include "core/reference/reference_shading.h"
#include "core/reference/reference_surface.h"
#include "core/reference/reference_tree.h"

namespace pinocchio {
namespace {

// Light along rays: I = Ia + sum over lights of (Id + Is) + Ir(R) + It(T) + emission (Whitted, "An Improved
// Illumination Model for Shaded Display", CACM 23(6), 1980).
class Whitted {
 public:
  explicit Whitted(const Scene& scene) : scene_(scene), tree_(scene) {}

  [[nodiscard]] ReferenceHit closest_hit(const ReferenceRay& ray) const { return tree_.closest_hit(ray); }

  // The surface's light without mirrors and glass. Sets bit i of `bits` where casting light i reaches it.
  glm::dvec3 direct(const ReferenceSurface& surface, unsigned& bits) const {
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
  [[nodiscard]] glm::dvec3 bounced(const ReferenceSurface& surface, int depth) const {
    glm::dvec3 sum(0.0);
    if (depth <= 0) return sum;
    for (const ReferenceBounce& bounce : reference_bounces(surface))
      if (bounce.weight != glm::dvec3(0.0)) sum += bounce.weight * seen(bounce.ray, depth - 1);
    return sum;
  }

 private:
  [[nodiscard]] glm::dvec3 seen(const ReferenceRay& ray, int depth) const {
    const ReferenceHit hit = tree_.closest_hit(ray);
    if (!hit.valid()) return glm::dvec3(0.0);
    const ReferenceSurface surface = reference_surface(scene_, ray, hit);
    unsigned bits = 0;
    return direct(surface, bits) + bounced(surface, depth);
  }

  const Scene& scene_;
  ReferenceTree tree_;
};

}  // namespace

ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y) {
  const glm::dvec2 at = glm::dvec2(view.first) + glm::dvec2(x, y);
  return {glm::dvec3(view.eye),
          glm::dvec3(view.corner) + at.x * glm::dvec3(view.step_x) + at.y * glm::dvec3(view.step_y)};
}

void reference_picture(const Scene& scene, Workers& workers, const shared::ViewParams& view, int depth,
                       Image<std::uint32_t>& ids, MaskImage& mask, Image<glm::vec3>& reflection,
                       Image<glm::vec4>& color) {
  const auto casting = static_cast<int>(casting_lights(scene).size());
  assert(casting <= kMaxCastingLights);
  mask.resize(ids.size(), MaskImage::bits_for(casting));
  reflection = depth > 0 ? Image<glm::vec3>(ids.size()) : Image<glm::vec3>();
  color = Image<glm::vec4>(ids.size());

  const Whitted whitted(scene);
  const auto draw_pixel = [&](int x, int y) {
    const ReferenceRay ray = reference_pixel_ray(view, x, y);
    const ReferenceHit hit = whitted.closest_hit(ray);
    ids.at(x, y) = hit.triangle;
    if (!hit.valid()) return;
    const ReferenceSurface surface = reference_surface(scene, ray, hit);
    unsigned bits = 0;
    const glm::dvec3 direct = whitted.direct(surface, bits), bounced = whitted.bounced(surface, depth);
    for (int slot = 0; slot < casting; ++slot)
      if (bits >> slot & 1u) mask.set_bit(x, y, slot);
    if (depth > 0) reflection.at(x, y) = glm::vec3(bounced);
    color.at(x, y) = glm::vec4(glm::vec3(direct + bounced), 1.0f);
  };
  const TileGrid grid(ids.size());  // a tile's row is whole bytes of the mask
  workers.for_each(grid.count(), [&](std::size_t i) { TileGrid::for_each_pixel(grid.tile(i), draw_pixel); });
}

}  // namespace pinocchio
