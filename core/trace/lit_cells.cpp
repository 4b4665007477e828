#include "core/trace/lit_cells.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/trace/lit_proof.h"

namespace pinocchio {
namespace {

// A cell's state: pixels that asked so far, below kDue, or one of these.
constexpr std::uint8_t kDue = 32;  // looking into a cell costs about as much as so many rays
constexpr std::uint8_t kLeftToRays = 253, kTurnedAway = 254, kLit = 255;

// Looked into at the beginning of one pass, at most: a few milliseconds.
constexpr std::size_t kMostAPass = 4096;
constexpr std::size_t kChunk = 64;

// An eye this near a triangle's plane (in parts of its distance) does not know its side.
constexpr float kNearPlane = 2e-4f;

constexpr int kMostCuts = 64;
constexpr float kCellsAcross = 200.0f;          // cells along the scene's diagonal ...
constexpr std::size_t kMostCells = 1u << 22;    // ... fewer where that makes more than so many, beside
constexpr std::size_t kMostCellsATriangle = 4;  // so many a triangle

// Cells keep this share of themselves off the triangle's edges: a shaft may be wider than its rays and yet
// not touch the neighbours. Pixels between are left to rays.
constexpr float kEdge = 1.0f / 256.0f;

// More than the rounding of a weight, in cells.
constexpr float kRounded = 0.01f;

bool same(const shared::LightParams& a, const shared::LightParams& b) {
  return a.kind == b.kind && a.inverse_square == b.inverse_square && a.position == b.position &&
         a.direction == b.direction && a.radiance == b.radiance && a.range == b.range &&
         a.cos_inner == b.cos_inner && a.cos_outer == b.cos_outer;
}

std::array<glm::vec3, 3> corners_of(const Mesh& mesh, std::uint32_t triangle) {
  const glm::uvec3& ids = mesh.triangles[triangle];
  return {mesh.positions[ids.x], mesh.positions[ids.y], mesh.positions[ids.z]};
}

// Weights of b and c at the corners of cell `i` of a triangle whose edges are cut into `cuts`: row by row
// along b, in a row by turns a cell that stands and one that hangs.
std::array<glm::dvec2, 3> cell_corners(int i, int cuts) {
  int row = 0;
  for (; i >= 2 * (cuts - row) - 1; ++row) i -= 2 * (cuts - row) - 1;
  const glm::dvec2 at(row, i / 2);
  std::array<glm::dvec2, 3> corners{at, at + glm::dvec2(1, 0), at + glm::dvec2(0, 1)};
  if (i % 2 == 1) corners[0] += glm::dvec2(1, 1);
  const double edge = static_cast<double>(kEdge) / cuts;
  for (glm::dvec2& corner : corners) corner = edge + (1.0 - 3.0 * edge) * corner / static_cast<double>(cuts);
  return corners;
}

// One where lengths leave float's range or the scene has none.
int cuts_of(const std::array<glm::vec3, 3>& corners, float cell_size) {
  const auto& [a, b, c] = corners;
  const float cuts = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)}) / cell_size;
  if (!(cell_size > 0.0f) || !std::isfinite(cuts)) return 1;
  return static_cast<int>(std::clamp(cuts, 1.0f, float{kMostCuts}));
}

}  // namespace

bool LitCells::suits(const Tracer& tracer) {
  return tracer.offset().method == OffsetMethod::error_bound && tracer.tree().test == TriangleTest::filtered;
}

LitCells::LitCells(const Tracer& tracer) : tracer_(tracer) {
  cut_triangles();
}

void LitCells::cut_triangles() {
  diagonal_ = tracer_.tree().bounds.diagonal();
  cell_size_ = diagonal_ / kCellsAcross;
  const std::size_t most = kMostCells + kMostCellsATriangle * tracer_.mesh().triangles.size();
  first_.resize(tracer_.mesh().triangles.size());
  cuts_.resize(first_.size());
  for (;; cell_size_ *= 2.0f) {
    cells_ = 0;
    for (std::uint32_t i = 0; i < first_.size(); ++i) {
      const int cuts = cuts_of(corners_of(tracer_.mesh(), i), cell_size_);
      first_[i] = static_cast<std::uint32_t>(cells_);
      cuts_[i] = static_cast<std::uint8_t>(cuts);
      cells_ += 2 * static_cast<std::size_t>(cuts * cuts);
    }
    if (cells_ <= most) return;
  }
}

