#include "core/trace/lanes/environment_light.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace pinocchio {
namespace {

// Unit, of an angle in revolutions: computed in double and rounded, so that it is the same on every machine.
struct Angle {
  float cosine, sine;
};
Angle angle_of(float revolutions) {
  const double radians = glm::two_pi<double>() * static_cast<double>(revolutions);
  return {static_cast<float>(std::cos(radians)), static_cast<float>(std::sin(radians))};
}

template <class Body>
void for_each_lane(unsigned lanes, Body body) {
  for (; lanes != 0; lanes &= lanes - 1) body(__builtin_ctz(lanes));
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Scene& scene)
    : environment_(scene.environment.get()),
      params_{{environment_->radiance().pixels().data(), environment_->radiance().width()},
              environment_->radiance().size(),
              scene.environment_rotation_deg / 360.0f,
              scene.environment_strength},
      shines_(scene.environment_strength > 0.0f && !environment_->is_black()) {}

void EnvironmentLight::sample(unsigned lanes, SampleLanes& packet) const {
  for_each_lane(lanes, [&](int i) {
    const Environment::Place place = environment_->sample({packet.number[0][i], packet.number[1][i]});
    const Angle around = angle_of(place.uv.x - params_.turn), down = angle_of(0.5f * place.uv.y);
    // The area of a unit of u times v on the sphere is 2 pi^2 times the sine.
    const float share = 2.0f * glm::pi<float>() * glm::pi<float>() * down.sine / place.density;
    const glm::vec3 light = share * shared::environment_at(params_, place.uv);
    packet.direction[0][i] = down.sine * around.sine;
    packet.direction[1][i] = down.cosine;
    packet.direction[2][i] = -down.sine * around.cosine;
    for (int c = 0; c < 3; ++c) packet.light[c][i] = light[c];
    packet.density[i] = 1.0f / share;
  });
}

void EnvironmentLight::look_up(unsigned lanes, SampleLanes& packet) const {
  for_each_lane(lanes, [&](int i) {
    const glm::vec3 direction(packet.direction[0][i], packet.direction[1][i], packet.direction[2][i]);
    const glm::vec3 light = radiance(direction);
    for (int c = 0; c < 3; ++c) packet.light[c][i] = light[c];
    packet.density[i] = density(direction);
  });
}

float EnvironmentLight::density(const glm::vec3& direction) const {
  if (!shines_) return 0.0f;
  const glm::vec3 d = glm::normalize(direction);
  const float sine = std::sqrt(d.x * d.x + d.z * d.z);
  const float area = 2.0f * glm::pi<float>() * glm::pi<float>() * std::max(sine, 1e-6f);
  return environment_->density(shared::environment_place(params_, d)) / area;
}

}  // namespace pinocchio
