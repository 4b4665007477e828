#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/scene.h"

namespace pinocchio {

// What is around a scene, in double, by code of its own.
class ReferenceEnvironment {
 public:
  // The scene has an environment, which stays as long as this lives.
  explicit ReferenceEnvironment(const Scene& scene);

  // Linear light that comes from there; the direction has any length but zero.
  [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const;

  // A direction, likelier the more light comes from about there, and that light over how likely it was (per
  // steradian). From two numbers in [0, 1).
  struct Sample {
    glm::dvec3 direction;  // unit
    glm::dvec3 light;
  };
  [[nodiscard]] Sample sample(const glm::dvec2& numbers) const;

 private:
  [[nodiscard]] glm::dvec3 at(const glm::dvec2& uv) const;

  const Image<glm::vec3>& picture_;
  double turn_, strength_;  // revolutions
  // Light up to the end of each row, and within each row up to the end of each texel: sums, not shares.
  std::vector<double> rows_, columns_;
};

}  // namespace pinocchio
