#include "app/window/model/model.h"

namespace pinocchio::app {

std::string name_of_material(const Mesh& mesh, std::size_t material) {
  const std::string& name = mesh.materials[material].name;
  return name.empty() ? "material " + std::to_string(material) : name;
}

void Model::set_window_pixels(glm::ivec2 pixels) {
  if (window_pixels != pixels) zoom = {};
  window_pixels = pixels;
}

bool Model::wants_numbers() const {
  constexpr float kReadable = 44.0f;  // pixels of the window for one of the picture
  const float enlarged = zoom.factor * window_pixels.x / std::max(picture_size.x, 1);
  return settings.overlay && applied.buffer == Layer::picture && applied.split == Split::off &&
         !applied.wireframe && enlarged >= kReadable;
}

glm::ivec2 Model::wanted_size() const {
  const glm::vec2 size = glm::round(glm::vec2(window_pixels) * applied.scale);
  return glm::clamp(glm::ivec2(size), glm::ivec2(1), glm::ivec2(kMaxSide));
}

FrameRequest Model::request() const {
  FrameRequest request{scene, tracer, drawn, {camera.camera(), wanted_size()}};
  drop_idle_casters(request.scene);
  request.shows_samples = true;
  return request;
}

}  // namespace pinocchio::app
