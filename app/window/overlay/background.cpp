// Part of the panel Lights: what is behind the scene, and the shadows on the ground.
#include <array>
#include <string>

#include "app/window/overlay/parts.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

constexpr glm::vec3 kFirstColor{0.8f};

struct Kind {
  const char *name, *help;
};
constexpr std::array<Kind, 4> kKinds{
    {{"environment", "the scene's; black where it has none"},  // in Background::Kind's order
     {"studio", "a neutral sky, whatever lights the scene"},
     {"transparent", "nothing: PNG files have an alpha channel"},
     {"colour", "a colour of your choice"}}};

void choose_kind(Background& background) {
  const std::string help(find_field("background")->help);
  const auto now = as_size(background.kind);
  label("background", help);
  if (ImGui::BeginCombo("##background", kKinds[now].name)) {
    for (std::size_t i = 0; i < kKinds.size(); ++i) {
      if (list_item(kKinds[i].name, i == now)) background.kind = static_cast<Background::Kind>(i);
      tooltip(kKinds[i].help);
    }
    ImGui::EndCombo();
  }
  tooltip(help);
}

}  // namespace

void draw_background(Model& model) {
  ImGui::Separator();
  Settings& settings = model.settings.settings;
  Background background =
      settings.background.given ? settings.background.value : model.drawn.background.value;
  const Background before = background;
  choose_kind(background);
  const bool has_color = background.kind == Background::Kind::color;
  if (has_color && before.kind != background.kind) background.color = kFirstColor;
  if (has_color) edit_color("background colour", background.color, "colour behind the scene");
  if (!(background == before)) settings.background = background;
  if (backdrop_of(model.scene, background).picture) {
    const float blur = wanted_settings(model.settings).background_blur;
    float chosen = blur;
    if (slider("blur", chosen, 0.0f, 1.0f, format("%.2f", blur),
               std::string(find_field("background_blur")->help)))
      settings.background_blur = chosen;
  }

  bool catches = model.drawn.shadow_catcher.value.kind != ShadowCatcher::Kind::off;
  if (checkbox("shadows on the ground", catches,
               "a ground at the scene's lowest point that shows only the shadows on it"))
    settings.shadow_catcher = ShadowCatcher{catches ? ShadowCatcher::Kind::lowest : ShadowCatcher::Kind::off};
}

}  // namespace pinocchio::app
