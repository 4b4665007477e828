// What the stability tests ask of a case. That the default methods hold is asked in
// default_stability_test.cpp.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bench/stability/stress_case.h"

namespace pinocchio::stability {

inline constexpr int kRays = 10000;  // `pinocchio chart --stability` takes twenty times as many

inline std::ostream& operator<<(std::ostream& out, const StressCase& stress_case) {
  return out << stress_case.name;
}

inline const StressCase& stress_case(std::span<const StressCase> among, std::string_view name) {
  const auto found =
      std::find_if(among.begin(), among.end(), [&](const StressCase& t) { return t.name == name; });
  if (found == among.end()) throw std::logic_error("no case is called " + std::string(name));
  return *found;
}

// A test that cannot fail proves nothing: the cheaper method does.
inline void expect_fails(const StressCase& stress_case, const Method& method) {
  const FailureCount count = stress_case.run(method, kRays);
  EXPECT_GT(count.failures, 0u) << stress_case.name << ", " << method.name << ", of " << count.trials;
}

}  // namespace pinocchio::stability
