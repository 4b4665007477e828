// A whole picture of a scene over Embree's rays, one at a time and recursive, as a user of Embree writes it:
// Phong, a shadow ray to each light, mirrors, glass, textures. Materials and mirrored rays are computed by
// our functions, so that the picture is comparable; the shadow terminator is as it comes.
#pragma once

#include <embree3/rtcore.h>

#include "core/parallel/workers.h"
#include "core/trace/footprint.h"
#include "core/trace/shared.h"
#include "core/trace/surface.h"
#include "pinocchio/image.h"
#include "pinocchio/scene.h"

namespace pinocchio {

class EmbreePicture {
 public:
  // The scene stays where it is as long as this lives. depth: most bounces.
  EmbreePicture(const Scene& scene, int threads, int depth);
  ~EmbreePicture();
  EmbreePicture(const EmbreePicture&) = delete;
  EmbreePicture& operator=(const EmbreePicture&) = delete;

  // Linear; of picture's size. Tiles of 8 x 8 pixels are shared out among the threads.
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
  // What comes along the ray, times `throughput`.
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
