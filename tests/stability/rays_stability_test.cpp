#include <gtest/gtest.h>
#include <cstdio>
#include "core/stability/trouble.h"
namespace pinocchio::stability {
TEST(X, Y) {
  for (const Trouble& t : all_troubles()) {
    std::printf("%-32s", std::string(t.name).c_str());
    for (const Method& m : all_methods()) {
      const Tally a = t.run(m, 20000);
      std::printf(" %s %zu/%zu(%zu) %.0fms |", m.name.c_str(), a.failures, a.trials, a.excused, 1e3*a.seconds);
    }
    std::printf("\n");
  }
}
}
