// The number of threads that a caller requests.
#pragma once

#include <pinocchio/settings.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "pinocchio/conversion.h"
#include "python/src/support/convert.h"

namespace pinocchio::python {

// The constructors' argument, or PINOCCHIO_THREADS if that is 0. 0: one for each core.
inline int threads_wanted(int given) {
  if (given < 0 || given > kMostThreads)
    throw Error("threads must be from 0 (one a core) to " + std::to_string(kMostThreads));
  const char* const said = std::getenv("PINOCCHIO_THREADS");
  if (given > 0 || !said || *said == '\0') return given;
  int number = -1;
  const char* const end = said + std::strlen(said);
  if (std::from_chars(said, end, number).ptr != end || number < 0 || number > kMostThreads)
    throw Error("PINOCCHIO_THREADS is '" + std::string(said) + "'; it is a number from 0 (one a core) to " +
                std::to_string(kMostThreads));
  return number;
}

inline int or_one_a_core(int threads) {
  return threads > 0 ? threads : as_int(std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace pinocchio::python
