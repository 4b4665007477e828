#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "core/shade/footprint.h"
#include "core/trace/rays/ray_queue.h"
#include "pinocchio/view.h"

namespace pinocchio {

// The rays of a picture that no rasteriser draws: a panorama, a fisheye, a distorted lens, or the caller's
// rays. They are computed pixel by pixel, in double precision.
class RayModel {
 public:
  // None: the picture's rays are those of view_params.
  [[nodiscard]] static std::optional<RayModel> of(const View& view);

  // The ray of the pixel (x, y), counted from the first drawn one. Its direction is zero where the pixel sees
  // nothing.
  [[nodiscard]] Ray ray(int x, int y) const;
  // Its direction before it is rounded.
  [[nodiscard]] glm::dvec3 exact_direction(int x, int y) const;
  // Sets the rays of the tile at `corner`, whose pixels are set, `bits` bits of them across.
  void fill(glm::ivec2 corner, int bits, RayQueue& rays) const;
  // The part of a surface over which textures are averaged, near the pixel. `side`: of a sample's share of
  // its pixel. None for the caller's rays, whose neighbours are unknown.
  [[nodiscard]] Footprint footprint(glm::ivec2 pixel, float side) const;
  // Whether all rays begin at the camera.
  [[nodiscard]] bool has_one_eye() const { return !view_.rays; }
  // The direction that depth is measured along; zero: it is the distance from the eye.
  [[nodiscard]] glm::vec3 depth_axis() const;

 private:
  explicit RayModel(const View& view);
  // In camera space: x right, y down, z forward. `pixel`: a place in the whole picture, 0 is the edge.
  [[nodiscard]] glm::dvec3 direction(glm::dvec2 pixel) const;
  [[nodiscard]] glm::dvec3 to_world(const glm::dvec3& direction) const;
  [[nodiscard]] std::size_t number_of(int x, int y) const;  // of the caller's ray

  View view_;
  CameraAxes axes_;
  Intrinsics intrinsics_;
  glm::ivec2 first_;
};

}  // namespace pinocchio
