// Part of walk/kernel.h: where the triangles that a leaf refers to come from. Such a class has
//   at(reference, kept)      the triangle; `kept` may hold it
//   is_void(triangle)        whether it has no area, so that no ray meets it
//   fetch_ahead(references, count) that they are needed soon
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/base/prefetch.h"
#include "core/bsp/scene_trees.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// Triangles that are stored in a test's format. Those without an area are not among them.
template <class Stored>
class StoredIn {
 public:
  struct Kept {};

  explicit StoredIn(const Stored* triangles) : triangles_(triangles) {}

  [[gnu::always_inline]] inline const Stored& at(std::uint32_t reference, Kept&) const {
    return triangles_[reference];
  }
  static constexpr bool is_void(const Stored&) { return false; }
  // They are anywhere in memory: all are prefetched at once, not one after the other.
  [[gnu::always_inline]] inline void fetch_ahead(const std::uint32_t* of_leaf, std::uint32_t count) const {
    for (std::uint32_t r = 0; r < count; ++r) {
      const char* const at = reinterpret_cast<const char*>(triangles_ + of_leaf[r]);
      prefetch(at);
      prefetch(at + sizeof(Stored) - 1);
    }
  }

 private:
  const Stored* triangles_;
};

// Triangles that are stored as posed. Some may have no area.
template <class Stored>
class PosedIn : public StoredIn<Stored> {
 public:
  explicit PosedIn(const Stored* triangles) : StoredIn<Stored>(triangles) {}

  static bool is_void(const Stored& triangle) {
    if constexpr (std::is_same_v<Stored, ProjectedTriangle>) return triangle.n_u != triangle.n_u;
    return false;  // corners that are NaN fail the tests that read them
  }
};

// Triangles of a copy, which are made of the scene's corners when they are tested.
class MadeWhenTested {
 public:
  using Kept = ProjectedTriangle;

  MadeWhenTested(const SceneTrees& scene, std::uint32_t first)
      : positions_(scene.positions.data()), corners_(scene.corners.data() + first), first_(first) {}

  const ProjectedTriangle& at(std::uint32_t reference, Kept& kept) const {
    const glm::uvec3& c = corners_[reference];
    return kept =
               ProjectedTriangle::from(positions_[c.x], positions_[c.y], positions_[c.z], first_ + reference);
  }
  static bool is_void(const ProjectedTriangle& triangle) { return triangle.n_u != triangle.n_u; }
  void fetch_ahead(const std::uint32_t* of_leaf, std::uint32_t count) const {
    for (std::uint32_t r = 0; r < count; ++r) prefetch(corners_ + of_leaf[r]);
  }

 private:
  const glm::vec3* positions_;
  const glm::uvec3* corners_;
  std::uint32_t first_;
};

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
