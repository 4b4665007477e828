#include "core/bsp/build/candidate_planes.h"

#include <emmintrin.h>

#include <algorithm>

namespace pinocchio {
namespace {

// Above this many bounds sorting is faster than comparing each with each.
constexpr std::size_t kCompareLimit = 96;

__m128 select(__m128 mask, __m128 yes, __m128 no) {
  return _mm_or_ps(_mm_and_ps(mask, yes), _mm_andnot_ps(mask, no));
}

// The best of the planes that each of four lanes has seen.
class BestOfLanes {
 public:
  BestOfLanes(const SahCost& cost, float to_beat) : cost_(cost), least_(_mm_set1_ps(to_beat)) {}

  void consider(__m128 position, __m128 low, __m128 flat, __m128 high) {
    const __m128 with_low = cost_(position, _mm_add_ps(low, flat), high);
    const __m128 with_high = cost_(position, low, _mm_add_ps(high, flat));
    const __m128 cost = _mm_min_ps(with_low, with_high);
    const __m128 better = _mm_cmplt_ps(cost, least_);
    least_ = select(better, cost, least_);
    position_ = select(better, position, position_);
    goes_high_ = select(better, _mm_cmplt_ps(with_high, with_low), goes_high_);
  }

  void put(int axis, SplitPlane& best) const {
    alignas(16) float cost[4], position[4];
    _mm_store_ps(cost, least_);
    _mm_store_ps(position, position_);
    const int goes_high = _mm_movemask_ps(goes_high_);
    for (int i = 0; i < 4; ++i)
      if (cost[i] < best.cost) best = {axis, position[i], !(goes_high >> i & 1), cost[i]};
  }

 private:
  const SahCost& cost_;
  __m128 least_, position_ = _mm_setzero_ps(), goes_high_ = _mm_setzero_ps();
};

// How many of `bounds` are below (or above, or at) each of eight positions.
struct Eight {
  __m128i first = _mm_setzero_si128(), second = _mm_setzero_si128();
};
template <class Compare>
Eight count(std::span<const float> bounds, __m128 first, __m128 second, Compare compare) {
  Eight n;
  for (const float x : bounds) {
    const __m128 bound = _mm_set1_ps(x);
    n.first = _mm_sub_epi32(n.first, _mm_castps_si128(compare(bound, first)));
    n.second = _mm_sub_epi32(n.second, _mm_castps_si128(compare(bound, second)));
  }
  return n;
}

// Compares each plane with each bound: with few of them this is faster than sorting.
void compare_all(const CandidatePlanes& p, const float* candidates, std::size_t n, BestOfLanes& best) {
  const __m128 before = _mm_set1_ps(p.before), behind = _mm_set1_ps(p.behind);
  const auto sum = [](__m128 base, __m128i count) { return _mm_add_ps(base, _mm_cvtepi32_ps(count)); };
  const __m128 zero = _mm_setzero_ps();
  for (std::size_t i = 0; i < n; i += 8) {
    const __m128 first = _mm_loadu_ps(candidates + i), second = _mm_loadu_ps(candidates + i + 4);
    const Eight low = count(p.lows, first, second, [](__m128 x, __m128 at) { return _mm_cmplt_ps(x, at); });
    const Eight high = count(p.highs, first, second, [](__m128 x, __m128 at) { return _mm_cmpgt_ps(x, at); });
    const Eight flat = count(p.flats, first, second, [](__m128 x, __m128 at) { return _mm_cmpeq_ps(x, at); });
    best.consider(first, sum(before, low.first), sum(zero, flat.first), sum(behind, high.first));
    if (i + 4 < n)
      best.consider(second, sum(before, low.second), sum(zero, flat.second), sum(behind, high.second));
  }
}

// Tries planes in order; `candidates` receives each position once.
void sweep(const CandidatePlanes& p, float* candidates, BestOfLanes& best) {
  for (const std::span<float> bounds : {p.lows, p.highs, p.flats}) std::sort(bounds.begin(), bounds.end());
  float* end = std::merge(p.lows.begin(), p.lows.end(), p.highs.begin(), p.highs.end(), candidates);
  end = std::unique(candidates, end);
  std::fill_n(end, kAtOnce - 1, end[-1]);
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
    best.consider(_mm_loadu_ps(four), _mm_load_ps(counts[0]), _mm_load_ps(counts[1]), _mm_load_ps(counts[2]));
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
    std::fill_n(end, kAtOnce - 1, candidates[0]);
    compare_all(planes, candidates, n, lanes);
  }
  lanes.put(axis, best);
}

}  // namespace pinocchio
