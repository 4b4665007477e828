#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "core/reference/reference_environment.h"
#include "core/reference/reference_surface.h"
#include "core/reference/reference_tree.h"
#include "core/trace/trace_options.h"
#include "pinocchio/scene.h"
#include "pinocchio/terminator.h"

namespace pinocchio {

// The reference, a pixel at a time. Light along rays: I = Ia + sum over lights of (Id + Is) + Ir(R) + It(T)
// + emission (Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980). Every bounce
// is followed whatever it is worth, and in glass each is two: time can double with each bounce. Safe to call
// from many threads.
class ReferenceTracer {
 public:
  // `tree` may be of another scene with the same triangles. Both stay as long as this lives.
  // Of the options it follows the footprint of textures and the terminator. Jitter other than 0: the picture
  // is one of many that are averaged, so that shadows of surfaces that blend may be grey. It follows every
  // ray and takes many samples of its own, so cut-offs and the choice of a sample mean nothing to it.
  ReferenceTracer(const Scene& scene, const ReferenceTree& tree, const TraceOptions& options = {})
      : scene_(scene),
        tree_(tree),
        texture_footprint_(options.texture_footprint),
        one_of_many_(options.jitter != glm::vec2(0.0f)),
        terminator_(options.terminator) {
    if (scene.environment) environment_.emplace(scene);
  }

  struct Pixel {
    std::uint32_t triangle = kNoTriangle;  // seen at the sample point
    unsigned mask = 0;                     // bit i: casting light i reaches it
    glm::vec3 reflection{0.0f};            // mirrored plus refracted light, and the environment's, linear
    glm::vec4 color{0.0f};  // linear; A is 1 where something is hit, else the environment is seen
  };
  // The pixel (x, y), counted from view.first; `depth` bounces at most.
  [[nodiscard]] Pixel pixel(const shared::ViewParams& view, int x, int y, int depth) const;

 private:
  glm::dvec3 direct(const ReferenceSurface& surface, unsigned& bits) const;
  [[nodiscard]] glm::dvec3 from_sky(const ReferenceSurface& surface) const;
  // What textures are averaged over behind a hit.
  struct Cone {
    double width, angle;
  };
  [[nodiscard]] static Cone cone_after(const ReferenceRay& ray, const ReferenceHit& hit);
  // A glossy surface's mirrored rays are lobe_side squared; fewer for those that they meet.
  static constexpr int kLobeSide = 16;
  // What lies on the viewer's side of a surface, and what beyond it; null: what takes no light.
  struct Media {
    const Material *here, *beyond;
  };
  [[nodiscard]] Media media_at(const Material* of_ray, const ReferenceHit& hit,
                               const ReferenceSurface& surface) const;
  [[nodiscard]] glm::dvec3 bounced(const ReferenceSurface& surface, int depth, const Cone& cone,
                                   const Media& media, int lobe_side) const;
  // Along a ray that begins in `medium`.
  [[nodiscard]] glm::dvec3 seen(const ReferenceRay& ray, const Material* medium, int depth,
                                int lobe_side) const;

  [[nodiscard]] ReferenceHit closest_hit(const ReferenceRay& ray) const;
  [[nodiscard]] double unblocked(const ReferenceRay& ray) const;

  const Scene& scene_;
  const ReferenceTree& tree_;
  double texture_footprint_;
  bool one_of_many_;
  Terminator terminator_;
  std::optional<ReferenceEnvironment> environment_;
};

// The ray of the pixel (x, y); its t is z_eye.
[[nodiscard]] ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y);

}  // namespace pinocchio
