#include "core/shade/ground_sky.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <mutex>
#include <vector>

namespace pinocchio {

std::shared_ptr<const Environment> sky_on_ground(const std::shared_ptr<const Environment>& environment) {
  struct Kept {
    std::weak_ptr<const Environment> of;
    std::shared_ptr<const Environment> on_ground;
  };
  static std::mutex mutex;
  static std::vector<Kept> kept;
  const std::lock_guard lock(mutex);
  std::erase_if(kept, [](const Kept& k) { return k.of.expired(); });
  for (const Kept& k : kept)
    if (k.of.lock() == environment) return k.on_ground;
  Image<glm::vec3> light = environment->radiance();
  for (int y = 0; y < light.height(); ++y) {
    const double cosine = std::cos(glm::pi<double>() * (y + 0.5) / light.height());
    for (int x = 0; x < light.width(); ++x) light.at(x, y) *= static_cast<float>(std::max(cosine, 0.0));
  }
  kept.push_back({environment, std::make_shared<const Environment>(std::move(light))});
  return kept.back().on_ground;
}

}  // namespace pinocchio
