#include "bench/stability/method.h"

namespace pinocchio::stability {

Method with(TriangleTest test) {
  return {.name = std::string(triangle_test_name(test)), .tree = {.triangle_test = test}};
}

Method with(OffsetMethod offset) {
  return {.name = "offset " + std::string(offset_method_name(offset)), .offset = offset};
}

Method with(Terminator terminator) {
  return {.name = "terminator " + std::string(terminator_name(terminator)), .terminator = terminator};
}

std::vector<Method> all_methods() {
  const Method by_default;
  std::vector<Method> methods{by_default};
  for (const TriangleTest test : kTriangleTests)
    if (test != by_default.tree.triangle_test) methods.push_back(with(test));
  for (const OffsetMethod offset : kOffsetMethods)
    if (offset != by_default.offset) methods.push_back(with(offset));
  for (const Terminator terminator : kTerminators)
    if (terminator != by_default.terminator) methods.push_back(with(terminator));
  methods.push_back({.name = "spatial median", .tree = {.rule = SplitRule::spatial_median}});
  methods.push_back({.name = "object median", .tree = {.rule = SplitRule::object_median}});
  for (const Isa isa : supported_isas())
    if (isa != default_isa()) methods.push_back({.name = std::string(isa_name(isa)), .isa = isa});
  return methods;
}

}  // namespace pinocchio::stability
