#include "gl/buffer.h"

#include <string>

#include "gl/context.h"

namespace pinocchio::gl {

VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}

Buffer::Buffer(std::span<const std::byte> data) : bytes_(data.size()) {
  GLuint name = 0;
  glGenBuffers(1, &name);
  handle_ = BufferHandle(name);
  // No vertex array is changed by this target, whichever is bound.
  glBindBuffer(GL_COPY_WRITE_BUFFER, name);
  glBufferData(GL_COPY_WRITE_BUFFER, static_cast<GLsizeiptr>(data.size()), data.data(), GL_STATIC_DRAW);
  throw_errors("the GPU has no room for a buffer of " + std::to_string(data.size()) + " bytes");
}

}  // namespace pinocchio::gl
