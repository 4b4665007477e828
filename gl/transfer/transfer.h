// Transfers of pictures between GPU and CPU through pixel buffers. Each object holds one picture at a time. A
// ring with one object for each frame in flight never waits.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>

#include "gl/objects/fence.h"
#include "gl/objects/framebuffer.h"

namespace pinocchio::gl {

// A pixel buffer is mapped for each transfer, or once (GL_ARB_buffer_storage, coherent).
enum class Mapping { each_time, persistent };

// A pixel buffer that the CPU reads or writes.
class PixelBuffer {
 public:
  enum class Use { readback, upload };
  PixelBuffer(Use use, Mapping mapping) : use_(use), mapping_(mapping) {}

  // Makes room. The contents are lost when the buffer grows. Throws Error where there is no room; the buffer
  // is then empty.
  void reserve(std::size_t bytes);
  [[nodiscard]] std::span<std::byte> map(std::size_t bytes);
  // False: the driver lost the bytes that were written.
  bool unmap();
  void bind() const;  // to this use's target
  void unbind() const;

 private:
  [[nodiscard]] GLenum target() const {
    return use_ == Use::readback ? GL_PIXEL_PACK_BUFFER : GL_PIXEL_UNPACK_BUFFER;
  }

  Use use_;
  Mapping mapping_;
  BufferHandle handle_;
  std::size_t capacity_ = 0;
  std::byte* mapped_ = nullptr;
};

// GPU to CPU.
class Readback {
 public:
  explicit Readback(Mapping mapping = Mapping::each_time) : buffer_(PixelBuffer::Use::readback, mapping) {}

  // Starts the transfer of the framebuffer's colour: row 0 first, rows tightly packed. Does not wait.
  void start(const Framebuffer& source);
  // The bytes of the last start(). Waits until they are there. Valid until close(). Throws Error where
  // start() failed.
  [[nodiscard]] std::span<const std::byte> open();
  void close() { (void)buffer_.unmap(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  PixelBuffer buffer_;
  Fence fence_;
  std::size_t bytes_ = 0;
};

// CPU to GPU.
class Upload {
 public:
  explicit Upload(Mapping mapping = Mapping::each_time) : buffer_(PixelBuffer::Use::upload, mapping) {}

  // Memory for one picture. Waits while the GPU reads the previous one. Any thread may fill it. The memory is
  // mapped for writing: reading it is undefined.
  [[nodiscard]] std::span<std::byte> open(std::size_t bytes);
  // Starts the transfer into the whole of `target`. Does not wait.
  void send(const Texture& target) { send({{&target, {0, 0}, target.size(), 0}}); }

  // Both, for a picture that is in memory: `bytes` fill the texture.
  void send(std::span<const std::byte> bytes, const Texture& target);

  // A box of a texture, and where in the buffer its rows begin, tightly packed.
  struct Piece {
    const Texture* target;
    glm::ivec2 at, size;
    std::size_t first_byte;
  };
  // Starts the transfer of these pieces only.
  void send(std::initializer_list<Piece> pieces);

 private:
  PixelBuffer buffer_;
  Fence fence_;
};

}  // namespace pinocchio::gl
