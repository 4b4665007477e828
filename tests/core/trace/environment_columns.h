// Directions, numbers and light of the environment's look-ups, a column each.
#pragma once

#include <array>

#include "core/base/aligned_vector.h"

#include "tests/core/trace/lane_probe.h"

namespace pinocchio {

struct EnvironmentColumns {
  // count: a multiple of 16.
  explicit EnvironmentColumns(std::size_t count) : u(count), v(count), density(count) {
    for (int c = 0; c < 3; ++c) {
      direction[c].resize(count);
      light[c].resize(count);
    }
  }
  AlignedVector<float> u, v, density;
  std::array<AlignedVector<float>, 3> direction, light;

  void look_up(const Scene& scene, Isa isa = Isa::scalar) {
    const float* const from[] = {direction[0].data(), direction[1].data(), direction[2].data()};
    float* const to[] = {light[0].data(), light[1].data(), light[2].data()};
    lane_probe(isa).environment_light(EnvironmentLight(scene), from, to, density.data(), u.size());
  }
  void sample(const Scene& scene, Isa isa = Isa::scalar) {
    float* const towards[] = {direction[0].data(), direction[1].data(), direction[2].data()};
    float* const to[] = {light[0].data(), light[1].data(), light[2].data()};
    lane_probe(isa).environment_samples(EnvironmentLight(scene), u.data(), v.data(), towards, to,
                                        density.data(), u.size());
  }
  [[nodiscard]] glm::vec3 direction_of(std::size_t i) const {
    return {direction[0][i], direction[1][i], direction[2][i]};
  }
  void set_direction(std::size_t i, const glm::vec3& d) {
    for (int c = 0; c < 3; ++c) direction[c][i] = d[c];
  }
  [[nodiscard]] glm::vec3 light_of(std::size_t i) const { return {light[0][i], light[1][i], light[2][i]}; }
  friend bool operator==(const EnvironmentColumns&, const EnvironmentColumns&) = default;
};

inline glm::vec3 light_from(const Scene& scene, const glm::vec3& direction) {
  EnvironmentColumns one(16);
  for (std::size_t i = 0; i < 16; ++i) one.set_direction(i, direction);
  one.look_up(scene);
  return one.light_of(0);
}

}  // namespace pinocchio
