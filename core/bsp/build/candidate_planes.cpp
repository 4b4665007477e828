#include "core/bsp/build/candidate_planes.h"

#include <algorithm>

namespace pinocchio {
namespace {

// Above this many bounds sorting is faster than comparing each with each.
constexpr std::size_t kCompareLimit = 96;

// The best of the planes that each of four lanes has seen.
class BestOfLanes {
 public:
  BestOfLanes(const SahCost& cost, float to_beat) : cost_(cost), least_(all_of(to_beat)) {}

  void consider(Four position, Four low, Four flat, Four high) {
    const Four with_low = cost_(position, low + flat, high);
    const Four with_high = cost_(position, low, high + flat);
    const Four cost = min(with_low, with_high);
    const FourInts better = cost < least_;
    least_ = better ? cost : least_;
    position_ = better ? position : position_;
    goes_high_ = better ? with_high < with_low : goes_high_;
  }

  void put(int axis, SplitPlane& best) const {
    for (int i = 0; i < 4; ++i)
      if (least_[i] < best.cost) best = {axis, position_[i], goes_high_[i] == 0, least_[i]};
  }

 private:
  const SahCost& cost_;
  Four least_, position_{};
  FourInts goes_high_{};
};

// How many of `bounds` are below (or above, or at) each of eight positions.
struct Eight {
  FourInts first{}, second{};
};
template <class Compare>
Eight count(std::span<const float> bounds, Four first, Four second, Compare compare) {
  Eight n;
  for (const float x : bounds) {
    const Four bound = all_of(x);
    n.first -= compare(bound, first);
    n.second -= compare(bound, second);
  }
  return n;
}

// Compares each plane with each bound: with few of them this is faster than sorting.
void compare_all(const CandidatePlanes& p, const float* candidates, std::size_t n, BestOfLanes& best) {
  const Four before = all_of(p.before), behind = all_of(p.behind);
  for (std::size_t i = 0; i < n; i += 8) {
    const Four first = load_unaligned(candidates + i), second = load_unaligned(candidates + i + 4);
    const Eight low = count(p.lows, first, second, [](Four x, Four at) { return x < at; });
    const Eight high = count(p.highs, first, second, [](Four x, Four at) { return x > at; });
    const Eight flat = count(p.flats, first, second, [](Four x, Four at) { return x == at; });
    best.consider(first, before + to_floats(low.first), to_floats(flat.first),
                  behind + to_floats(high.first));
    if (i + 4 < n)
      best.consider(second, before + to_floats(low.second), to_floats(flat.second),
                    behind + to_floats(high.second));
  }
}

// Tries planes in order; `candidates` receives each position once.
void sweep(const CandidatePlanes& p, float* candidates, BestOfLanes& best) {
  for (const std::span<float> bounds : {p.lows, p.highs, p.flats}) std::sort(bounds.begin(), bounds.end());
  float* end = std::merge(p.lows.begin(), p.lows.end(), p.highs.begin(), p.highs.end(), candidates);
  end = std::unique(candidates, end);
  std::fill_n(end, kPlanesAtOnce - 1, end[-1]);
  std::size_t low = 0, ended = 0, flat = 0;
  alignas(16) float counts[3][4];
  for (const float* four = candidates; four < end; four += 4) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
      const float position = four[lane];
      while (low < p.lows.size() && p.lows[low] < position) ++low;
      while (ended < p.highs.size() && p.highs[ended] <= position) ++ended;
      while (flat < p.flats.size() && p.flats[flat] < position) ++flat;
      std::size_t flat_end = flat;
      while (flat_end < p.flats.size() && p.flats[flat_end] == position) ++flat_end;
      counts[0][lane] = p.before + low;
      counts[1][lane] = flat_end - flat;
      counts[2][lane] = p.behind + (p.highs.size() - ended);
    }
    best.consider(load_unaligned(four), load_four(counts[0]), load_four(counts[1]), load_four(counts[2]));
  }
}

}  // namespace

void try_planes(const CandidatePlanes& planes, const SahCost& cost, int axis, std::span<float> buffer,
                SplitPlane& best) {
  float* const candidates = buffer.data();
  const std::size_t n = planes.lows.size() + planes.highs.size();
  if (n == 0) return;
  BestOfLanes lanes(cost, best.cost);
  if (n > kCompareLimit) {
    sweep(planes, candidates, lanes);
  } else {
    float* const end = std::copy(planes.highs.begin(), planes.highs.end(),
                                 std::copy(planes.lows.begin(), planes.lows.end(), candidates));
    std::fill_n(end, kPlanesAtOnce - 1, candidates[0]);
    compare_all(planes, candidates, n, lanes);
  }
  lanes.put(axis, best);
}

}  // namespace pinocchio
