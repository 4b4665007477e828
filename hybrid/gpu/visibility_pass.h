#pragma once

#include <memory>

#include "core/shade/shared.h"
#include "gl/objects/framebuffer.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/programs.h"

namespace pinocchio {

// reads: the scene's triangles. writes: the id of the nearest triangle at each pixel's centre.
class VisibilityPass {
 public:
  explicit VisibilityPass(std::shared_ptr<Programs> programs) : programs_(std::move(programs)) {}

  // target: has id_format(id_bits) and depth; it is the part of a picture of `picture_size` that begins at
  // view.first. All bits are set where nothing is seen. `backfaces`: the backs that are not drawn.
  void draw(const GpuMesh& mesh, const shared::ViewParams& view, glm::ivec2 picture_size, int id_bits,
            Backfaces backfaces, const gl::Framebuffer& target) const;

 private:
  std::shared_ptr<Programs> programs_;
};

// The matrix from (p_world - eye) to (z x, z y, z), where (x, y) is the point's pixel, counted from
// view.first; with parallel rays, to (x, y, z), and x and y are counted from the whole picture's first pixel.
[[nodiscard]] glm::dmat3 pixel_from_eye(const shared::ViewParams& view);
// The matrix from (p_world - eye) to clip x, y and w; with parallel rays, to clip x and y, less half a pixel
// and 1, and z_eye. Row 0 of the picture is GL's row 0.
[[nodiscard]] glm::mat3 picture_from_eye(const shared::ViewParams& view, glm::ivec2 picture_size);

}  // namespace pinocchio
