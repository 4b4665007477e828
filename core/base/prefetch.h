#pragma once

namespace pinocchio {

// Requests the cache line at p. GCC 12 drops calls of functions that only prefetch, unless they are inlined:
// the empty instruction keeps them.
[[gnu::always_inline]] inline void prefetch(const void* p) {
  __builtin_prefetch(p);
  __asm__ volatile("");
}

}  // namespace pinocchio
