#include "tests/stability/hold.h"

namespace pinocchio::stability {
namespace {

TEST(Triangles, CheaperTestsFail) {
  for (const char* name : {"duplicate triangles", "4096 through one point", "one 1e6 times larger"})
    for (const TriangleTest test : {TriangleTest::projected, TriangleTest::moeller_trumbore})
      expect_fails(stress_case(triangle_cases(), name), with(test));
  for (const char* name : {"coplanar triangles", "8192 in one plane, no volume"})
    expect_fails(stress_case(triangle_cases(), name), with(TriangleTest::moeller_trumbore));
}

}  // namespace
}  // namespace pinocchio::stability
