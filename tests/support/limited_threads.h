#pragma once

#include <atomic>

namespace pinocchio {

// How many threads the system still starts; then pthread_create() fails as it does at a limit.
extern std::atomic<int> threads_left;

}  // namespace pinocchio
