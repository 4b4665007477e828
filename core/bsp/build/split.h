#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/bsp/build/build.h"
#include "core/bsp/build/build_reference.h"
#include "core/bsp/build/cost_model.h"
#include "core/bsp/build/slabs.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

struct SplitPlane {
  int axis = 0;
  float position = 0.0f;
  bool flat_goes_low = true;  // triangles that lie in the plane go to the child below it
  float cost = 0.0f;          // expected cost of the node once split (sah only)
};

// Buffers of a search, kept from node to node so that no node allocates.
struct SplitScratch {
  std::vector<float> lows, highs, flats, candidates;
  std::vector<Slabs::Ends> ends;
};

// Best plane by the surface area heuristic over every bound of every reference, if it is cheaper than a leaf.
// Many references are first counted in slabs: a slab whose cost cannot be below the best edge's is not
// searched (branch and bound). With more than a few thousand the best edge itself is taken.
[[nodiscard]] std::optional<SplitPlane> find_sah_split(std::span<const BuildReference> references,
                                                       const Bounds& node, const CostModel& model,
                                                       SplitScratch& scratch);

// Best of the edges between slabs, for nodes with so many references that a closer search does not pay.
[[nodiscard]] std::optional<SplitPlane> find_slab_edge(const Slabs& slabs, std::size_t references,
                                                       const Bounds& node, const CostModel& model);

[[nodiscard]] std::optional<SplitPlane> find_spatial_median(const Bounds& node);
[[nodiscard]] std::optional<SplitPlane> find_object_median(std::span<const BuildReference> references,
                                                           const Bounds& node);

}  // namespace pinocchio
