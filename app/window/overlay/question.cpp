// The question before edits are dropped.
#include <filesystem>
#include <string>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

std::string question(const Model& model, const Leaving& to) {
  const std::string scene = std::filesystem::path(model.scene.source).filename().string();
  const std::string edited = "The edits of " + scene + " are not saved. ";
  if (to.reload) return edited + "Its file has changed: load it again?";
  if (to.file.empty()) return edited + "Close the window?";
  return edited + "Open " + std::filesystem::path(to.file).filename().string() + "?";
}

}  // namespace

void draw_question(Model& model, float scale) {
  if (!model.leaving) return;
  model.leaving->is_asked = true;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float width = std::min(0.9f * display.x, 420.0f * scale);
  ImGui::SetNextWindowPos(ImVec2(0.5f * display.x, 0.4f * display.y), ImGuiCond_Always, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
  ImGui::PushStyleColor(ImGuiCol_Border, kAccent);
  ImGui::Begin("question", nullptr, kBare | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleColor();
  keep_in_front();
  paragraph(question(model, *model.leaving));
  ImGui::Dummy(ImVec2(0.0f, 4.0f * scale));
  if (button("Save (Enter)", "save the scene as glTF in a new file, then go on"))
    model.requested.push_back(Action::save_and_leave);
  ImGui::SameLine();
  if (button("Drop edits (X)", "go on without saving")) model.requested.push_back(Action::leave_unsaved);
  ImGui::SameLine();
  if (button("Stay (Esc)", "keep the scene as it is")) model.requested.push_back(Action::stay);
  ImGui::End();
}

}  // namespace pinocchio::app
