#pragma once

// The instruction sets of 64-bit Arm (simd/isas.h). Every such processor has NEON, which needs no flag.
#define PINOCCHIO_ISAS(ROW) \
  ROW(scalar, 1, "")        \
  ROW(neon, 4, "")

#define PINOCCHIO_PROCESSOR_HAS(feature) true
