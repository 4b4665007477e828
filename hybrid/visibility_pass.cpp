#include "hybrid/visibility_pass.h"

namespace pinocchio {

glm::mat3 picture_from_eye(const shared::ViewParams& view, glm::ivec2 picture_size) {
  // p - eye = z (corner + x step_x + y step_y): the inverse gives (z x, z y, z) of the pixel (x, y), whose
  // centre is at x + 1/2 of the viewport.
  const glm::dmat3 pixel_from_eye = glm::inverse(glm::dmat3(view.step_x, view.step_y, view.corner));
  const glm::dvec2 scale = 2.0 / glm::dvec2(picture_size);
  const glm::dmat3 clip_from_pixel(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0),
                                   glm::dvec3(0.5 * scale - 1.0, 1));
  return glm::mat3(clip_from_pixel * pixel_from_eye);
}

VisibilityPass::VisibilityPass(const std::filesystem::path& shaders)
    : program_(shaders, "visibility.vert", "visibility.frag") {}

void VisibilityPass::draw(const GpuScene& scene, const shared::ViewParams& view, glm::ivec2 picture_size,
                          const gl::Framebuffer& target) const {
  gl::begin_depth_pass(target, 0xffffffffu, picture_size, glm::ivec2(view.first));
  program_.use();
  program_.set("eye", view.eye);
  program_.set("picture_from_eye", picture_from_eye(view, picture_size));
  program_.set("z_near", scene.z_near());
  scene.draw();
}

}  // namespace pinocchio