void LitCells::forget_what_changed(std::span<const shared::LightParams> lights, float least_light) {
  if (lights.size() != lights_.size() || least_light != least_light_) {
    states_.assign(lights.size() * cells_, 0);
    due_.clear();
  } else {
    for (std::size_t slot = 0; slot < lights.size(); ++slot) {
      if (same(lights[slot], lights_[slot])) continue;
      std::fill_n(states_.begin() + static_cast<std::ptrdiff_t>(slot * cells_), cells_, 0);
      std::erase_if(due_, [&](const Due& due) { return due.slot == slot; });
    }
  }
  lights_.assign(lights.begin(), lights.end());
  least_light_ = least_light;
}

std::unique_lock<std::mutex> LitCells::begin_pass(std::span<const shared::LightParams> lights,
                                                  float least_light, Workers& workers) {
  std::unique_lock pass(pass_);
  forget_what_changed(lights, least_light);
  std::sort(due_.begin(), due_.end());  // threads noted them in any order
  const std::size_t now = std::min(due_.size(), kMostAPass);
  workers.for_each((now + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(now, (chunk + 1) * kChunk); ++i) look_into(due_[i]);
  });
  due_.erase(due_.begin(), due_.begin() + static_cast<std::ptrdiff_t>(now));
  return pass;
}

void LitCells::look_into(const Due& due) {
  std::uint8_t& result = state(due);
  if (result != kDue) return;  // a ray was blocked meanwhile
  result = kLeftToRays;
  const auto triangle = static_cast<std::uint32_t>(std::upper_bound(first_.begin(), first_.end(), due.cell) -
                                                   first_.begin() - 1);
  const int cuts = cuts_[triangle], cell_number = static_cast<int>(due.cell - first_[triangle]);
  const bool back = cell_number >= cuts * cuts;
  const CellPlace place{triangle, back != falls(triangle),
                        cell_corners(back ? cell_number - cuts * cuts : cell_number, cuts)};
  const Proof proof = prove(tracer_.mesh(), tracer_.tree(), place, lights_[due.slot], least_light_);
  if (proof == Proof::lit) result = kLit;
  if (proof == Proof::turned_away) result = kTurnedAway;
}

// Whether the normal of a triangle's winding falls along the axis of its projection: side_of goes by the one
// that rises.
bool LitCells::falls(std::uint32_t triangle) const {
  const std::array<glm::vec3, 3> corners = corners_of(tracer_.mesh(), triangle);
  const glm::dvec3 a(corners[0]);
  const glm::dvec3 n = glm::cross(glm::dvec3(corners[1]) - a, glm::dvec3(corners[2]) - a);
  return n[static_cast<int>(projected(triangle).k)] < 0.0;
}

ProjectedTriangle LitCells::projected(std::uint32_t triangle) const {
  const std::array<glm::vec3, 3> corners = corners_of(scene_, triangle);
  return ProjectedTriangle::from(corners[0], corners[1], corners[2], triangle);
}

LitCells::Side LitCells::side_of(std::uint32_t triangle, const glm::vec3& eye) const {
  const ProjectedTriangle t = projected(triangle);
  const int k = static_cast<int>(t.k), u = (k + 1) % 3, v = (k + 2) % 3;
  const glm::vec3 from_a = eye - glm::vec3(t.a[0], t.a[1], t.a[2]);
  const float height = from_a[k] + t.n_u * from_a[u] + t.n_v * from_a[v];
  const int cuts = cuts_[triangle];
  const float longest = cuts < kMostCuts ? static_cast<float>(cuts + 1) * cell_size_ : diagonal_;
  const float reach = std::abs(from_a.x) + std::abs(from_a.y) + std::abs(from_a.z) + longest;
  if (!(std::abs(height) > kNearPlane * reach)) return {};
  const float edge = kEdge / static_cast<float>(cuts);
  return {first_[triangle] + static_cast<std::uint32_t>(height > 0.0f ? 0 : cuts * cuts), cuts, edge,
          static_cast<float>(cuts) / (1.0f - 3.0f * edge)};
}

