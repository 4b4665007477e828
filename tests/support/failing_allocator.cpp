// Compiled into a test, or loaded before a program (LD_PRELOAD): an allocation that fails, the n-th of
// operator new, aligned_alloc and posix_memalign, which is all that we allocate with. Of a program,
// FAILING_ALLOCATION says which, and ALLOCATIONS_FILE names a file for their number; those below 4 KiB
// are not counted there, as the destructors of nlohmann::json, std::filesystem and CLI11 end a program when
// theirs fail.
#include "tests/support/failing_allocator.h"

#include <dlfcn.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace pinocchio {

std::atomic<long> allocations_made{0}, blocks_alive{0};
std::atomic<long> failing_allocation{[] {
  const char* const n = std::getenv("FAILING_ALLOCATION");
  return n ? std::atol(n) : 0;
}()};

}  // namespace pinocchio

namespace {

struct AtExit {
  ~AtExit() {
    const char* const name = std::getenv("ALLOCATIONS_FILE");
    if (std::FILE* const file = name ? std::fopen(name, "w") : nullptr) {
      std::fprintf(file, "%ld\n", pinocchio::allocations_made.load());
      std::fclose(file);
    }
  }
} at_exit;

const std::size_t least_bytes =
    std::getenv("FAILING_ALLOCATION") || std::getenv("ALLOCATIONS_FILE") ? 4096 : 0;

bool fails(std::size_t size) {
  return size >= least_bytes && ++pinocchio::allocations_made == pinocchio::failing_allocation;
}

void* allocate(std::size_t size) noexcept {
  void* const p = fails(size) ? nullptr : std::malloc(size > 0 ? size : 1);
  if (p) ++pinocchio::blocks_alive;
  return p;
}

void release(void* p) noexcept {
  if (p) --pinocchio::blocks_alive;
  std::free(p);
}

}  // namespace

// Not inlined, or GCC takes malloc and free for a pair that does not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* const p = allocate(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate(size);
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  release(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  release(p);
}

extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  static const auto next =
      reinterpret_cast<void* (*)(std::size_t, std::size_t)>(dlsym(RTLD_NEXT, "aligned_alloc"));
  return fails(size) ? nullptr : next(alignment, size);
}

extern "C" int posix_memalign(void** p, std::size_t alignment, std::size_t size) noexcept {
  static const auto next =
      reinterpret_cast<int (*)(void**, std::size_t, std::size_t)>(dlsym(RTLD_NEXT, "posix_memalign"));
  return fails(size) ? ENOMEM : next(p, alignment, size);
}
