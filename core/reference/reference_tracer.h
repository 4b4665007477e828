#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "core/reference/reference_camera.h"
#include "core/reference/reference_environment.h"
#include "core/reference/reference_surface.h"
#include "core/reference/reference_tree.h"
#include "core/trace/rays/trace_options.h"
#include "pinocchio/conversion.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// Draws the reference pixel by pixel. Light along rays: I = Ia + sum over lights of (Id + Is) + Ir(R) + It(T)
// + emission (Whitted, "An Improved Illumination Model for Shaded Display", CACM 23(6), 1980). Every bounce
// is followed, whatever its weight, and glass has two rays for each bounce: the time can double with each
// bounce. May be called from many threads.
class ReferenceTracer {
 public:
  // `tree` may be another scene's with the same triangles. Scene and tree must outlive this object. Only
  // the options for the footprint of textures, the terminator, the passed backs, the shadows of glass, the
  // background and the shadow catcher are used: the reference follows every ray and takes many samples
  // itself. Jitter other than 0 means that the picture is one of many that are averaged; shadows of surfaces
  // that blend are then grey.
  ReferenceTracer(const Scene& scene, const ReferenceTree& tree, const TraceOptions& options = {})
      : scene_(scene), tree_(tree), options_(options) {
    if (scene.environment) environment_.emplace(scene);
    const Backdrop behind = backdrop_of(scene, options.background, options.background_blur);
    behind_scene_ = behind.picture;
    if (behind_scene_)
      backdrop_.emplace(*behind_scene_, as_double(behind.rotation_deg), as_double(behind.strength));
    lobes_ = takes_samples(scene);
    for (const Material& m : scene.mesh->materials) absorbs_ = absorbs_ || m.attenuates();
  }

  struct Pixel {
    std::uint32_t triangle = kNoTriangle;  // at the sample point
    std::vector<bool> mask;                // casting light i reaches the point; empty: none does
    glm::vec3 reflection{0.0f};            // mirrored, refracted and the environment's light, linear
    // Linear; A is 1 if a triangle is hit, 0 if the background is seen, or the share of light that the shadow
    // catcher lost. On a transparent background, surfaces that blend have less than 1.
    glm::vec4 color{0.0f};
  };
  // The pixel (x, y), counted from the first drawn one, with at most `depth` bounces.
  [[nodiscard]] Pixel pixel(const ReferenceCamera& camera, int x, int y, int depth) const;

 private:
  // The surface's light without mirrors, glass and environment: what comes unhindered, and what came through
  // glass.
  struct Direct {
    glm::dvec3 free{0.0}, tinted{0.0};
  };
  Direct direct(const ReferenceSurface& surface, const Material* medium,
                std::vector<bool>* reached = nullptr) const;
  // Behind the scene, by a ray straight from the camera that hits nothing: the background, less what the
  // shadow catcher lost, and that share.
  [[nodiscard]] glm::dvec4 behind(const ReferenceRay& ray) const;
  [[nodiscard]] double lost_on_ground(const ReferenceRay& ray) const;
  // The share of the background that the camera's ray sees through surfaces that blend, less what the shadow
  // catcher holds back of it.
  [[nodiscard]] double left_behind(ReferenceRay ray, ReferenceHit hit, int depth) const;
  [[nodiscard]] glm::dvec3 from_sky(const ReferenceSurface& surface, const Material* medium) const;
  // The footprint of textures at further hits of a ray, and whether it comes from the camera.
  struct Cone {
    double width, angle;
    bool of_camera;
  };
  [[nodiscard]] static Cone cone_after(const ReferenceRay& ray, const ReferenceHit& hit);
  // A glossy surface has lobe_side squared mirrored rays, and fewer at the hits of these rays.
  static constexpr int kLobeSide = 16;
  // The media on the viewer's side of a surface and beyond it; null: a clear one.
  struct Media {
    const Material *here, *beyond;
  };
  [[nodiscard]] Media media_at(const Material* of_ray, const ReferenceHit& hit,
                               const ReferenceSurface& surface) const;
  [[nodiscard]] glm::dvec3 bounced(const ReferenceSurface& surface, int depth, const Cone& cone,
                                   const Media& media, int lobe_side, double density) const;
  [[nodiscard]] glm::dvec3 along_lobe(const ReferenceSurface& surface, int depth, const Cone& cone,
                                      const Media& media, int lobe_side, double density) const;
  // The light along a ray that begins in `medium`. density: of the ray's direction, where samples of the
  // environment find it too; else 0.
  [[nodiscard]] glm::dvec3 seen(const ReferenceRay& ray, const Material* medium, int depth, int lobe_side,
                                double density) const;

  [[nodiscard]] ReferenceHit closest_hit(const ReferenceRay& ray) const;
  [[nodiscard]] bool passes_back(const ReferenceRay& ray, std::uint32_t triangle) const;
  // The shares of a light that come along a ray that begins in `medium`: unhindered, and through glass and
  // what blends.
  struct Arrival {
    double free = 1.0;
    glm::dvec3 tinted{0.0};
    [[nodiscard]] glm::dvec3 all() const { return free + tinted; }
  };
  [[nodiscard]] Arrival arriving(const ReferenceRay& ray, const Material* medium) const;
  [[nodiscard]] glm::dvec3 passing(const ReferenceSurface& surface) const;
  [[nodiscard]] glm::dvec3 passing_glass(const ReferenceSurface& surface) const;
  // The material of the innermost body that absorbs light around the eye; null: none.
  [[nodiscard]] const Material* medium_of_eye(const ReferenceCamera& camera) const;

  const Scene& scene_;
  const ReferenceTree& tree_;
  TraceOptions options_;
  std::shared_ptr<const Environment> behind_scene_;  // kept for `backdrop_`
  std::optional<ReferenceEnvironment> environment_, backdrop_;
  bool lobes_ = false;    // glossy lobes are sampled; else mirrors are sharp
  bool absorbs_ = false;  // some material absorbs light
};

}  // namespace pinocchio
