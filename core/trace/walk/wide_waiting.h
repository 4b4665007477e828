// Part of walk/wide.h: the nodes and leaves that a ray has still to visit. Adding a node's children has no
// branch on how many of them the ray meets, nor on which is the nearest: one that the processor guesses wrong
// costs more than sorting all eight.
#pragma once

#include <cstdint>
#include <cstring>
#include <utility>

#include "core/bsp/wide/wide_tree.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// A number for each child of a node, in registers of kLanes.
struct OfChildren {
  static constexpr int kLanes = kWidth <= 4 ? 4 : WideNode::kChildren;
  static constexpr int kParts = WideNode::kChildren / kLanes;
  using Part [[gnu::vector_size(4 * kLanes), gnu::may_alias]] = std::int32_t;
  using Stored [[gnu::aligned(4), gnu::may_alias]] = Part;
  Part part[kParts];

  void load(const std::uint32_t* from) {
    for (int p = 0; p < kParts; ++p) part[p] = reinterpret_cast<const Stored*>(from)[p];
  }
  template <class Number>
  void store(Number* to) const {
    for (int p = 0; p < kParts; ++p) reinterpret_cast<Stored*>(to)[p] = part[p];
  }
};

// Compares each number with that whose index differs in exactly the bits of kBy: the larger gets the lower
// index.
template <int kBy, int... kLane>
inline void exchange(OfChildren& a, std::integer_sequence<int, kLane...>) {
  using Part = OfChildren::Part;
  constexpr int kOfParts = kBy / OfChildren::kLanes, kOfLanes = kBy % OfChildren::kLanes;
  for (int p = 0; p < OfChildren::kParts; ++p) {
    const int q = p ^ kOfParts;
    if (p > q) continue;
    const Part other = a.part[q];
    const Part beside = __builtin_shufflevector(other, other, (kLane ^ kOfLanes)...);
    const Part least = a.part[p] < beside ? a.part[p] : beside;
    const Part most = a.part[p] < beside ? beside : a.part[p];
    if constexpr (kOfParts == 0) {
      a.part[p] = __builtin_shufflevector(
          most, least, (kLane < (kLane ^ kOfLanes) ? kLane : kLane + OfChildren::kLanes)...);
    } else {
      a.part[p] = most;
      a.part[q] = __builtin_shufflevector(least, least, (kLane ^ kOfLanes)...);
    }
  }
}

// The largest first, by a sorting network.
[[gnu::always_inline]] inline void sort(OfChildren& a) {
  constexpr std::make_integer_sequence<int, OfChildren::kLanes> lanes;
  exchange<1>(a, lanes);
  exchange<3>(a, lanes);
  exchange<1>(a, lanes);
  exchange<7>(a, lanes);
  exchange<2>(a, lanes);
  exchange<1>(a, lanes);
}

// Stores from[i] for each number of `order`, where i is its lowest three bits.
template <class N = Native>
[[gnu::always_inline]] inline void store_permuted(std::uint32_t* to, const std::uint32_t* from,
                                                  const OfChildren& order) {
  if constexpr (OfChildren::kParts == 1 && requires { N::permuted(NativeInt{}, NativeInt{}); }) {
    OfChildren a;
    a.load(from);
    a.part[0] = OfChildren::Part(N::permuted(NativeInt(a.part[0]), NativeInt(order.part[0])));
    a.store(to);
  } else {
    std::uint32_t index[WideNode::kChildren];
    order.store(index);
#pragma GCC unroll 8
    for (int i = 0; i < WideNode::kChildren; ++i) to[i] = from[index[i] % WideNode::kChildren];
  }
}

// The last that was added is visited next.
class WideWaiting {
 public:
  // The root alone.
  void begin() {
    last_ = 1;
    at_[0] = at_[1] = 0;
    t_[1] = 0.0f;
  }

  [[nodiscard]] bool is_empty() const { return last_ == 0; }
  // As WideNode::child.
  [[nodiscard]] std::uint32_t pop() { return at_[last_--]; }
  // The entry that the next pop() returns; the root where the stack is empty.
  [[nodiscard]] std::uint32_t next() const { return at_[last_]; }

  // Adds those of the kWidth children from number `first` on that are met, unsorted and without their t.
  [[gnu::always_inline]] inline void push(const std::uint32_t* child, int first, Mask met) {
    store_packed(at_ + last_ + 1, Int::load(child + first), met);
    last_ += __builtin_popcount(met.bits());
  }

  // At which t a ray enters each child of a node.
  class Distances {
   public:
    void set(int first, Float near, Mask met) {
      const Int key = (bits_of(near) & Int(kDistance)) | Int::load(kNumbers + first);
      select(met, key, Int(kNone)).store(keys_ + first);
      count_ += __builtin_popcount(met.bits());
    }

   private:
    friend class WideWaiting;
    // A key is a distance's bits, the lowest three replaced by the child's number. Without them the distance
    // is smaller: nothing is dropped too early.
    static constexpr std::uint32_t kDistance = 0x7ffffff8u;
    static constexpr std::uint32_t kNone = ~0u;  // as a signed number less than any key
    alignas(kCacheLine) static constexpr std::uint32_t kNumbers[] = {0, 1, 2, 3, 4, 5, 6, 7};
    alignas(kCacheLine) std::uint32_t keys_[WideNode::kChildren];
    int count_ = 0;
  };
  // Adds the children that are met, sorted: the nearest is visited next.
  [[gnu::always_inline]] inline void push_sorted(const std::uint32_t* child, const Distances& distances) {
    OfChildren key;
    key.load(distances.keys_);
    sort(key);
    store_permuted(at_ + last_ + 1, child, key);
    for (OfChildren::Part& part : key.part) part &= static_cast<std::int32_t>(Distances::kDistance);
    key.store(t_ + last_ + 1);
    last_ += distances.count_;
  }

  // Forgets what the ray enters beyond t. Children that were added unsorted have no t.
  void drop_beyond(float t) {
    int kept = 0;
    for (int i = 1; i <= last_; ++i) {
      t_[kept + 1] = t_[i];
      at_[kept + 1] = at_[i];
      kept += t_[i] <= t ? 1 : 0;
    }
    last_ = kept;
  }

  void take(const WideWaiting& from) {
    last_ = from.last_;
    std::memcpy(t_, from.t_, as_size(last_ + 1) * sizeof(*t_));
    std::memcpy(at_, from.at_, as_size(last_ + 1) * sizeof(*at_));
  }

 private:
  // The last push writes eight: 7 × (depth - 1) + 8.
  static constexpr int kMost = (WideNode::kChildren - 1) * WideTree::kMostDepth + 1;
  int last_;
  float t_[1 + kMost];  // where the ray enters it
  std::uint32_t at_[1 + kMost];
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
