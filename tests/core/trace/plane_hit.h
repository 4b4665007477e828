// The point where a camera ray meets a triangle's plane, computed in double precision.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "core/shade/shared.h"

namespace pinocchio {

struct PlaneHit {
  glm::dvec3 weights, normal;
  double t, cosine;  // cosine: of the angle to the normal
  double longest;    // side of the pixel's footprint on the plane
};

inline PlaneHit plane_hit_of(const std::array<glm::vec3, 3>& corners, const shared::ViewParams& view, int x,
                             int y) {
  const glm::dvec2 pixel = glm::dvec2(view.first) + glm::dvec2(x, y);
  const glm::dvec3 step_x(view.step_x), step_y(view.step_y), moved = step_x * pixel.x + step_y * pixel.y;
  const glm::dvec3 origin = glm::dvec3(view.eye) + (view.parallel ? moved : glm::dvec3(0.0));
  const glm::dvec3 direction = glm::dvec3(view.corner) + (view.parallel ? glm::dvec3(0.0) : moved);
  const glm::dvec3 a(corners[0]), b(corners[1]), c(corners[2]);
  PlaneHit hit;
  hit.normal = glm::cross(b - a, c - a);
  const double along = glm::dot(hit.normal, direction), square = glm::dot(hit.normal, hit.normal);
  hit.t = glm::dot(hit.normal, a - origin) / along;
  const glm::dvec3 p = origin + hit.t * direction;
  hit.weights = {glm::dot(hit.normal, glm::cross(b - p, c - p)) / square,
                 glm::dot(hit.normal, glm::cross(c - p, a - p)) / square,
                 glm::dot(hit.normal, glm::cross(a - p, b - p)) / square};
  hit.cosine = std::abs(along) / (std::sqrt(square) * glm::length(direction));
  const double scale = view.parallel ? 1.0 : hit.t;
  const auto on_plane = [&](const glm::dvec3& step) {
    return scale * glm::length(step - glm::dot(hit.normal, step) / along * direction);
  };
  hit.longest = std::max(on_plane(step_x), on_plane(step_y));
  return hit;
}

}  // namespace pinocchio
