// The kernels, written once over the lanes and the triangle tests beside this file. They are compiled for
// each instruction set (kernel.cpp.in). Everything is in that set's namespace, PINOCCHIO_LANES: the linker
// must never keep a function compiled for AVX as the one for all.
#include <algorithm>
#include <utility>

#include "core/trace/walk/exact_triangle.h"
#include "core/trace/walk/filtered.h"
#include "core/trace/walk/found.h"
#include "core/trace/walk/kernels.h"
#include "core/trace/walk/moeller_trumbore.h"
#include "core/trace/walk/moving.h"
#include "core/trace/walk/projected.h"
#include "core/trace/walk/traverse.h"
#include "core/trace/walk/watertight.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Finds what a group of packets hits: rays i and on of n. `more`: what Found is made of, beside the rays'
// ends.
template <class Test, class Found, std::size_t... kIndex, class... More>
inline Found hits_of_group(const SceneTrees& scene, const RayColumns& rays, std::size_t i, std::size_t n,
                           std::index_sequence<kIndex...> packets, const More&... more) {
  constexpr int kPackets = sizeof...(kIndex);
  Group<kPackets> group;
  (group.packets[kIndex].load(rays, i + kIndex * kWidth, n), ...);
  const Test tests[]{Test(scene, group.packets[kIndex])...};
  Found found({group.packets[kIndex].t_max...}, more...);
  const BspTree& tree = *scene.still;
  const StoredIn stored(Test::stored(tree));
  if (!tree.references.empty())
    for_each_octant(group, [&](const bool(&negative)[3], const Mask(&lanes)[kPackets]) {
      hits_in_tree(scene, tree, stored, group, ExactPlanes{}, negative, lanes, tests, rays, i, found);
    });
  if (!scene.top.empty()) add_moving_hits<Test>(scene, rays, i, n, packets, found);
  return found;
}

constexpr int kPackets = 4;  // in a group

// The hits of the group of rays i and on.
inline void store_hits(const ClosestHits<kPackets>& found, std::size_t i, std::size_t n,
                       std::uint32_t* triangle, float* t) {
  for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k) {
    found.id[k].store(triangle + i + k * kWidth);
    if (t) found.t_best[k].store(t + i + k * kWidth);
  }
}

inline void store_blocked(const AnyHits<kPackets>& found, std::size_t i, std::size_t n,
                          std::uint8_t* blocked) {
  for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k)
    for (unsigned lane = 0; lane < kWidth; ++lane)
      blocked[i + k * kWidth + lane] = static_cast<std::uint8_t>(found.hit[k] >> lane & 1u);
}

template <class Test>
void closest_hits(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint32_t* triangle,
                  float* t) {
  for (std::size_t i = 0; i < n; i += kPackets * kWidth)
    store_hits(
        hits_of_group<Test, ClosestHits<kPackets>>(scene, rays, i, n, std::make_index_sequence<kPackets>()),
        i, n, triangle, t);
}

template <class Test>
void closest_fronts(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                    const MaterialMarks& backs, std::uint32_t* triangle, float* t) {
  for (std::size_t i = 0; i < n; i += kPackets * kWidth)
    store_hits(hits_of_group<Test, ClosestFronts<kPackets>>(
                   scene, rays, i, n, std::make_index_sequence<kPackets>(), scene, rays, i, backs),
               i, n, triangle, t);
}

template <class Test>
void occluded(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint8_t* blocked) {
  for (std::size_t i = 0; i < n; i += kPackets * kWidth) {
    const auto found =
        hits_of_group<Test, AnyHits<kPackets>>(scene, rays, i, n, std::make_index_sequence<kPackets>());
    store_blocked(found, i, n, blocked);
  }
}

