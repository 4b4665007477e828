#include "app/view/overlay.h"

#include <imgui.h>

namespace pinocchio::app {

void draw_overlay(Model& model, float) {
  if (!model.settings.overlay) return;
  ImGui::Begin("Pinocchio");
  ImGui::Text("%.1f ms", static_cast<double>(median_of_newest(model.history.frame_ms(), 30)));
  ImGui::End();
}

}  // namespace pinocchio::app