std::optional<std::uint32_t> LitCells::cell_of(const Side& side, const glm::vec3& weights) {
  const float b = (weights.y - side.edge) * side.scale, c = (weights.z - side.edge) * side.scale;
  if (!(b >= 0.0f && c >= 0.0f && b + c <= static_cast<float>(side.cuts)))
    return std::nullopt;  // or no cuts at all
  if (side.cuts <= 1) return side.cuts == 1 ? std::optional(side.first) : std::nullopt;
  const int row = std::min(static_cast<int>(b), side.cuts - 1);
  const int column = std::min(static_cast<int>(c), side.cuts - 1 - row);
  const float across = b - static_cast<float>(row) + c - static_cast<float>(column);
  const int hangs = (across > 1.0f) & (column < side.cuts - 1 - row);
  return side.first + static_cast<std::uint32_t>(row * (2 * side.cuts - row) + 2 * column + hangs);
}

LitCells::Known LitCells::known(std::uint32_t cell, std::size_t slot) const {
  const std::uint8_t state = std::atomic_ref(const_cast<std::uint8_t&>(states_[slot * cells_ + cell]))
                                 .load(std::memory_order_relaxed);
  return state == kLit ? Known::lit : state == kTurnedAway ? Known::turned_away : Known::nothing;
}

LitCells::Known LitCells::known_between(const Side& side, std::span<const glm::vec3> weights,
                                        std::size_t slot) const {
  if (side.cuts == 0) return Known::nothing;
  float b_least = kInfinity, b_most = -kInfinity, c_least = kInfinity, c_most = -kInfinity,
        sum_most = -kInfinity;
  for (const glm::vec3& w : weights) {
    const float b = (w.y - side.edge) * side.scale, c = (w.z - side.edge) * side.scale;
    b_least = std::min(b_least, b), b_most = std::max(b_most, b);
    c_least = std::min(c_least, c), c_most = std::max(c_most, c);
    sum_most = std::max(sum_most, b + c);
  }
  // Points between may be rounded past the outermost.
  b_least -= kRounded, c_least -= kRounded, b_most += kRounded, c_most += kRounded;
  if (!(b_least >= 0.0f && c_least >= 0.0f && sum_most + kRounded <= static_cast<float>(side.cuts)))
    return Known::nothing;
  Known result = Known::nothing;
  for (int row = static_cast<int>(b_least); row <= std::min(static_cast<int>(b_most), side.cuts - 1); ++row) {
    const int last = std::min(static_cast<int>(c_most), side.cuts - 1 - row);
    for (int column = static_cast<int>(c_least); column <= last; ++column) {
      for (int hangs = 0; hangs <= (column < side.cuts - 1 - row ? 1 : 0); ++hangs) {
        const Known here = known(
            side.first + static_cast<std::uint32_t>(row * (2 * side.cuts - row) + 2 * column + hangs), slot);
        if (here == Known::nothing || (result != Known::nothing && here != result)) return Known::nothing;
        result = here;
      }
    }
  }
  return result;
}

void LitCells::note(std::span<const Finding> findings) {
  std::vector<Due> due;
  for (const Finding& f : findings) {
    const Due one{f.slot, f.cell};
    std::atomic_ref<std::uint8_t> shared_state(state(one));
    std::uint8_t count = shared_state.load(std::memory_order_relaxed);
    if (f.blocked) {
      shared_state.store(kLeftToRays, std::memory_order_relaxed);
      continue;
    }
    while (count < kDue && !shared_state.compare_exchange_weak(count, count + 1, std::memory_order_relaxed)) {
    }
    if (count + 1 == kDue) due.push_back(one);
  }
  if (due.empty()) return;
  const std::lock_guard lock(noting_);
  due_.insert(due_.end(), due.begin(), due.end());
}

}  // namespace pinocchio
