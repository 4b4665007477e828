// The picture's light as a histogram, and the shares that a display cannot show.
#include <algorithm>
#include <cmath>
#include <vector>

#include "app/window/overlay/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr float kDarkest_stops = -12.0f, kBrightest_stops = 4.0f;  // against the display's white
constexpr int kBins = 96;

std::string clipped_text(std::size_t count, std::size_t pixels) {
  return format("%.2f %%", 100.0 * count / std::max<std::size_t>(pixels, 1));
}

}  // namespace

// Light is counted before exposure, so that the histogram follows exposure at once.
void draw_histogram(const Model& model, float scale) {
  if (!model.histogram) return;
  const LightHistogram& light = *model.histogram;
  const float ev = model.settings.exposure_ev;
  const std::vector<float> counts = light.by_luminance(kDarkest_stops - ev, kBrightest_stops - ev, kBins);
  // The square root: areas of one colour would flatten all the rest.
  const float most = std::sqrt(std::max(1.0f, *std::ranges::max_element(counts)));
  label("brightness", "pixels by their luminance, from 12 stops below the display's white to 4 above");
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 2.5f * ImGui::GetTextLineHeight());
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
  const float white_x = at.x + size.x * -kDarkest_stops / (kBrightest_stops - kDarkest_stops);
  for (int i = 0; i < kBins; ++i) {
    const float x = at.x + size.x * i / kBins, next_x = at.x + size.x * (i + 1) / kBins;
    const float height = size.y * std::sqrt(counts[as_size(i)]) / most;
    draw.AddRectFilled({x, at.y + size.y - height}, {next_x, at.y + size.y},
                       x < white_x ? IM_COL32(200, 200, 200, 255) : ImGui::GetColorU32(kAccent));
  }
  draw.AddLine({white_x, at.y}, {white_x, at.y + size.y}, IM_COL32(255, 255, 255, 120), scale);
  ImGui::Dummy(size);
  tooltip(
      "pixels by their luminance, from 12 stops below the display's white to 4 above; the line is its white. "
      "Heights are square roots. Ctrl + Shift + click in the picture sets the exposure for a point");
  row("shown as white", clipped_text(light.shown_white(ev, model.settings.tone_map), light.pixels()),
      "pixels with a channel brighter than the display can show; less exposure or another tone curve shows "
      "them");
  row("shown as black", clipped_text(light.shown_black(ev, model.settings.tone_map), light.pixels()),
      "pixels darker than the display's first step; more exposure shows them");
}

}  // namespace pinocchio::app
