// The controls of an animated scene's time.
#include <algorithm>
#include <string>

#include "app/window/overlay/parts.h"
#include "pinocchio/animation.h"

namespace pinocchio::app {

namespace {

constexpr float kBarGap = 8.0f;

// Files may hold several animations.
void draw_clips(PlaybackState& playback, float scale) {
  if (!playback.all || playback.all->clips.size() < 2) return;
  const auto name_of = [&](int clip) {
    if (clip < 0) return std::string("all");
    const std::string& name = playback.all->clips[clip].name;
    return name.empty() ? "animation " + std::to_string(clip + 1) : name;
  };
  ImGui::SameLine();
  ImGui::SetNextItemWidth(110.0f * scale);
  if (ImGui::BeginCombo("##clip", name_of(playback.clip).c_str())) {
    for (int clip = -1; clip < std::ssize(playback.all->clips); ++clip) {
      ImGui::PushID(clip);
      if (list_item(name_of(clip).c_str(), clip == playback.clip)) playback.clip = clip;
      ImGui::PopID();
    }
    ImGui::EndCombo();
  }
  tooltip("which of the file's animations is played; all: together");
}

}  // namespace

float playback_height(const Model& model, float scale) {
  if (!model.scene.animation) return 0.0f;
  return ImGui::GetFrameHeight() + 2.0f * ImGui::GetStyle().WindowPadding.y + kBarGap * scale;
}

void draw_playback(Model& model, float scale) {
  if (!model.scene.animation) return;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float margin = kBarGap * scale;
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, display.y - status_height(scale) - margin),
                          ImGuiCond_Always, ImVec2(0.5f, 1.0f));
  ImGui::Begin("playback", nullptr,
               kBare | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  keep_in_front();
  PlaybackState& playback = model.playback;
  if (button(playback.playing ? "Pause" : "Play", "the scene's animation, in a loop (Space)"))
    model.requested.push_back(Action::play);
  ImGui::SameLine();
  const float length_s = duration_s(model.scene);
  float time_s = playback.time_s;
  ImGui::SetNextItemWidth(std::min(260.0f * scale, 0.4f * display.x));
  if (ImGui::SliderFloat("##time", &time_s, 0.0f, length_s, "", ImGuiSliderFlags_AlwaysClamp)) {
    playback.playing = false;
    playback.time_s = time_s;
  }
  tooltip("the time that is shown; drag it, or press Ctrl + Left or Ctrl + Right for one frame");
  ImGui::SameLine();
  ImGui::TextUnformatted(format("%.2f of %.2f s", playback.time_s, length_s).c_str());
  tooltip("seconds since the animation's beginning, and its length");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(64.0f * scale);
  ImGui::DragFloat("##speed", &playback.speed, 0.01f, 0.05f, 10.0f, "x %.2f", ImGuiSliderFlags_AlwaysClamp);
  tooltip("speed: 1 as in the file; drag, or Ctrl + click to type a number");
  draw_clips(playback, scale);
  ImGui::End();
}

}  // namespace pinocchio::app
