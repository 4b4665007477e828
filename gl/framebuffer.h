#pragma once

#include "gl/texture.h"

namespace pinocchio::gl {

struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
using FramebufferHandle = Handle<DeleteFramebuffer>;

// What a pass draws into: one colour texture and, where asked for, a depth buffer of its own.
class Framebuffer {
 public:
  Framebuffer() = default;
  // Throws Error where the GPU cannot draw into such a format.
  Framebuffer(glm::ivec2 size, const PixelFormat& color, bool with_depth);

  // Draws go here from now on; the viewport is the whole picture.
  void bind() const;

  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] const Texture& color() const { return color_; }
  [[nodiscard]] glm::ivec2 size() const { return color_.size(); }

 private:
  Texture color_, depth_;
  FramebufferHandle handle_;
};

}  // namespace pinocchio::gl