template <class Test>
void occluded_unless_passed(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                            const PassedSurfaces& passed, std::uint8_t* blocked) {
  for (std::size_t i = 0; i < n; i += kPackets * kWidth) {
    const auto found = hits_of_group<Test, AnyNotPassed<kPackets>>(
        scene, rays, i, n, std::make_index_sequence<kPackets>(), rays, i, passed);
    for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k)
      for (unsigned lane = 0; lane < kWidth; ++lane) {
        const bool met = (found.hit[k] >> lane & 1u) != 0, may_pass = (found.may_pass[k] >> lane & 1u) != 0;
        blocked[i + k * kWidth + lane] = met ? 1 : may_pass ? kMayPass : 0;
      }
  }
}

// Rays i and on, before they have hit anything.
template <class Found, std::size_t... kIndex, class... More>
inline Found nothing_hit(const RayColumns& rays, std::size_t i, std::size_t n, std::index_sequence<kIndex...>,
                         const More&... more) {
  Packet packets[sizeof...(kIndex)];
  (packets[kIndex].load(rays, i + kIndex * kWidth, n), ...);
  return Found({packets[kIndex].t_max...}, more...);
}

// Adds what the group of rays i and on hits in the moving trees.
inline void add_closest(const SceneTrees& scene, const RayColumns& rays, std::size_t i, std::size_t n,
                        auto found, std::uint32_t* triangle, float* t) {
  for (std::size_t k = 0; k < kPackets && i + k * kWidth < n; ++k) {
    const std::size_t first = i + k * kWidth;
    found.id[k] = Int::load(triangle + first);
    found.t_best[k] = select(lanes_from(first, n), Float::load(t + first), found.t_best[k]);
  }
  add_moving_hits<FilteredTest>(scene, rays, i, n, std::make_index_sequence<kPackets>(), found);
  store_hits(found, i, n, triangle, t);
}

void add_closest_hits(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint32_t* triangle,
                      float* t) {
  constexpr std::make_index_sequence<kPackets> packets;
  for (std::size_t i = 0; i < n; i += kPackets * kWidth)
    add_closest(scene, rays, i, n, nothing_hit<ClosestHits<kPackets>>(rays, i, n, packets), triangle, t);
}

void add_closest_fronts(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                        const MaterialMarks& backs, std::uint32_t* triangle, float* t) {
  constexpr std::make_index_sequence<kPackets> packets;
  for (std::size_t i = 0; i < n; i += kPackets * kWidth)
    add_closest(scene, rays, i, n,
                nothing_hit<ClosestFronts<kPackets>>(rays, i, n, packets, scene, rays, i, backs), triangle,
                t);
}

void add_occluded(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint8_t* blocked) {
  constexpr std::make_index_sequence<kPackets> packets;
  for (std::size_t i = 0; i < n; i += kPackets * kWidth) {
    auto found = nothing_hit<AnyHits<kPackets>>(rays, i, n, packets);
    for (std::size_t ray = i; ray < std::min(i + kPackets * kWidth, n); ++ray)
      if (blocked[ray] != 0) found.hit[(ray - i) / kWidth] |= 1u << (ray - i) % kWidth;
    for (int k = 0; k < kPackets; ++k)
      found.t_best[k] = select(Mask::from_bits(found.hit[k]), Float(-1.0f), found.t_best[k]);
    add_moving_hits<FilteredTest>(scene, rays, i, n, packets, found);
    store_blocked(found, i, n, blocked);
  }
}

template <class Test>
constexpr Kernel kKernelOf{closest_hits<Test>, closest_fronts<Test>, occluded<Test>,
                           occluded_unless_passed<Test>};

}  // namespace

const MovingKernel kMovingKernel{add_closest_hits, add_closest_fronts, add_occluded};

// In the order of TriangleTest.
const Kernels kKernels{kKernelOf<ProjectedTest>, kKernelOf<MoellerTrumboreTest>, kKernelOf<WatertightTest>,
                       kKernelOf<FilteredTest>};

}  // namespace pinocchio::PINOCCHIO_LANES
