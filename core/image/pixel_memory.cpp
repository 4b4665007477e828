#include "pinocchio/pixel_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>

#include "core/base/aligned_vector.h"
#include "core/base/large_memory.h"

namespace pinocchio {
namespace {

// The last page is a large one, too, if that adds at most an eighth.
std::size_t whole_pages(std::size_t bytes) {
  const std::size_t whole = (bytes + kLargePage - 1) / kLargePage * kLargePage;
  return whole - bytes <= bytes / 8 ? whole : bytes;
}

// Recently freed blocks of large pages, the oldest first. A thread that finds the list locked does not wait
// for it (in a forked process the lock may never be released).
class Spare {
 public:
  void* take(std::size_t size) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    for (std::size_t i = 0; lock && i < count_; ++i)
      if (blocks_[i].size == size) return remove(i);
    // The requested sizes differ from the freed ones: free the oldest block.
    if (lock && count_ > 0) std::free(remove(0));
    return nullptr;
  }

  bool keep(void* memory, std::size_t size) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || size > kMost) return false;
    while (bytes_ + size > kMost || count_ == blocks_.size()) std::free(remove(0));
    blocks_[count_++] = {memory, size};
    bytes_ += size;
    return true;
  }

 private:
  struct Block {
    void* memory;
    std::size_t size;
  };

  void* remove(std::size_t i) {
    const Block block = blocks_[i];
    std::copy(blocks_.begin() + i + 1, blocks_.begin() + count_, blocks_.begin() + i);
    --count_;
    bytes_ -= block.size;
    return block.memory;
  }

  // Room for the pictures of two frames of 800 x 600.
  static constexpr std::size_t kMost = std::size_t{32} << 20;

  std::mutex mutex_;
  std::array<Block, 16> blocks_{};
  std::size_t count_ = 0, bytes_ = 0;
};

// Never destroyed: pictures with static storage may be freed later.
Spare& spare() {
  static Spare& all = *new Spare;
  return all;
}

}  // namespace

void* allocate_pixels(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  const bool large = size >= kLargePage;
  if (large)
    if (void* const memory = spare().take(size)) return memory;
  void* memory = nullptr;
  if (posix_memalign(&memory, large ? kLargePage : kCacheLine, size) != 0) throw std::bad_alloc();
#ifdef MADV_HUGEPAGE
  if (large) madvise(memory, size, MADV_HUGEPAGE);  // without success, small pages are used
#endif
  return memory;
}

void free_pixels(void* memory, std::size_t bytes) noexcept {
  const std::size_t size = whole_pages(bytes);
  if (size < kLargePage || !spare().keep(memory, size)) std::free(memory);
}

}  // namespace pinocchio
