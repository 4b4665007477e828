// A whole picture of a scene with Embree's rays, one at a time and recursive, as a user of Embree writes it:
// Phong, a shadow ray to each light, mirrors, glass, textures. Our functions compute materials and mirrored
// rays, so that pictures can be compared. The shadow terminator is not treated.
#pragma once

#include <embree3/rtcore.h>

#include "bench/one_ray/surface_at.h"
#include "core/parallel/workers.h"
#include "core/shade/footprint.h"
#include "core/shade/shared.h"
#include "pinocchio/image.h"
#include "pinocchio/scene.h"

namespace pinocchio {

class EmbreePicture {
 public:
  // The scene must outlive this object. depth: most bounces.
  EmbreePicture(const Scene& scene, int threads, int depth);
  ~EmbreePicture();
  EmbreePicture(const EmbreePicture&) = delete;
  EmbreePicture& operator=(const EmbreePicture&) = delete;

  // Linear, of the picture's size. The threads share tiles of 8 x 8 pixels.
  void draw(const Camera& camera, Workers& workers, Image<glm::vec4>& picture) const;

 private:
  struct Hit {
    std::uint32_t triangle = kNoTriangle;
    glm::vec3 weights{0.0f};
  };
  [[nodiscard]] Hit closest_hit(Ray ray) const;
  [[nodiscard]] bool occluded(const Ray& ray) const;
  [[nodiscard]] SurfaceInteraction surface_of(const Hit& hit, const Ray& ray,
                                              const Footprint& footprint) const;
  [[nodiscard]] glm::vec3 direct(const SurfaceInteraction& surface) const;
  // The light along the ray, times `throughput`.
  [[nodiscard]] glm::vec4 seen(const Ray& ray, const glm::vec3& throughput, const Footprint& footprint,
                               int depth) const;

  const Scene& scene_;
  std::vector<shared::LightParams> lights_;
  bool has_holes_;
  int depth_;
  RTCDevice device_;
  RTCScene embree_;
};

}  // namespace pinocchio
