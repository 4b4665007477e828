#pragma once

// The instruction sets that lanes are compiled for, narrowest first, a file for each architecture:
//   ROW(name, lanes, feature)
// name: an enumerator of Isa (pinocchio/tracer.h); the lanes are lanes_NAME.h beside this file, in the
// namespace `name`. feature: what the processor must have, as compiler and processor call it; empty: nothing
// more than the architecture. core/CMakeLists.txt reads the rows of CMAKE_SYSTEM_PROCESSOR: it compiles
// kernel.cpp.in of core/trace once for each, with -mFEATURE.
#if defined(__x86_64__)
#include "core/simd/isas_x86_64.h"
#elif defined(__aarch64__)
#include "core/simd/isas_aarch64.h"
#else
#error "core/simd has lanes for x86-64 and 64-bit Arm alone"
#endif

namespace pinocchio {

#define PINOCCHIO_LANE_COUNT(name, lanes, feature) \
  namespace name {                                 \
  inline constexpr int kWidth = lanes;             \
  }
PINOCCHIO_ISAS(PINOCCHIO_LANE_COUNT)
#undef PINOCCHIO_LANE_COUNT

}  // namespace pinocchio
