// Memory for pictures, which are large and often used once.
#pragma once

#include <cstddef>
#include <new>

#include "pinocchio/conversion.h"

namespace pinocchio {

// Memory in pages of 2 MiB where that wastes little: the system provides pages of 4 KiB one by one at the
// first write, which takes longer than drawing a small mesh. Freed memory is used again, because the system
// must clear new pages. Throws std::bad_alloc.
[[nodiscard]] void* allocate_pixels(std::size_t bytes);
void free_pixels(void* memory, std::size_t bytes) noexcept;

template <class T>
struct PixelAllocator {
  using value_type = T;

  PixelAllocator() = default;
  template <class Other>
  PixelAllocator(const PixelAllocator<Other>&) {}  // NOLINT: the standard requires it

  [[nodiscard]] T* allocate(std::size_t n) {
    if (n > as_size(-1) / (2 * sizeof(T))) throw std::bad_array_new_length();
    return static_cast<T*>(allocate_pixels(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept { free_pixels(memory, n * sizeof(T)); }
  friend bool operator==(const PixelAllocator&, const PixelAllocator&) { return true; }
};

}  // namespace pinocchio
