#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A scene's environment, in double precision.
class ReferenceEnvironment {
 public:
  // The environment must outlive this object.
  ReferenceEnvironment(const Environment& environment, double rotation_deg, double strength);
  // The scene has an environment, which must outlive this object.
  explicit ReferenceEnvironment(const Scene& scene)
      : ReferenceEnvironment(*scene.environment, as_double(scene.environment_rotation_deg),
                             as_double(scene.environment_strength)) {}

  // Linear light from a direction of any length but zero.
  [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction) const;

  // A direction, chosen by the light around it from two numbers in [0, 1), and its light divided by the
  // probability density (per steradian).
  struct Sample {
    glm::dvec3 direction;  // unit
    glm::dvec3 light;
    double density;
  };
  [[nodiscard]] Sample sample(const glm::dvec2& numbers) const;
  [[nodiscard]] double density(const glm::dvec3& direction) const;

 private:
  [[nodiscard]] glm::dvec3 at(const glm::dvec2& uv) const;
  [[nodiscard]] glm::dvec2 place_of(const glm::dvec3& direction) const;

  const Image<glm::vec3>& picture_;
  double turn_, strength_;  // revolutions
  // Sums of light up to the end of each row, and within each row up to the end of each texel.
  std::vector<double> rows_, columns_;
};

}  // namespace pinocchio
