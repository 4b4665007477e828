#pragma once

#include <atomic>

namespace pinocchio {

// Counts of the program that failing_allocator.cpp is compiled into or loaded before.
extern std::atomic<long> allocations_made;    // since the beginning
extern std::atomic<long> failing_allocation;  // the one that fails, by that count
extern std::atomic<long> blocks_alive;        // made by operator new and not deleted

// The n-th allocation from here fails; 0: none does.
inline void fail_allocation(long n) {
  failing_allocation = n > 0 ? allocations_made + n : 0;
}

}  // namespace pinocchio
