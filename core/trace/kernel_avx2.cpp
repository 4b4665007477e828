// Compiled with -mavx2 (core/CMakeLists.txt); reached only where the processor has it.
#include "core/simd/lanes_avx2.h"

#define PINOCCHIO_LANES avx2
#include "core/trace/kernel.h"
#include "core/trace/lanes/steps.h"
