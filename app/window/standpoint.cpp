#include "app/window/standpoint.h"

#include <algorithm>

#include "app/window/camera/framing.h"

namespace pinocchio::app {

void frame_all(Model& model, glm::ivec2 pixels) {
  const glm::vec2 size(pixels);
  model.zoom = {};
  model.camera.frame_all(size.x / std::max(size.y, 1.0f));
  model.wants_tree = true;
  if (!model.tracer)
    return model.messages.hint("walls may be in the way: the tree is being built; press F again");
  model.camera.set_camera(before_walls(model.camera.camera(), model.camera.interest(), *model.tracer));
}

void show_camera(Model& model, std::size_t number) {
  if (!model.has_scene()) return;
  const std::vector<Camera>& cameras = model.scene.cameras;
  if (number < cameras.size()) {
    model.camera.set_camera(cameras[number]);
    model.messages.hint("camera " + cameras[number].name, 3.0);
  } else {
    model.messages.hint("the scene has " + std::to_string(cameras.size()) +
                        (cameras.size() == 1 ? " camera" : " cameras"));
  }
}

}  // namespace pinocchio::app
