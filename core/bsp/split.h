#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/bsp/build.h"
#include "core/math/bounds.h"

namespace pinocchio {

// A triangle in a node under construction: `bounds` is of the part of it inside the node.
struct BuildReference {
  std::uint32_t triangle;
  Bounds bounds;
};

struct SplitPlane {
  int axis = 0;
  float position = 0.0f;
  bool flat_goes_low = true;  // triangles that lie in the plane go to the child below it
  float cost = 0.0f;          // expected cost of the node once split (sah only)
};

// Best plane by the surface area heuristic over every bound of every reference (a sweep over sorted
// bounds), or over equal slabs where `references` are many and a sweep would cost more than it gains.
[[nodiscard]] std::optional<SplitPlane> find_sah_split(std::span<const BuildReference> references,
                                                       const Bounds& node, const BuildOptions& options);

[[nodiscard]] std::optional<SplitPlane> find_spatial_median(const Bounds& node);
[[nodiscard]] std::optional<SplitPlane> find_object_median(std::span<const BuildReference> references,
                                                           const Bounds& node);

}  // namespace pinocchio
