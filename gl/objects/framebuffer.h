#pragma once

#include "gl/objects/texture.h"

namespace pinocchio::gl {

struct DeleteFramebuffer {
  void operator()(GLuint name) const { glDeleteFramebuffers(1, &name); }
};
using FramebufferHandle = Handle<DeleteFramebuffer>;

// The target of a pass: one colour texture and, if requested, a depth buffer.
class Framebuffer {
 public:
  Framebuffer() = default;
  // Throws Error where the GPU cannot draw into this format.
  Framebuffer(glm::ivec2 size, const PixelFormat& color, bool with_depth);

  // Draws go here after this. The viewport is the whole picture.
  void bind() const;

  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] const Texture& color() const { return color_; }
  [[nodiscard]] glm::ivec2 size() const { return color_.size(); }

 private:
  Texture color_, depth_;
  FramebufferHandle handle_;
};

}  // namespace pinocchio::gl
