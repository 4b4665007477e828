#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pinocchio/terminator.h"
#include "pinocchio/tracer.h"

namespace pinocchio::stability {

// One way to trace, to be driven to where it fails.
struct Method {
  std::string name = "default";
  BuildOptions tree{};
  OffsetMethod offset = OffsetMethod::error_bound;
  std::optional<Isa> isa{};
  Terminator terminator = kUsualTerminator;

  [[nodiscard]] Tracer tracer(MeshData mesh) const {
    return Tracer(std::make_shared<const Mesh>(std::move(mesh)), tree, isa, offset);
  }
};

// The default first; then each method that could stand in its place, one at a time: triangle tests, ray
// offsets, remedies of the shadow terminator, tree builders, and every packet width that this processor has.
[[nodiscard]] std::vector<Method> all_methods();

// The default but for its triangle test, its offset, or its terminator.
[[nodiscard]] Method with(TriangleTest test);
[[nodiscard]] Method with(OffsetMethod offset);
[[nodiscard]] Method with(Terminator terminator);

}  // namespace pinocchio::stability
