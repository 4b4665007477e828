#include "gl/objects/buffer.h"

#include <string>

#include "gl/context/context.h"

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
  // This target does not change the bound vertex array.
  glBindBuffer(GL_COPY_WRITE_BUFFER, name);
  glBufferData(GL_COPY_WRITE_BUFFER, data.size(), data.data(), GL_STATIC_DRAW);
  throw_errors("the GPU has no room for a buffer of " + std::to_string(data.size()) + " bytes");
}

void Buffer::write_bytes(std::size_t offset, std::span<const std::byte> data) {
  if (data.empty()) return;
  glBindBuffer(GL_COPY_WRITE_BUFFER, handle_.name());
  glBufferSubData(GL_COPY_WRITE_BUFFER, offset, data.size(), data.data());
}

}  // namespace pinocchio::gl
