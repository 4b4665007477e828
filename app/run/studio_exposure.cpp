#include "app/run/studio_exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {

float studio_exposure(Drawing& drawing, const CameraFrame& frame) {
  constexpr int kShorterSide = 60;  // pixels
  constexpr float kMiddle = 0.35f;  // the median's light, of white
  constexpr float kMostStops = 1.5f;
  FrameRequest request = drawing.request(drawing.settings(), frame);
  const glm::ivec2 size = request.view.size;
  const float scale = std::min(1.0f, 1.0f * kShorterSide / std::min(size.x, size.y));
  request.view = {frame.camera, glm::max(glm::ivec2(scale * glm::vec2(size)), 1)};
  Settings settings = request.settings;
  settings.spp = 4;
  settings.exchange.fill(Exchange::sync);
  const FrameResult picture = value_or_exit(
      drawing.engine().render(request.scene, request.view, settings, &run_progress()), kBadScene);
  std::vector<float> light;  // of surfaces
  for (std::size_t i = 0; i < picture.ids.pixels().size(); ++i)
    if (picture.ids[i] != kNoTriangle) {
      const glm::vec3 color(picture.color[i]);
      light.push_back(std::max({color.r, color.g, color.b}));
    }
  if (light.empty()) return 0.0f;
  const auto part = [&light](float share) {
    const auto nth = light.begin() + static_cast<std::ptrdiff_t>(share * as_float(light.size() - 1));
    std::nth_element(light.begin(), nth, light.end());
    return std::max(*nth, 1e-6f);
  };
  const float stops = std::min(std::log2(kMiddle / part(0.5f)), -std::log2(part(0.95f)));
  return std::clamp(std::round(4.0f * stops) / 4.0f, -kMostStops, kMostStops);
}

}  // namespace pinocchio::app
