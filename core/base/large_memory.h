// Memory for arrays as large as a file.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace pinocchio {

inline constexpr std::size_t kLargePage = std::size_t{1} << 21;

// Requests pages of kLargePage for the whole ones inside. The system provides pages of 4 KiB one by one as
// they are first written, which takes longer than the writing. Without large pages, small ones are used.
inline void prefer_large_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const std::uintptr_t begin =
                           (reinterpret_cast<std::uintptr_t>(memory) + kLargePage - 1) & ~(kLargePage - 1),
                       end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) & ~(kLargePage - 1);
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

template <class T, class Allocator>
void reserve_large(std::vector<T, Allocator>& vector, std::size_t count) {
  vector.reserve(count);
  prefer_large_pages(vector.data(), vector.capacity() * sizeof(T));
}

// Makes room for `count`; at least doubles the capacity where it grows.
template <class T>
void grow_large(std::vector<T>& vector, std::size_t count) {
  if (count > vector.capacity())
    reserve_large(vector, vector.empty() ? count : std::max(count, 2 * vector.capacity()));
}

// As resize().
template <class T>
void resize_large(std::vector<T>& vector, std::size_t count, const T& value = T()) {
  grow_large(vector, count);
  vector.resize(count, value);
}

// Writes the new elements once; resizing and copying would write them twice.
template <class T>
void append_large(std::vector<T>& vector, std::span<const T> more) {
  grow_large(vector, vector.size() + more.size());
  vector.insert(vector.end(), more.begin(), more.end());
}

}  // namespace pinocchio
