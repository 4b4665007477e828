// What the stability tests ask of a trouble.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "bench/stability/trouble.h"

namespace pinocchio::stability {

inline constexpr int kRays = 10000;  // `pinocchio chart --stability` takes twenty times as many

inline std::ostream& operator<<(std::ostream& out, const Trouble& trouble) {
  return out << trouble.name;
}

inline const Trouble& trouble(std::span<const Trouble> among, std::string_view name) {
  const auto found =
      std::find_if(among.begin(), among.end(), [&](const Trouble& t) { return t.name == name; });
  if (found == among.end()) throw std::logic_error("no trouble is called " + std::string(name));
  return *found;
}

// The default, with every tree and at every width: not one failure.
inline void expect_default_holds(const Trouble& trouble) {
  for (const Method& method : all_methods()) {
    if (method.tree.triangle_test != BuildOptions{}.triangle_test ||
        method.offset != OffsetMethod::error_bound)
      continue;
    const Tally tally = trouble.run(method, kRays);
    EXPECT_EQ(tally.failures, 0u) << trouble.name << ", " << method.name << ", of " << tally.trials;
    EXPECT_GT(tally.trials, 0u) << trouble.name;
  }
}

// A test that cannot fail proves nothing: the cheaper method does.
inline void expect_fails(const Trouble& trouble, const Method& method) {
  const Tally tally = trouble.run(method, kRays);
  EXPECT_GT(tally.failures, 0u) << trouble.name << ", " << method.name << ", of " << tally.trials;
}

class DefaultHolds : public testing::TestWithParam<Trouble> {};

inline std::string test_name(const testing::TestParamInfo<Trouble>& info) {
  std::string name;
  for (const char c : info.param.name)
    if (std::isalnum(static_cast<unsigned char>(c))) name += c;
  return name;
}

}  // namespace pinocchio::stability
