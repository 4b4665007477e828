// Compiled into a test, or loaded before a program (LD_PRELOAD): the system's limit of threads, which root
// has not, and which depends on nobody else's processes. Of a program, LIMITED_THREADS says how many start.
#include "tests/support/limited_threads.h"

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>
#include <cstdlib>
#include <limits>

namespace pinocchio {
namespace {

int limit_of_environment() {
  const char* const limit = std::getenv("LIMITED_THREADS");
  return limit ? std::atoi(limit) : std::numeric_limits<int>::max();
}

}  // namespace

std::atomic<int> threads_left{limit_of_environment()};

}  // namespace pinocchio

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
                              void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (pinocchio::threads_left.fetch_sub(1) <= 0) return EAGAIN;
  return create(thread, attributes, body, argument);
}
