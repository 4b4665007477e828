#pragma once

// The instruction sets that lanes are compiled for, in the order of Isa (pinocchio/tracer.h):
//   ROW(name, lanes, feature)
// name: as in kIsaNames; the lanes are lanes_NAME.h beside this file, in the namespace `name`. feature: what
// the processor must have, as compiler and processor call it. core/CMakeLists.txt reads these rows: it
// compiles kernel.cpp.in of core/trace once for each, with -mFEATURE.
#define PINOCCHIO_ISAS(ROW) \
  ROW(scalar, 1, "sse2")    \
  ROW(sse4, 4, "sse4.1")    \
  ROW(avx2, 8, "avx2")      \
  ROW(avx512, 16, "avx512f")

namespace pinocchio {

#define PINOCCHIO_LANE_COUNT(name, lanes, feature) \
  namespace name {                                 \
  inline constexpr int kWidth = lanes;             \
  }
PINOCCHIO_ISAS(PINOCCHIO_LANE_COUNT)
#undef PINOCCHIO_LANE_COUNT

#define PINOCCHIO_LANE_COUNT(name, lanes, feature) lanes,
inline constexpr unsigned kLaneCounts[]{PINOCCHIO_ISAS(PINOCCHIO_LANE_COUNT)};
#undef PINOCCHIO_LANE_COUNT

}  // namespace pinocchio
