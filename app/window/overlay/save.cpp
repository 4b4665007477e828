// The panel Save: what is written, and where.
#include <array>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

void edit_text(const char* name, std::string& text, const std::string& hint, const std::string& help) {
  std::array<char, 1024> bytes{};
  text.copy(bytes.data(), bytes.size() - 1);
  label(name, help);
  ImGui::PushID(name);
  if (ImGui::InputTextWithHint("##text", hint.c_str(), bytes.data(), bytes.size())) text = bytes.data();
  ImGui::PopID();
  tooltip(help);
}

struct SaveButton {
  const char* name;
  Action action;
  const char* help;
};

void draw_buttons(Model& model, const char* name, const char* help,
                  std::initializer_list<SaveButton> buttons) {
  label(name, help);
  bool first = true;
  for (const SaveButton& one : buttons) {
    if (!std::exchange(first, false)) ImGui::SameLine();
    if (button(one.name, one.help)) model.requested.push_back(one.action);
  }
}

}  // namespace

void draw_save(Model& model, float) {
  if (!model.has_scene()) return paragraph("no scene");
  std::error_code unknown;
  edit_text("folder", model.save.folder, std::filesystem::current_path(unknown).string(),
            "folder of all files that the window writes");
  edit_text("name", model.save.name,
            std::filesystem::path(model.scene.source).stem().string() + " and a number",
            "file name without its extension");
  checkbox("replace files", model.save.replaces, "off: a file that exists is not written again");
  draw_buttons(model, "scene", "the whole scene with its edits; the camera comes first",
               {{".glb", Action::save_glb, "one file"},
                {".gltf", Action::save_gltf, "text, with a .bin file"},
                {".obj", Action::save_obj, "triangles and materials alone, with an .mtl file"}});
  draw_buttons(model, "picture", "the picture without panels, as large as it is drawn",
               {{"PNG", Action::save_png, "as the window shows it"},
                {"PNG, transparent", Action::save_transparent, "without the background"},
                {"EXR", Action::save_exr, "linear light, with every layer"}});
}

}  // namespace pinocchio::app
