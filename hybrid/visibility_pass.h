#pragma once

#include <filesystem>

#include "core/trace/shared.h"
#include "gl/framebuffer.h"
#include "gl/program.h"
#include "hybrid/gpu_scene.h"

namespace pinocchio {

// reads: the scene's triangles. writes: the id of the nearest triangle at each pixel's centre.
class VisibilityPass {
 public:
  explicit VisibilityPass(const std::filesystem::path& shaders);

  // target: R16UI or R32UI with depth, the part of a picture of `picture_size` that view.first names.
  // Where nothing is seen, all bits are set.
  void draw(const GpuScene& scene, const shared::ViewParams& view, glm::ivec2 picture_size,
            const gl::Framebuffer& target) const;

 private:
  gl::Program program_;
};

// What turns (p_world - eye) into clip x, y and w. Row 0 of the picture is GL's row 0.
[[nodiscard]] glm::mat3 picture_from_eye(const shared::ViewParams& view, glm::ivec2 picture_size);

}  // namespace pinocchio
