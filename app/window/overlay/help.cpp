// The panel Help: mouse and keys.
#include <string_view>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

void cells(const char* key, const char* what) {
  ImGui::TableNextColumn();
  ImGui::TextColored(kAccent, "%s", key);
  ImGui::TableNextColumn();
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(what);
  ImGui::PopTextWrapPos();
}

}  // namespace

void draw_help(Model&, float scale) {
  const bool wide = ImGui::GetContentRegionAvail().x > 520.0f * scale;
  if (!ImGui::BeginTable("keys", wide ? 4 : 2)) return;
  for (int pair = 0; pair < (wide ? 2 : 1); ++pair) {
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed,
                            ImGui::CalcTextSize("Ctrl + Shift + click ").x);
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
  }
  for (const auto& [key, what] : mouse_bindings()) cells(key, what);
  std::string_view last;
  for (const KeyBinding& binding : key_bindings()) {
    if (last == binding.what) continue;  // another key with the same effect
    last = binding.what;
    cells(binding.shown, binding.what);
  }
  ImGui::EndTable();
}

}  // namespace pinocchio::app
