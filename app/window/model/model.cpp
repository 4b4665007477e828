#include "app/window/model/model.h"

namespace pinocchio::app {

std::string name_of_material(const Mesh& mesh, std::size_t material) {
  const std::string& name = mesh.materials[material].name;
  return name.empty() ? "material " + std::to_string(material) : name;
}

glm::ivec2 Model::wanted_size() const {
  const glm::vec2 size = glm::round(glm::vec2(window_pixels) * applied.scale);
  return glm::clamp(glm::ivec2(size), glm::ivec2(1), glm::ivec2(kMaxSide));
}

FrameRequest Model::request() const {
  FrameRequest request{scene, tracer, drawn, {camera.camera(), wanted_size()}};
  drop_idle_casters(request.scene);
  return request;
}

}  // namespace pinocchio::app
