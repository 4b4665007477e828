#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/bsp/build/build_reference.h"
#include "pinocchio/bounds.h"

namespace pinocchio {

// How many references begin and end in each of equal slabs of a node, on all three axes. Despite
// rounding, a bound in a lower slab is lower than one in a higher slab.
class Slabs {
 public:
  static constexpr int kMost = 256;

  // `count`: slabs on each axis, a multiple of 4 and at most kMost.
  Slabs(const Bounds& node, int count);

  // `memory`: receives for each reference the slabs in which it begins and ends; null: not wanted.
  struct Ends {
    struct {
      std::uint8_t first, last;
    } on[4];  // by axis; the fourth is unused
  };
  void add(std::span<const BuildReference> references, Ends* memory = nullptr);
  void add(const Slabs& other);  // of the same node and count

  [[nodiscard]] int count() const { return count_; }
  // Whether a plane there is inside the node.
  [[nodiscard]] bool inside(float x, int axis) const { return x > lo_[axis] && x < hi_[axis]; }
  [[nodiscard]] float edge(int i, int axis) const { return lo_[axis] + i * width_[axis]; }
  // References that begin and that end in slab i, without those at the node's own side, where no plane is.
  [[nodiscard]] std::uint32_t starts(int i, int axis) const {
    return at(starts_, i, axis) - (i == 0 ? at_lo_[axis] : 0);
  }
  [[nodiscard]] std::uint32_t ends(int i, int axis) const {
    return at(ends_, i, axis) - (i == count_ - 1 ? at_hi_[axis] : 0);
  }
  // References that begin at the node's lower side.
  [[nodiscard]] std::uint32_t before_all(int axis) const { return at_lo_[axis]; }

 private:
  using Counts = std::array<std::array<std::uint32_t, kMost>, 3>;
  static std::uint32_t at(const Counts& counts, int i, int axis) { return counts[axis][i]; }

  int count_;
  alignas(16) float lo_[4];
  alignas(16) float hi_[4];
  alignas(16) float scale_[4];
  float width_[3];
  std::uint32_t at_lo_[3] = {};
  std::uint32_t at_hi_[3] = {};
  Counts starts_, ends_;
};

}  // namespace pinocchio
