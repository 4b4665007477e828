// The values of pixels that are enlarged, on them.
#include <algorithm>
#include <cmath>
#include <string>

#include "app/window/overlay/parts.h"
#include "core/math/luminance.h"

namespace pinocchio::app {

void draw_numbers(const Model& model) {
  const Image<glm::vec4>& light = model.numbers;
  if (light.empty()) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const glm::vec2 size(light.size()), window(display.x, display.y);
  const glm::ivec2 most = light.size() - 1;
  const auto pixel_at = [&](float share) {
    return glm::clamp(glm::ivec2(model.zoom.at(glm::vec2(share)) * size), glm::ivec2(0), most);
  };
  const glm::ivec2 first = pixel_at(0.0f), last = pixel_at(1.0f);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float line = 0.8f * ImGui::GetFontSize(), brighter = std::exp2(model.applied.exposure_ev);
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      const glm::vec4& c = light.at(x, y);
      const glm::vec2 share = (glm::vec2(x, y) + 0.5f) / size - model.zoom.corner;
      const glm::vec2 middle = share * model.zoom.factor * window;
      const int level = brighter * luminance(glm::vec3(c)) > 0.2f ? 0 : 255;
      for (int i = 0; i < 3; ++i) {
        const std::string text = format("%.3g", c[i]);
        const float width = 0.8f * ImGui::CalcTextSize(text.c_str()).x;
        list.AddText(ImGui::GetFont(), line, {middle.x - 0.5f * width, middle.y + (1.0f * i - 1.5f) * line},
                     IM_COL32(level, level, level, 255), text.c_str());
      }
    }
}

}  // namespace pinocchio::app
