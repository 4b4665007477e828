// Part of the panel Lights: what is behind the scene, and the shadows on the ground.
#include <string>
#include <vector>

#include "app/window/overlay/parts.h"

namespace pinocchio::app {
namespace {

constexpr glm::vec3 kFirstColor{0.8f};

std::vector<Choice> kinds_of_background() {
  return {{"environment", "the scene's; black where it has none"},
          {"studio", "a neutral sky, whatever lights the scene"},
          {"transparent", "nothing: PNG files have an alpha channel"},
          {"colour", "a colour of your choice"}};
}

}  // namespace

void draw_background(Model& model) {
  ImGui::Separator();
  Settings& settings = model.settings.settings;
  Background background =
      settings.background.given ? settings.background.value : model.drawn.background.value;
  const Background before = background;
  choose_value("background", std::string(find_field("background")->help), kinds_of_background(),
               background.kind);
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
