#include "core/simd/lanes_scalar.h"

#define PINOCCHIO_LANES scalar
#include "core/trace/kernel.h"
#include "core/trace/lanes/steps.h"
