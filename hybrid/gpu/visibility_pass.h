#pragma once

#include <memory>

#include "core/trace/shared.h"
#include "gl/framebuffer.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/programs.h"

namespace pinocchio {

// reads: the scene's triangles. writes: the id of the nearest triangle at each pixel's centre.
class VisibilityPass {
 public:
  explicit VisibilityPass(std::shared_ptr<Programs> programs) : programs_(std::move(programs)) {}

  // target: of id_format(id_bits), with depth; the part of a picture of `picture_size` that view.first
  // names. Where nothing is seen, all bits are set.
  void draw(const GpuMesh& mesh, const shared::ViewParams& view, glm::ivec2 picture_size, int id_bits,
            const gl::Framebuffer& target) const;

 private:
  std::shared_ptr<Programs> programs_;
};

// What turns (p_world - eye) into (z x, z y, z) of the pixel (x, y) that sees the point, counted from
// view.first.
[[nodiscard]] glm::dmat3 pixel_from_eye(const shared::ViewParams& view);
// ... and into clip x, y and w. Row 0 of the picture is GL's row 0.
[[nodiscard]] glm::mat3 picture_from_eye(const shared::ViewParams& view, glm::ivec2 picture_size);

}  // namespace pinocchio
