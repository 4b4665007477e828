// Where an animated scene's time is: to be seen, stopped and moved.
#include <algorithm>

#include "app/window/overlay_parts.h"
#include "pinocchio/animation.h"

namespace pinocchio::app {

void draw_playback(Model& model, float scale) {
  if (!model.scene.animation) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = 8.0f * scale;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, display.y - status_height(scale) - margin),
                          ImGuiCond_Always, ImVec2(0.5f, 1.0f));
  ImGui::Begin("playback", nullptr,
               kBare | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  Playback& playback = model.playback;
  if (button(playback.playing ? "Pause" : "Play", "the scene's animation, again and again (Space)"))
    model.asked.push_back(Action::play);
  ImGui::SameLine();
  const auto length_s = static_cast<float>(duration_s(model.scene));
  auto time_s = static_cast<float>(playback.time_s);
  ImGui::SetNextItemWidth(std::min(260.0f * scale, 0.4f * display.x));
  if (ImGui::SliderFloat("##time", &time_s, 0.0f, length_s, "", ImGuiSliderFlags_AlwaysClamp)) {
    playback.playing = false;
    playback.time_s = static_cast<double>(time_s);
  }
  tooltip("the time that is shown: drag, or Ctrl + Left and Ctrl + Right for one frame");
  ImGui::SameLine();
  ImGui::TextUnformatted(format("%.2f of %.2f s", playback.time_s, static_cast<double>(length_s)).c_str());
  tooltip("seconds from the animation's beginning, and how long it is");
  ImGui::End();
}

}  // namespace pinocchio::app
