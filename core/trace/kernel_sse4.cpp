// Compiled with -msse4.1 (core/CMakeLists.txt); reached only where the processor has it.
#include "core/simd/lanes_sse4.h"

#define PINOCCHIO_LANES sse4
#include "core/trace/kernel.h"
#include "core/trace/lanes/steps.h"
