// The entry points of each instruction set's kernels, one for each triangle test.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/bsp/scene_trees.h"
#include "core/simd/isas.h"
#include "core/trace/rays/material_marks.h"
#include "core/trace/rays/passed_surfaces.h"
#include "core/trace/rays/ray_queue.h"
#include "pinocchio/tracer.h"

namespace pinocchio {

// Kernels for n rays. All columns, the results' included, are read and written in whole packets: they are
// aligned and have room for kQueuePad more rays (rays/ray_queue.h).
struct Kernel {
  // Writes the triangle that each ray hits (kNoTriangle: none) and, unless `t` is null, its distance (t_max:
  // none).
  void (*closest_hits)(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                       std::uint32_t* triangle, float* t);
  // As closest_hits, but rays pass through the backs of the materials in `backs`.
  void (*closest_fronts)(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                         const MaterialMarks& backs, std::uint32_t* triangle, float* t);
  // Writes 1 for a ray that meets any triangle, else 0.
  void (*occluded)(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint8_t* blocked);
  // Writes 1 if a triangle stops the ray, else kMayPass if it meets one that lets a share of light through,
  // else 0.
  void (*occluded_unless_passed)(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                                 const PassedSurfaces& passed, std::uint8_t* blocked);
};

// Kernels that add what rays hit in the scene's moving trees to what others have found in scene.still.
// Results are as theirs, `t` never null. For TriangleTest::filtered.
struct MovingKernel {
  void (*add_closest_hits)(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                           std::uint32_t* triangle, float* t);
  void (*add_closest_fronts)(const SceneTrees& scene, const RayColumns& rays, std::size_t n,
                             const MaterialMarks& backs, std::uint32_t* triangle, float* t);
  void (*add_occluded)(const SceneTrees& scene, const RayColumns& rays, std::size_t n, std::uint8_t* blocked);
};

using Kernels = std::array<Kernel, kTriangleTests.size()>;  // by TriangleTest

struct LaneSteps;  // trace/lanes/lane_steps.h
struct WideTree;   // bsp/wide/wide_tree.h

// Kernels for n rays through the wide tree over the triangles of scene.still, one ray at a time. Hits have
// the bits of `Kernel` for TriangleTest::filtered. Columns are read and written ray by ray. Null where an
// instruction set has more lanes than a node has children.
struct WideKernel {
  void (*closest_hits)(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                       std::uint32_t* triangle, float* t) = nullptr;
  void (*closest_fronts)(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                         const MaterialMarks& backs, std::uint32_t* triangle, float* t) = nullptr;
  void (*occluded)(const SceneTrees& scene, const WideTree& tree, const RayColumns& rays, std::size_t n,
                   std::uint8_t* blocked) = nullptr;
};

[[nodiscard]] const MovingKernel& moving_kernel(Isa isa);
// The kernel of the widest instruction set that has one, at most `isa`.
[[nodiscard]] const WideKernel& wide_kernel(Isa isa);

#define PINOCCHIO_DECLARE(name, lanes, feature) \
  namespace name {                              \
  extern const Kernels kKernels;                \
  extern const MovingKernel kMovingKernel;      \
  extern const WideKernel kWideKernel;          \
  extern const LaneSteps kSteps;                \
  }
PINOCCHIO_ISAS(PINOCCHIO_DECLARE)
#undef PINOCCHIO_DECLARE

}  // namespace pinocchio
