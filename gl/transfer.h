// Pictures between GPU and CPU through pixel buffers. Each object carries one picture at a time; as many
// of them as there are frames in flight make the ring that never waits.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>

#include "gl/fence.h"
#include "gl/framebuffer.h"

namespace pinocchio::gl {

// How the CPU sees a pixel buffer: mapped for each transfer, or for good (GL_ARB_buffer_storage, coherent).
enum class Mapping { each_time, persistent };

// A pixel buffer that the CPU reads or writes.
class PixelBuffer {
 public:
  enum class Use { readback, upload };
  PixelBuffer(Use use, Mapping mapping) : use_(use), mapping_(mapping) {}

  // Makes room; what was in it is lost when it grows. Throws Error where there is none; it is empty then.
  void reserve(std::size_t bytes);
  [[nodiscard]] std::span<std::byte> map(std::size_t bytes);
  // False where the driver lost what was written.
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

  // Sends the framebuffer's colour off, row 0 first, rows tightly packed. Does not wait.
  void start(const Framebuffer& source);
  // The bytes of the last start(); waits for them where it must. Valid until close(). Throws Error where that
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

  // Room for one picture; waits where the GPU still reads the one before. Any thread may fill it. The memory
  // is mapped for writing: what is read from it is undefined.
  [[nodiscard]] std::span<std::byte> open(std::size_t bytes);
  // Sends what was written on its way into the whole of `target`. Does not wait.
  void send(const Texture& target) { send({{&target, {0, 0}, target.size(), 0}}); }

  // A box of a texture, and where in the buffer its rows begin, tightly packed.
  struct Piece {
    const Texture* target;
    glm::ivec2 at, size;
    std::size_t first_byte;
  };
  // Only these; the rest of what was opened does not travel.
  void send(std::initializer_list<Piece> pieces);

 private:
  PixelBuffer buffer_;
  Fence fence_;
};

}  // namespace pinocchio::gl
