// The stability suite: difficult cases for ray tracers, and the number of a method's failures.
// tests/stability requires zero failures of the default methods; `pinocchio chart --stability` prints the
// table.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "bench/stability/method.h"

namespace pinocchio::stability {

// The result of a case.
struct FailureCount {
  std::uint64_t trials = 0;
  std::uint64_t failures = 0;
  std::uint64_t excused = 0;  // misses that are the scene's fault, according to the reference in double
  double seconds = 0.0;       // processor time of tracing alone

  FailureCount& operator+=(const FailureCount& o) {
    trials += o.trials;
    failures += o.failures;
    excused += o.excused;
    seconds += o.seconds;
    return *this;
  }
};

struct StressCase {
  std::string_view name;
  std::string_view failure;  // the counted failures
  // rays: the approximate number of trials: five times as many at edges, fewer where a trial is expensive.
  // All methods have the same trials.
  FailureCount (*run)(const Method& method, int rays);
};

// Rays against closed meshes, odd directions, odd triangles: leaks.cpp, directions.cpp, triangles.cpp.
// Shadows and offsets at every scale: shadows.cpp. Shading normals
// against facets: terminator.cpp. Mirrors and glass: bounces.cpp. Leaves: holes.cpp.
[[nodiscard]] std::span<const StressCase> leak_cases();
[[nodiscard]] std::span<const StressCase> direction_cases();
[[nodiscard]] std::span<const StressCase> triangle_cases();
[[nodiscard]] std::span<const StressCase> shadow_cases();
[[nodiscard]] std::span<const StressCase> terminator_cases();
[[nodiscard]] std::span<const StressCase> bounce_cases();
[[nodiscard]] std::span<const StressCase> hole_cases();

// All of the above, in that order.
[[nodiscard]] std::vector<StressCase> all_cases();

}  // namespace pinocchio::stability
