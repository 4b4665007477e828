#include "core/bsp/triangle_test.h"

namespace pinocchio {

std::string_view triangle_test_name(TriangleTest test) {
  switch (test) {
    case TriangleTest::projected:
      return "projected";
    case TriangleTest::moeller_trumbore:
      return "moeller-trumbore";
    case TriangleTest::watertight:
      return "watertight";
    case TriangleTest::filtered:
      break;
  }
  return "filtered";
}

std::optional<TriangleTest> parse_triangle_test(std::string_view name) {
  for (const TriangleTest test : kTriangleTests)
    if (name == triangle_test_name(test)) return test;
  return std::nullopt;
}

}  // namespace pinocchio
