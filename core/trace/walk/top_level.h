// Part of walk/kernel.h: which moving trees a group of packets reaches, and in which order.
#pragma once

#include "core/bsp/scene_trees.h"
#include "core/trace/walk/traverse.h"
#include "pinocchio/conversion.h"
#include "pinocchio/ray.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Up to this number of boxes, testing them against each ray is faster than making a beam.
constexpr std::size_t kFewTrees = 3;

inline float least_of(Float x) {
  alignas(64) float of_lane[kWidth];
  x.store(of_lane);
  for (unsigned n = kWidth / 2; n > 0; n /= 2)
    for (unsigned i = 0; i < n; ++i) of_lane[i] = of_lane[i + n] < of_lane[i] ? of_lane[i + n] : of_lane[i];
  return of_lane[0];
}
inline float greatest_of(Float x) {
  return -least_of(-x);
}
template <int kPackets>
inline float greatest_of(const Float (&x)[kPackets]) {
  Float greatest = x[0];
  for (int k = 1; k < kPackets; ++k) greatest = max(x[k], greatest);
  return greatest_of(greatest);
}

// The living rays of a group as intervals, for a first test of many boxes at once. Each of its operations
// rounds as reach_box() does for one ray, and rounding keeps the order of numbers: no box that some ray
// reaches is left out.
class Beam {
 public:
  // Before this call the beam reaches every box.
  template <int kPackets>
  void enclose(const Group<kPackets>& group) {
    const Float none(kInfinity);
    for (int axis = 0; axis < 3; ++axis) {
      Float o_least = none, o_greatest = -none, i_least = none, i_greatest = -none;
      for (int k = 0; k < kPackets; ++k) {
        const Mask living = Mask::from_bits(group.packets[k].living);
        const Float &o = group.packets[k].o[axis], &i = group.octants[k].inverse[axis];
        o_least = min(o_least, select(living, o, none));
        o_greatest = max(o_greatest, select(living, o, -none));
        i_least = min(i_least, select(living, i, none));
        i_greatest = max(i_greatest, select(living, i, -none));
      }
      origin_[axis] = {least_of(o_least), greatest_of(o_greatest)};
      inverse_[axis] = {least_of(i_least), greatest_of(i_greatest)};
      const auto& [least, greatest] = inverse_[axis];
      turns_[axis] = !((0.0f < least && greatest < kInfinity) || (-kInfinity < least && greatest < 0.0f));
    }
  }

  // The boxes of the node, from number `first` on, that some ray may reach before `end`; `soonest`: at the
  // earliest then.
  [[nodiscard]] Mask reaches(const TopNode& node, std::size_t first, float end, Float& soonest) const {
    static_assert(TopNode::kMost % kWidth == 0);
    Float t_far(end);
    soonest = Float(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
      if (turns_[axis]) continue;
      const Float lo = Float::load(node.lo[axis] + first) - Float(origin_[axis].greatest),
                  hi = Float::load(node.hi[axis] + first) - Float(origin_[axis].least);
      const Float a(inverse_[axis].least), b(inverse_[axis].greatest);
      const bool falls = inverse_[axis].least < 0.0f;
      const Float &begin = falls ? hi : lo, &last = falls ? lo : hi;
      soonest = max(min(begin * a, begin * b), soonest);
      t_far = min(max(last * a, last * b), t_far);
    }
    return lanes_from(first, node.count) & (soonest * Float(kEarly) <= t_far * Float(kLate));
  }

 private:
  struct Interval {
    float least, greatest;
  };
  Interval origin_[3], inverse_[3];     // of the directions
  bool turns_[3] = {true, true, true};  // the rays neither all rise nor all fall
};

// Boxes of the top level that are still to be looked at; of one node, the soonest first.
class TopStack {
 public:
  struct Entry {
    float soonest;
    std::uint32_t node, box;
  };

  [[nodiscard]] bool empty() const { return size_ == 0; }
  Entry pop() { return entries_[--size_]; }

  // Those of a node that the beam reaches before `end`.
  void push(const SceneTrees& scene, std::uint32_t number, const Beam& beam, float end) {
    const TopNode& node = scene.top[number];
    const int begin = size_;
    for (std::size_t first = 0; first < node.count; first += kWidth) {
      Float soonest;
      unsigned reached = beam.reaches(node, first, end, soonest).bits();
      alignas(64) float of_lane[kWidth];
      soonest.store(of_lane);
      for (; reached != 0; reached &= reached - 1) {
        const auto lane = as_uint32(__builtin_ctz(reached));
        insert(begin, {of_lane[lane], number, as_uint32(first) + lane});
      }
    }
  }

 private:
  void insert(int begin, const Entry& entry) {
    int i = size_++;
    for (; i > begin && entries_[i - 1].soonest < entry.soonest; --i) entries_[i] = entries_[i - 1];
    entries_[i] = entry;
  }

  Entry entries_[kMostTopDepth * TopNode::kMost];
  int size_ = 0;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
