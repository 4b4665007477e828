#pragma once

#include <cstddef>
#include <span>

#include "gl/context/handle.h"

namespace pinocchio::gl {

struct DeleteBuffer {
  void operator()(GLuint name) const { glDeleteBuffers(1, &name); }
};
struct DeleteVertexArray {
  void operator()(GLuint name) const { glDeleteVertexArrays(1, &name); }
};
using BufferHandle = Handle<DeleteBuffer>;
using VertexArray = Handle<DeleteVertexArray>;

[[nodiscard]] VertexArray make_vertex_array();

// A buffer of data that seldom changes. Throws Error where the GPU has no memory for it.
class Buffer {
 public:
  Buffer() = default;
  explicit Buffer(std::span<const std::byte> data);
  template <class T>
  explicit Buffer(std::span<const T> data) : Buffer(std::as_bytes(data)) {}

  // Replaces the elements from `first` on. Draws that were begun before read the former ones.
  template <class T>
  void write(std::size_t first, std::span<const T> data) {
    write_bytes(first * sizeof(T), std::as_bytes(data));
  }

  [[nodiscard]] GLuint name() const { return handle_.name(); }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  void write_bytes(std::size_t offset, std::span<const std::byte> data);

  BufferHandle handle_;
  std::size_t bytes_ = 0;
};

}  // namespace pinocchio::gl
