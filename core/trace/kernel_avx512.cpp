// Compiled with -mavx512f (core/CMakeLists.txt); reached only where the processor has it.
#include "core/simd/lanes_avx512.h"

#define PINOCCHIO_LANES avx512
#include "core/trace/kernel.h"
#include "core/trace/lanes/steps.h"
