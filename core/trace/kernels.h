// The entry points of each instruction set's kernels, one a triangle test: trace/kernel.h compiled once a
// file, with that file's own flags.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/bsp/tree.h"
#include "pinocchio/ray.h"

namespace pinocchio {

struct Kernel {
  void (*closest_hits)(const BspTree& tree, const Ray* rays, Hit* hits, std::size_t n);
  void (*occluded)(const BspTree& tree, const Ray* rays, std::uint8_t* blocked, std::size_t n);
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
