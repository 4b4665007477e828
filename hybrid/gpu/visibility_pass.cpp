#include "hybrid/gpu/visibility_pass.h"

#include <algorithm>
#include <string>

#include "hybrid/exchange/encode.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

glm::dmat3 pixel_from_eye(const shared::ViewParams& view) {
  // p - eye = z (corner + (first + pixel) . (step_x, step_y))
  const glm::dvec3 x(view.step_x), y(view.step_y);
  if (view.parallel) return glm::inverse(glm::dmat3(x, y, glm::dvec3(view.corner)));
  const glm::dvec2 first(view.first);
  return glm::inverse(glm::dmat3(x, y, glm::dvec3(view.corner) + first.x * x + first.y * y));
}

glm::mat3 picture_from_eye(const shared::ViewParams& view, glm::ivec2 picture_size) {
  // The centre of the pixel x is at x + 1/2 of the viewport.
  const glm::dvec2 scale = 2.0 / glm::dvec2(picture_size);
  if (view.parallel)
    return glm::mat3(glm::dmat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1) * pixel_from_eye(view));
  const glm::dmat3 clip_from_pixel(glm::dvec3(scale.x, 0, 0), glm::dvec3(0, scale.y, 0),
                                   glm::dvec3(0.5 * scale - 1.0, 1));
  shared::ViewParams whole = view;  // the viewport selects the part
  whole.first = glm::vec2(0.0f);
  return glm::mat3(clip_from_pixel * pixel_from_eye(whole));
}

namespace {

// Beyond every point of the box, along the rays.
float farthest(const Bounds& box, const shared::ViewParams& view) {
  const glm::vec3 far_corner = glm::mix(box.lo, box.hi, glm::greaterThan(view.corner, glm::vec3(0.0f)));
  const float z = glm::dot(far_corner - view.eye, view.corner);
  return std::max(1.001f * z, 1e-30f);
}

}  // namespace

void VisibilityPass::draw(const GpuMesh& mesh, const shared::ViewParams& view, glm::ivec2 picture_size,
                          int id_bits, Backfaces backfaces, const gl::Framebuffer& target) const {
  Programs::Definitions definitions{"ID_BITS " + std::to_string(id_bits == 24 ? 24 : 32)};
  const bool holes = mesh.maps().has_holes();
  if (holes) {
    definitions.emplace_back("HAS_HOLES");
    const Programs::Definitions& of_maps = mesh.maps().definitions();
    definitions.insert(definitions.end(), of_maps.begin(), of_maps.end());
  }
  // Where all backs are passed, the rasteriser leaves them out, which is cheaper.
  const GpuMesh::Share backs = mesh.passed_backs(backfaces);
  if (view.parallel) definitions.emplace_back("PARALLEL_RAYS");
  const bool some_backs = backs == GpuMesh::Share::some;
  if (some_backs) definitions.emplace_back("PASSES_BACKS");
  const gl::Program& program = programs_->get("visibility.vert", "visibility.frag", definitions);
  gl::begin_depth_pass(target, id_format(id_bits).none, picture_size, glm::ivec2(view.first),
                       backs == GpuMesh::Share::all);
  program.use();
  program.set("eye", view.eye);
  program.set("picture_from_eye", picture_from_eye(view, picture_size));
  if (view.parallel) {
    program.set("half_pixel", 1.0f / glm::vec2(picture_size));
    program.set("z_far", farthest(mesh.bounds(), view));
  } else {
    program.set("z_near", mesh.z_near());
  }
  int unit = 0;
  if (holes) {
    unit = mesh.bind(program, unit);
    program.set("corner", view.corner);
    program.set("step_x", view.step_x);
    program.set("step_y", view.step_y);
    program.set("first_pixel", view.first);
  }
  if (some_backs) {
    mesh.bind_backs(program, unit);
    program.set("backfaces", as_int(backfaces));
  }
  mesh.draw();
}

}  // namespace pinocchio
