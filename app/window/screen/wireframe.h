#pragma once

#include <memory>

#include "gl/objects/texture.h"
#include "gl/transfer/transfer.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// The picture with the edges of the triangles that are seen: pixels beside one of another triangle.
class Wireframe {
 public:
  // Kept until the next call.
  const gl::Texture& draw(const Frame& frame);

 private:
  gl::Upload upload_;
  std::unique_ptr<gl::Texture> texture_;
};

}  // namespace pinocchio::app
