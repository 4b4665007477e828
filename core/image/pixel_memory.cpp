#include "pinocchio/pixel_memory.h"

#include <sys/mman.h>

#include <cstdlib>

namespace pinocchio {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21, kCacheLineBytes = 64;

}  // namespace

void* allocate_pixels(std::size_t bytes) {
  // The last page is a large one, too, where an eighth at most is added by it.
  const std::size_t whole = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  const std::size_t size = whole - bytes <= bytes / 8 ? whole : bytes;
  const bool large = size >= kLargePage;
  void* memory = nullptr;
  if (posix_memalign(&memory, large ? kLargePage : kCacheLineBytes, size) != 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (large) madvise(memory, size, MADV_HUGEPAGE);  // a wish: where it is not granted, small pages serve
#endif
  return memory;
}

void free_pixels(void* memory) noexcept { std::free(memory); }

}  // namespace pinocchio
