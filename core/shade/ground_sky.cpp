#include "core/shade/ground_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/scene/sky/made_of.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

std::shared_ptr<const Environment> sky_on_ground(const std::shared_ptr<const Environment>& environment) {
  static MadeOfEnvironments<std::shared_ptr<const Environment>> skies;
  return skies.with(environment, [&](std::shared_ptr<const Environment>& on_ground) {
    if (on_ground) return on_ground;
    Image<glm::vec3> light = environment->radiance();
    for (int y = 0; y < light.height(); ++y) {
      const double cosine = std::cos(glm::pi<double>() * (y + 0.5) / light.height());
      for (int x = 0; x < light.width(); ++x) light.at(x, y) *= as_float(std::max(cosine, 0.0));
    }
    return on_ground = std::make_shared<const Environment>(std::move(light));
  });
}

}  // namespace pinocchio
