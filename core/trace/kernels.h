// The entry points of each instruction set's kernels, one a triangle test: trace/kernel.h compiled once a
// file, with that file's own flags.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/bsp/tree.h"
#include "core/trace/ray_queue.h"

namespace pinocchio {

// Of n rays. All columns, those of the answers as well, are read and written by whole packets: they are
// aligned, and have room for kQueuePad more (trace/ray_queue.h).
struct Kernel {
  // The triangle that each ray hits, kNoTriangle: none; and, unless `t` is null, where (else t_max).
  void (*closest_hits)(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint32_t* triangle,
                       float* t);
  // 1 where anything lies within the ray, else 0.
  void (*occluded)(const BspTree& tree, const RayColumns& rays, std::size_t n, std::uint8_t* blocked);
};

using Kernels = std::array<Kernel, kTriangleTests.size()>;  // by TriangleTest

namespace scalar {
extern const Kernels kKernels;
}
namespace sse4 {
extern const Kernels kKernels;
}
namespace avx2 {
extern const Kernels kKernels;
}
namespace avx512 {
extern const Kernels kKernels;
}

}  // namespace pinocchio
