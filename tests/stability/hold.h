// What the stability tests ask of a case.
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

// The default, with every tree and at every width: not one failure.
inline void expect_default_holds(const StressCase& stress_case) {
  for (const Method& method : all_methods()) {
    if (method.tree.triangle_test != BuildOptions{}.triangle_test ||
        method.offset != OffsetMethod::error_bound || method.terminator != kUsualTerminator)
      continue;
    const FailureCount count = stress_case.run(method, kRays);
    EXPECT_EQ(count.failures, 0u) << stress_case.name << ", " << method.name << ", of " << count.trials;
    EXPECT_GT(count.trials, 0u) << stress_case.name;
  }
}

// A test that cannot fail proves nothing: the cheaper method does.
inline void expect_fails(const StressCase& stress_case, const Method& method) {
  const FailureCount count = stress_case.run(method, kRays);
  EXPECT_GT(count.failures, 0u) << stress_case.name << ", " << method.name << ", of " << count.trials;
}

class DefaultHolds : public testing::TestWithParam<StressCase> {};

inline std::string test_name(const testing::TestParamInfo<StressCase>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

}  // namespace pinocchio::stability
