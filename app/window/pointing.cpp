#include "app/window/pointing.h"

#include <cmath>
#include <optional>

#include "app/window/camera/framing.h"
#include "core/math/luminance.h"

namespace pinocchio::app {
namespace {

constexpr const char* kNoTree = "the tree is being built; try again when it is done";

}  // namespace

void Pointing::set_pivot() {
  model_.wants_tree = true;
  if (!model_.tracer) return model_.messages.hint(kNoTree);
  if (const std::optional<glm::vec3> p =
          surface_under(glm::vec2(input_.pixel_under_pointer()), glm::vec2(model_.wanted_size()),
                        model_.camera.camera(), *model_.tracer, model_.settings.settings.backfaces))
    model_.camera.set_target(*p);
}

void Pointing::pick_material() {
  const std::optional<PixelReport> pixel = inspector_.report(model_, input_.pixel_under_pointer());
  if (!pixel) return model_.messages.hint(kNoTree);
  if (pixel->triangle == kNoTriangle) return model_.messages.hint("no surface is visible here", 3.0);
  model_.material = pixel->material;
  model_.material_picked = true;
  model_.panels[Panel::materials] = true;
  model_.messages.hint("picked: " + name_of_material(*model_.scene.mesh, pixel->material), 4.0, "picked");
}

void Pointing::expose() {
  constexpr float kMiddleGrey = 0.18f;
  const std::optional<PixelReport> pixel = inspector_.report(model_, input_.pixel_under_pointer());
  if (!pixel) return model_.messages.hint(kNoTree);
  if (const float seen = luminance(pixel->color); seen > 0.0f)
    model_.settings.exposure_ev = std::log2(kMiddleGrey / seen);
}

}  // namespace pinocchio::app
