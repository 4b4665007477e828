#pragma once

// The instruction sets of x86-64 (simd/isas.h).
#define PINOCCHIO_ISAS(ROW) \
  ROW(scalar, 1, "sse2")    \
  ROW(sse4, 4, "sse4.1")    \
  ROW(avx2, 8, "avx2")      \
  ROW(avx512, 16, "avx512f")

#define PINOCCHIO_PROCESSOR_HAS(feature) (__builtin_cpu_supports(feature) != 0)
