#include "core/bsp/split.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace pinocchio {
namespace {

// Above this many references planes are tried at kBins equal slabs a side instead of at every bound. A
// trade: builds take about two thirds of the time, rays up to 2 % more (docs/measurements.md).
constexpr std::size_t kSweepLimit = 4096;
constexpr int kBins = 256;

// Cutting off empty space is worth more than its area says: it ends rays early (Wald and Havran 2006).
constexpr float kEmptyBonus = 0.8f;

// One side of the longest of a node's sides.
int longest_axis(const Bounds& node) {
  const glm::vec3 e = node.extent();
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

class CostModel {
 public:
  CostModel(const Bounds& node, const BuildOptions& options)
      : node_(node), options_(options), inverse_area_(1.0f / node.half_area()) {}

  // Keeps the better of `best` and the plane at `position` with these counts of references.
  void consider(int axis, float position, std::size_t low, std::size_t flat, std::size_t high,
                std::optional<SplitPlane>& best) const {
    if (!(position > node_.lo[axis] && position < node_.hi[axis])) return;
    Bounds below = node_, above = node_;
    below.hi[axis] = position;
    above.lo[axis] = position;
    const float area_below = below.half_area() * inverse_area_,
                area_above = above.half_area() * inverse_area_;
    const float with_low = cost(area_below, low + flat, area_above, high);
    const float with_high = cost(area_below, low, area_above, flat + high);
    const bool flat_goes_low = with_low <= with_high;
    const float least = flat_goes_low ? with_low : with_high;
    if (!best || least < best->cost) best = SplitPlane{axis, position, flat_goes_low, least};
  }

 private:
  [[nodiscard]] float cost(float area_low, std::size_t low, float area_high, std::size_t high) const {
    const float expected = area_low * static_cast<float>(low) + area_high * static_cast<float>(high);
    const float bonus = low == 0 || high == 0 ? kEmptyBonus : 1.0f;
    return bonus * (options_.cost_step + options_.cost_intersection * expected);
  }

  const Bounds& node_;
  const BuildOptions& options_;
  float inverse_area_;
};

// Sorted so that at one position parts end before flat ones lie before others start. One whole number, so
// that sorting, most of the work, compares without a branch: the position's bits, ordered as floats are,
// above the kind.
class Event {
 public:
  enum Kind : std::uint8_t { end, flat, start };

  Event(float position, Kind kind) : key_(ordered(position + 0.0f) << 2 | kind) {}  // + 0: no -0

  [[nodiscard]] Kind kind() const { return static_cast<Kind>(key_ & 3u); }
  [[nodiscard]] float position() const {
    const auto bits = static_cast<std::uint32_t>(key_ >> 2);
    return std::bit_cast<float>(bits & kSign ? bits ^ kSign : ~bits);
  }
  friend bool operator<(const Event& a, const Event& b) { return a.key_ < b.key_; }

 private:
  static constexpr std::uint32_t kSign = 0x80000000u;
  static std::uint64_t ordered(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return bits & kSign ? ~bits : bits | kSign;
  }
  std::uint64_t key_;
};

void sweep_axis(std::span<const BuildReference> references, int axis, const CostModel& model,
                std::vector<Event>& events, std::optional<SplitPlane>& best) {
  events.clear();
  events.reserve(2 * references.size());
  for (const BuildReference& r : references) {
    const float lo = r.bounds.lo[axis], hi = r.bounds.hi[axis];
    if (lo == hi) {
      events.emplace_back(lo, Event::flat);
    } else {
      events.emplace_back(lo, Event::start);
      events.emplace_back(hi, Event::end);
    }
  }
  std::sort(events.begin(), events.end());

  std::size_t low = 0, high = references.size();
  for (auto e = events.begin(); e != events.end();) {
    const float position = e->position();
    std::array<std::size_t, 3> count{};
    for (; e != events.end() && e->position() == position; ++e) ++count[e->kind()];
    high -= count[Event::end] + count[Event::flat];
    model.consider(axis, position, low, count[Event::flat], high, best);
    low += count[Event::flat] + count[Event::start];
  }
}

void bin_axis(std::span<const BuildReference> references, const Bounds& node, int axis,
              const CostModel& model, std::optional<SplitPlane>& best) {
  const float lo = node.lo[axis], width = node.hi[axis] - lo;
  if (!(width > 0.0f)) return;
  const float scale = static_cast<float>(kBins) / width;
  const auto bin_of = [&](float x) { return std::clamp(static_cast<int>((x - lo) * scale), 0, kBins - 1); };
  std::array<std::size_t, kBins> starts{}, ends{};
  for (const BuildReference& r : references) {
    ++starts[static_cast<std::size_t>(bin_of(r.bounds.lo[axis]))];
    ++ends[static_cast<std::size_t>(bin_of(r.bounds.hi[axis]))];
  }
  std::size_t low = 0, high = references.size();
  for (int i = 0; i + 1 < kBins; ++i) {
    low += starts[static_cast<std::size_t>(i)];
    high -= ends[static_cast<std::size_t>(i)];
    const float position = lo + width * (static_cast<float>(i + 1) / static_cast<float>(kBins));
    model.consider(axis, position, low, 0, high, best);
  }
}

}  // namespace

std::optional<SplitPlane> find_sah_split(std::span<const BuildReference> references, const Bounds& node,
                                         const BuildOptions& options) {
  std::optional<SplitPlane> best;
  if (!(node.half_area() > 0.0f)) return best;
  const CostModel model(node, options);
  std::vector<Event> events;
  for (int axis = 0; axis < 3; ++axis) {
    if (references.size() > kSweepLimit)
      bin_axis(references, node, axis, model, best);
    else
      sweep_axis(references, axis, model, events, best);
  }
  return best;
}

std::optional<SplitPlane> find_spatial_median(const Bounds& node) {
  const int axis = longest_axis(node);
  const float position = node.center()[axis];
  if (!(position > node.lo[axis] && position < node.hi[axis])) return std::nullopt;
  return SplitPlane{axis, position, true, 0.0f};
}

std::optional<SplitPlane> find_object_median(std::span<const BuildReference> references, const Bounds& node) {
  const int axis = longest_axis(node);
  std::vector<float> centers;
  centers.reserve(references.size());
  for (const BuildReference& r : references) centers.push_back(r.bounds.center()[axis]);
  const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
  std::nth_element(centers.begin(), middle, centers.end());
  if (!(*middle > node.lo[axis] && *middle < node.hi[axis])) return std::nullopt;
  return SplitPlane{axis, *middle, true, 0.0f};
}

}  // namespace pinocchio
