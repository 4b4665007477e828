// Loops over long arrays, on all threads; over short ones on the caller's, without starting any.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>

#include "core/parallel/workers.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

// Calls body(first, last) for all of [0, n), in parts of `at_once`.
template <class Body>
void for_each_part(std::size_t n, std::size_t at_once, const Body& body) {
  if (n == 0) return;
  const std::size_t parts = (n - 1) / at_once + 1;
  if (parts == 1) return body(std::size_t{0}, n);
  Workers workers(as_int(std::min<std::size_t>(parts, std::max(1u, std::thread::hardware_concurrency()))));
  workers.for_each(parts, [&](std::size_t i) { body(i * at_once, std::min(n, (i + 1) * at_once)); });
}

// The least i of [0, n) with is(i); n where there is none.
template <class Predicate>
[[nodiscard]] std::size_t first_where(std::size_t n, const Predicate& is) {
  constexpr std::size_t kAtOnce = std::size_t{1} << 17;
  std::atomic<std::size_t> least{n};
  for_each_part(n, kAtOnce, [&](std::size_t first, std::size_t last) {
    std::size_t i = first;
    while (i < last && !is(i)) ++i;
    std::size_t known = least;
    while (i < last && i < known && !least.compare_exchange_weak(known, i)) {
    }
  });
  return least;
}

}  // namespace pinocchio
