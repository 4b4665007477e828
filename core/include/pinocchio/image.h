#pragma once

#include <cassert>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "pinocchio/conversion.h"
#include "pinocchio/glm_layout.h"
#include "pinocchio/pixel_memory.h"

namespace pinocchio {

// width x height pixels, row by row, first row at the top of the picture.
template <class T>
class Image {
 public:
  Image() = default;
  explicit Image(glm::ivec2 size, const T& value = T{})
      : size_(size), pixels_(as_size(size.x) * as_size(size.y), value) {
    assert(size.x >= 0 && size.y >= 0);
  }

  [[nodiscard]] glm::ivec2 size() const { return size_; }
  [[nodiscard]] int width() const { return size_.x; }
  [[nodiscard]] int height() const { return size_.y; }
  [[nodiscard]] bool empty() const { return pixels_.empty(); }

  [[nodiscard]] T& at(int x, int y) { return pixels_[index(x, y)]; }
  [[nodiscard]] const T& at(int x, int y) const { return pixels_[index(x, y)]; }
  [[nodiscard]] T& operator[](std::size_t i) { return pixels_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return pixels_[i]; }

  [[nodiscard]] std::span<T> pixels() { return pixels_; }
  [[nodiscard]] std::span<const T> pixels() const { return pixels_; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    assert(x >= 0 && y >= 0 && x < size_.x && y < size_.y);
    return as_size(y) * as_size(size_.x) + as_size(x);
  }

 private:
  glm::ivec2 size_{0, 0};
  std::vector<T, PixelAllocator<T>> pixels_;
};

}  // namespace pinocchio
