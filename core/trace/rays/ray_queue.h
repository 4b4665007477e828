#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/aligned_vector.h"
#include "pinocchio/ray.h"

namespace pinocchio {

// Padding of a column: no packet has more lanes, and a kernel reads and writes whole packets.
inline constexpr std::size_t kQueuePad = 16;

// A ray's medium where it passes through none that absorbs light.
inline constexpr std::uint32_t kNoMedium = 0xffffffffu;

// Rays as columns, one value a ray, each column on a cache line of its own.
struct RayColumns {
  const float* origin[3];
  const float* direction[3];
  const float* t_max;  // null: `reach` for all
  float reach = kInfinity;
};

// The columns that not every queue has.
struct ExtraColumns {
  bool width = false, medium = false, density = false, way = false;
};

// A thread's rays of one kind: filled packet by packet, traced, and read again. Lanes append to it by storing
// whole packets behind the last ray, so it is given its size beforehand (make_room) and never grows
// meanwhile.
struct RayQueue {
  float *origin[3] = {}, *direction[3] = {};
  float* light[3] = {};            // a path's throughput; a shadow ray's light if it is not blocked
  std::uint32_t* pixel = nullptr;  // in the tile
  float* width = nullptr;          // of its cone at the origin; null: textures are not filtered
  float* density = nullptr;        // of the direction, per steradian, where other methods find it too;
                                   // else 0; negative: others find all of the environment's light there
  float* way = nullptr;  // length of the path from the eye to the origin, scene units; null: not wanted
  std::uint32_t* triangle = nullptr;  // hit by the ray
  std::uint32_t* medium =
      nullptr;  // the material that it passes through, or kNoMedium; null: there are no media
  std::size_t size = 0;

  // Empties the queue and makes room for `rays` and a packet.
  void make_room(std::size_t rays, const ExtraColumns& extra = {});

  // Keeps the rays and makes room for `rays` more. Densities and ways are not kept.
  void make_more_room(std::size_t rays, const ExtraColumns& extra = {});

  [[nodiscard]] RayColumns columns(float reach = kInfinity) const {
    return {{origin[0], origin[1], origin[2]}, {direction[0], direction[1], direction[2]}, nullptr, reach};
  }

 private:
  AlignedVector<float> floats_;
  AlignedVector<std::uint32_t> words_;
  AlignedVector<float> widths_, densities_, ways_;
  AlignedVector<std::uint32_t> media_;
  std::size_t room_ = 0;
};

// Copies all but the pixel and columns that not every queue has; of these the medium, where `to` has it.
void copy_ray(const RayQueue& from, std::size_t i, RayQueue& to, std::size_t k);

}  // namespace pinocchio
