// The entry points of each instruction set's kernel: trace/kernel.h compiled once a file, with that
// file's own flags.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/bsp/tree.h"
#include "core/math/ray.h"

namespace pinocchio {

struct Kernel {
  void (*closest_hits)(const BspTree& tree, const Ray* rays, Hit* hits, std::size_t n);
  void (*occluded)(const BspTree& tree, const Ray* rays, std::uint8_t* blocked, std::size_t n);
};

namespace scalar {
extern const Kernel kKernel;
}
namespace sse4 {
extern const Kernel kKernel;
}
namespace avx2 {
extern const Kernel kKernel;
}
namespace avx512 {
extern const Kernel kKernel;
}

}  // namespace pinocchio
