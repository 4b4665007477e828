#include "core/trace/settled/settled_triangles.h"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "core/trace/settled/rough_within.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

bool are_equal(const shared::LightParams& a, const shared::LightParams& b) {
  return a.kind == b.kind && a.inverse_square == b.inverse_square && a.position == b.position &&
         a.direction == b.direction && a.radiance == b.radiance && a.range == b.range &&
         a.cos_inner == b.cos_inner && a.cos_outer == b.cos_outer;
}

}  // namespace

bool operator==(const SettledTriangles::Under& a, const SettledTriangles::Under& b) {
  return a.mirrors == b.mirrors && a.light_cutoff == b.light_cutoff &&
         std::ranges::equal(a.lights, b.lights, [](const MaskLight& x, const MaskLight& y) {
           return are_equal(x.params, y.params) && x.bit == y.bit && x.ways == y.ways;
         });
}

SettledTriangles::SettledTriangles(std::shared_ptr<const Mesh> mesh, Under under)
    : mesh_(std::move(mesh)),
      under_(std::move(under)),
      known_(mesh_->triangles.size()),
      parts_(std::min(kMostByPart, mesh_->triangles.size()) * kParts) {
  constexpr auto kNever = std::bit_cast<std::uint64_t>(SettledPoints{.state = SettledPoints::State::never});
  std::vector<bool> may_be;  // by material
  for (const Material& m : mesh_->materials)
    may_be.push_back((!under_.mirrors || may_be_rough(*mesh_, m)) &&
                     (under_.lights.empty() || may_know_lights(m)));
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (!may_be[mesh_->triangle_materials[i]]) known_[i].store(kNever, std::memory_order_relaxed);
}

// What is known after so many more rays have asked.
SettledPoints SettledTriangles::searched(const PartOfMesh& part, SettledPoints known, unsigned rays,
                                         bool from_front) const {
  const std::uint32_t before = known.more;
  known.more += rays;
  // Each time that their number has doubled.
  if (known.more < kFirstSearch || std::bit_width(before) == std::bit_width(known.more)) return known;
  const SettledPoints asking = known;
  const std::optional<std::uint8_t> lights =
      known_lights(*mesh_, part, from_front, under_.lights, under_.light_cutoff);
  if (!lights) return asking;
  const TrianglePart weights = part.number ? part_of_inside(*part.number) : whole_inside();
  const float rough =
      under_.mirrors ? rough_within(*mesh_, part.triangle, weights) : std::numeric_limits<float>::infinity();
  if (rough == 0.0f) return part.number ? SettledPoints{.state = SettledPoints::State::never} : asking;
  return {SettledPoints::State::settled, from_front, *lights, std::bit_cast<std::uint32_t>(rough)};
}

void SettledTriangles::ask(std::uint32_t triangle, unsigned rays, unsigned many, bool from_front) {
  std::uint64_t bits = known_[triangle].load(std::memory_order_relaxed);
  const auto known = std::bit_cast<SettledPoints>(bits);
  // Parts of such triangles would be smaller than a pixel.
  if (known.state != SettledPoints::State::asking || (known.more >= 4 * kFirstSearch && rays < many)) return;
  SettledPoints now = searched({triangle, {}}, known, rays, from_front);
  if (now.state == SettledPoints::State::asking && now.more >= kEnough) {
    // One thread gives it parts; the others see a triangle without any meanwhile.
    now = {.state = SettledPoints::State::never};
    if (!known_[triangle].compare_exchange_strong(bits, std::bit_cast<std::uint64_t>(now))) return;
    const std::uint32_t index = by_part_.fetch_add(1);
    if (std::size_t{index} * kParts >= parts_.size()) return;
    now = {.state = SettledPoints::State::by_part, .more = index};
    return known_[triangle].store(std::bit_cast<std::uint64_t>(now));
  }
  // Nothing is stored where another thread has counted or searched meanwhile.
  known_[triangle].compare_exchange_strong(bits, std::bit_cast<std::uint64_t>(now));
}

void SettledTriangles::ask_part(std::uint32_t triangle, std::uint32_t part, unsigned rays, bool from_front) {
  std::atomic<std::uint64_t>& state = parts_[place_of(of(triangle), part)];
  std::uint64_t bits = state.load(std::memory_order_relaxed);
  const auto known = std::bit_cast<SettledPoints>(bits);
  if (known.state != SettledPoints::State::asking) return;
  SettledPoints now = searched({triangle, part}, known, rays, from_front);
  if (now.state == SettledPoints::State::asking && now.more >= kEnough)
    now = {.state = SettledPoints::State::never};
  state.compare_exchange_strong(bits, std::bit_cast<std::uint64_t>(now));
}

std::shared_ptr<SettledTriangles> SettledUnderLights::of(const SettledTriangles::Under& under) {
  const std::scoped_lock lock(mutex_);
  if (kept_ && kept_->under() == under) return kept_;
  try {
    if (last_ == under) return kept_ = std::make_shared<SettledTriangles>(mesh_, under);
    last_ = under;
  } catch (const std::bad_alloc&) {  // the step finds all there is
  }
  return nullptr;
}

}  // namespace pinocchio
