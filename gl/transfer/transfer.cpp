#include "gl/transfer/transfer.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "gl/context/context.h"
#include "gl/context/error.h"

namespace pinocchio::gl {

void PixelBuffer::reserve(std::size_t bytes) {
  if (bytes <= capacity_) return;
  GLuint name = 0;
  glGenBuffers(1, &name);
  handle_ = BufferHandle(name);
  mapped_ = nullptr;
  capacity_ = 0;  // until the memory is allocated
  bind();
  const GLsizeiptr size = bytes;
  if (mapping_ == Mapping::persistent && !glBufferStorage) mapping_ = Mapping::each_time;
  if (mapping_ == Mapping::persistent) {
    const GLbitfield flags = GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT |
                             (use_ == Use::readback ? GL_MAP_READ_BIT : GL_MAP_WRITE_BIT);
    glBufferStorage(target(), size, nullptr, flags);
    mapped_ = static_cast<std::byte*>(glMapBufferRange(target(), 0, size, flags));
  } else {
    glBufferData(target(), size, nullptr, use_ == Use::readback ? GL_STREAM_READ : GL_STREAM_DRAW);
  }
  unbind();
  const std::string no_room =
      "the GPU has no room for a transfer buffer of " + std::to_string(bytes) + " bytes";
  throw_errors(no_room);
  if (mapping_ == Mapping::persistent && !mapped_) throw Error(no_room);
  capacity_ = bytes;
}

std::span<std::byte> PixelBuffer::map(std::size_t bytes) {
  assert(bytes <= capacity_);
  if (mapping_ == Mapping::each_time) {
    (void)unmap();  // after an error it may still be mapped, with a smaller size
    bind();
    // The fences keep CPU and GPU apart, so the driver need not.
    const GLbitfield flags =
        use_ == Use::readback ? GL_MAP_READ_BIT : GL_MAP_WRITE_BIT | GL_MAP_UNSYNCHRONIZED_BIT;
    mapped_ = static_cast<std::byte*>(glMapBufferRange(target(), 0, bytes, flags));
    unbind();
    if (!mapped_) throw Error("a transfer buffer of " + std::to_string(bytes) + " bytes cannot be mapped");
  }
  return {mapped_, bytes};
}

bool PixelBuffer::unmap() {
  if (mapping_ == Mapping::persistent || !mapped_) return true;
  mapped_ = nullptr;
  bind();
  const bool kept = glUnmapBuffer(target()) == GL_TRUE;
  unbind();
  return kept;
}

void PixelBuffer::bind() const {
  glBindBuffer(target(), handle_.name());
}
void PixelBuffer::unbind() const {
  glBindBuffer(target(), 0);
}

void Readback::start(const Framebuffer& source) {
  close();  // OpenGL does not write into a mapped buffer, and after an error it may still be mapped
  bytes_ = 0;
  const std::size_t bytes = source.color().bytes();
  buffer_.reserve(bytes);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, source.name());
  buffer_.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  const PixelFormat& format = source.color().format();
  glReadPixels(0, 0, source.size().x, source.size().y, format.format, format.type, nullptr);
  buffer_.unbind();
  fence_ = Fence::insert();
  bytes_ = bytes;
}

std::span<const std::byte> Readback::open() {
  if (bytes_ == 0) throw Error("no picture is on its way from the GPU");
  fence_.wait();
  return buffer_.map(bytes_);
}

std::span<std::byte> Upload::open(std::size_t bytes) {
  fence_.wait();
  buffer_.reserve(bytes);
  return buffer_.map(bytes);
}

void Upload::send(std::span<const std::byte> bytes, const Texture& target) {
  std::ranges::copy(bytes, open(bytes.size()).begin());
  send(target);
}

void Upload::send(std::initializer_list<Piece> pieces) {
  if (!buffer_.unmap()) throw Error("the driver lost what was written into a transfer buffer; draw it again");
  buffer_.bind();
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  for (const Piece& piece : pieces) {
    if (piece.size.x <= 0 || piece.size.y <= 0) continue;
    const PixelFormat& format = piece.target->format();
    glBindTexture(GL_TEXTURE_2D, piece.target->name());
    glTexSubImage2D(GL_TEXTURE_2D, 0, piece.at.x, piece.at.y, piece.size.x, piece.size.y, format.format,
                    format.type, reinterpret_cast<const void*>(piece.first_byte));
  }
  buffer_.unbind();
  fence_ = Fence::insert();
}

}  // namespace pinocchio::gl
