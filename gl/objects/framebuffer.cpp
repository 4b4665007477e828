#include "gl/objects/framebuffer.h"

#include <string>

#include "gl/context/context.h"
#include "gl/context/error.h"
#include "gl/context/state.h"

namespace pinocchio::gl {

Framebuffer::Framebuffer(glm::ivec2 size, const PixelFormat& color, bool with_depth) : color_(size, color) {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  handle_ = FramebufferHandle(name);
  glBindFramebuffer(GL_FRAMEBUFFER, name);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, color_.name(), 0);
  if (with_depth) {
    depth_ = Texture(size, kDepth32F);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.name(), 0);
  }
  const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
  throw_errors();
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error("this OpenGL cannot draw into a framebuffer of format " + std::to_string(color.internal) +
                " (status " + std::to_string(status) + ")");
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_.name());
  set_viewport({0, 0}, size());
}

}  // namespace pinocchio::gl
