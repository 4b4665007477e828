#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "core/reference/reference_hit.h"
#include "core/reference/reference_surface.h"
#include "core/shade/shared.h"
#include "core/trace/view/ray_model.h"

namespace pinocchio {

// The camera rays of a view.
class ReferenceCamera {
 public:
  explicit ReferenceCamera(const View& view);

  struct PixelRay {
    ReferenceRay ray;           // direction zero: the pixel sees nothing
    glm::dvec3 step_x, step_y;  // the sides of a sample's share of the pixel, at t = 1
    bool parallel;              // the sides are the same at any t

    [[nodiscard]] bool sees() const { return ray.direction != glm::dvec3(0.0); }
    // The part of a surface at t over which its textures are averaged.
    [[nodiscard]] ReferenceSpread spread_at(double t) const;
  };
  // The ray of the pixel (x, y), counted from the first drawn one. `footprint`:
  // TraceOptions::texture_footprint.
  [[nodiscard]] PixelRay pixel(int x, int y, float footprint) const;

  // The point that all rays start from; none: each pixel has one of its own.
  [[nodiscard]] std::optional<glm::dvec3> eye() const;

 private:
  shared::ViewParams params_;
  std::optional<RayModel> model_;  // of views that OpenGL cannot draw; none: `params_` alone
};

// The ray of the pixel (x, y). Its t is z_eye.
[[nodiscard]] ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y);

}  // namespace pinocchio
