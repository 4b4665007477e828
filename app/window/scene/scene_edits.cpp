#include "app/window/scene/scene_edits.h"

#include <utility>

#include "core/base/clock.h"
#include "core/scene/pose/pose.h"
#include "pinocchio/animation.h"
#include "pinocchio/conversion.h"
#include "pinocchio/nodes.h"

namespace pinocchio::app {
namespace {

// By node: whether the scene's animation moves it.
std::vector<bool> moving_nodes(const Scene& scene) {
  if (!scene.animation || !scene.nodes) return {};
  const std::vector<Node>& nodes = scene.nodes->nodes;
  std::vector<bool> moving(nodes.size(), false);
  for (const AnimatedNode& animated : scene.animation->nodes) moving.at(as_size(animated.node)) = true;
  for (std::size_t i = 0; i < nodes.size(); ++i)  // parents come first
    if (nodes[i].parent >= 0 && moving[as_size(nodes[i].parent)]) moving[i] = true;
  return moving;
}

}  // namespace

// Calls use(light, at rest, node) for the lights that the animation moves.
template <class Use>
void SceneEdits::for_each_moving(Scene& scene, Use use) const {
  if (moving_.empty()) return;
  const std::vector<Attached<Light>>& attached = scene.nodes->rest->lights;
  const std::vector<std::size_t> places = attached_places(*scene.nodes->rest, scene).lights;
  for (std::size_t i = 0; i < attached.size(); ++i)
    if (places[i] != kGone && moving_.at(as_size(attached[i].node)))
      use(scene.lights[places[i]], attached[i].at_rest, attached[i].node);
}

// Moving lights have their place at rest: their motion is no edit.
std::vector<Light> SceneEdits::lights_at_rest() const {
  if (moving_.empty()) return model_.scene.lights;
  Scene scene = model_.scene;
  for_each_moving(scene, [](Light& light, const Light& at_rest, int) {
    place(Placement(glm::mat4(1.0f)), at_rest, light);
  });
  return scene.lights;
}

// Whether the overlay is hidden does not count as an edit.
EditState SceneEdits::state() const {
  EditState state{
      model_.settings,         model_.camera.camera(),   lights_at_rest(),   model_.scene.mesh->materials,
      model_.scene.mesh->maps, model_.scene.environment, model_.parts.hidden};
  state.settings.overlay = true;
  return state;
}

void SceneEdits::begin() {
  model_.lights_changed = model_.scene_edited = model_.drops_environment = false;
  model_.material_edit.reset();
  if (as_size(model_.material) >= model_.scene.mesh->materials.size()) model_.material = 0;
  moving_ = moving_nodes(model_.scene);
  history_.begin(state());
  saved();
}

void SceneEdits::saved() {
  model_.unsaved = false;
  saved_lights_ = model_.scene.lights;
  saved_materials_ = model_.scene.mesh->materials;
}

// Edits that were taken back need not be saved. An animation moves lights: they may differ without edits.
void SceneEdits::note_edit() {
  model_.scene_edited = true;
  ++model_.edits;
  model_.unsaved = model_.scene.animation || model_.scene.lights != saved_lights_ ||
                   model_.scene.mesh->materials != saved_materials_;
}

void SceneEdits::set_environment(std::shared_ptr<const Environment> environment) {
  std::vector<Light>& lights = model_.scene.lights;
  const auto is_assumed = [](const Light& light) {
    return light.name == "default" || light.name == "studio";
  };
  if (environment && std::erase_if(lights, is_assumed) > 0) std::erase_if(saved_lights_, is_assumed);
  model_.scene.environment = std::move(environment);
  model_.stats = analyze(model_.scene);
}

void SceneEdits::note() {
  if (model_.has_scene()) history_.note(state(), now_s());
}

void SceneEdits::undo() {
  note();  // keys may have been pressed just before
  restore(history_.undo(), "nothing to undo");
}

void SceneEdits::redo() {
  note();
  restore(history_.redo(), "nothing to redo");
}

void SceneEdits::restore(const std::optional<EditState>& state, const char* otherwise) {
  if (!state) return model_.messages.hint(otherwise, 2.0);
  const bool overlay = model_.settings.overlay;
  model_.settings = state->settings;
  model_.settings.overlay = overlay;
  model_.camera.set_camera(state->camera);
  const Mesh& mesh = *model_.scene.mesh;
  if (mesh.materials != state->materials || mesh.maps != state->maps)
    set_materials(state->materials, state->maps);
  if (model_.scene.environment != state->environment) set_environment(state->environment);
  if (model_.parts.hidden != state->hidden) {
    model_.parts.hidden = state->hidden;
    model_.parts.changed = true;
  }
  if (lights_at_rest() == state->lights) return;
  model_.scene.lights = state->lights;
  for_each_moving(model_.scene, [this](Light& light, const Light& at_rest, int node) {
    place(Placement(model_.scene.nodes->world_from(node)), at_rest, light);
  });
  model_.lights_changed = true;
}

// The tree stays valid: the triangles are the same.
void SceneEdits::set_materials(std::vector<Material> materials, std::vector<MaterialMaps> maps) {
  auto mesh = std::make_shared<Mesh>(*model_.scene.mesh);
  mesh->materials = std::move(materials);
  mesh->maps = std::move(maps);
  model_.scene.mesh = std::move(mesh);
  model_.stats = analyze(model_.scene);
  note_edit();
}

void SceneEdits::apply() {
  if (const auto edit = std::exchange(model_.material_edit, std::nullopt)) {
    std::vector<Material> materials = model_.scene.mesh->materials;
    std::vector<MaterialMaps> maps = model_.scene.mesh->maps;
    materials.at(model_.material) = edit->material;
    if (edit->surface) maps.at(edit->material.maps).surface = *edit->surface;
    set_materials(std::move(materials), std::move(maps));
  }
  if (std::exchange(model_.drops_environment, false)) set_environment(nullptr);
  if (!std::exchange(model_.lights_changed, false)) return;
  note_edit();
  recount_lights(model_.scene, model_.stats);
}

}  // namespace pinocchio::app
