#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pinocchio/terminator.h"
#include "pinocchio/tracer.h"

namespace pinocchio::stability {

// A way to trace, which is tested where methods fail.
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

// The default, and then each alternative, one at a time: triangle tests, ray offsets, treatments of the
// shadow terminator, tree builders, and every packet width that this processor has.
[[nodiscard]] std::vector<Method> all_methods();

// The default with another triangle test, offset or terminator.
[[nodiscard]] Method with(TriangleTest test);
[[nodiscard]] Method with(OffsetMethod offset);
[[nodiscard]] Method with(Terminator terminator);

}  // namespace pinocchio::stability
