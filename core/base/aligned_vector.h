#pragma once

#include <boost/align/aligned_allocator.hpp>
#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace pinocchio {

inline constexpr std::size_t kCacheLine = 64;

// Leaves new elements without values: they are written anyhow, mostly by several threads.
template <class T>
struct CacheAllocator : boost::alignment::aligned_allocator<T, kCacheLine> {
  template <class U>
  struct rebind {
    using other = CacheAllocator<U>;
  };
  template <class U>
  void construct(U* at) {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Values>
  void construct(U* at, Values&&... values) {
    ::new (static_cast<void*>(at)) U(std::forward<Values>(values)...);
  }
};

template <class T>
using AlignedVector = std::vector<T, CacheAllocator<T>>;

}  // namespace pinocchio
