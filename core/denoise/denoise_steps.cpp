#include "core/denoise/denoise_steps.h"

#include <cassert>

namespace pinocchio {

#define PINOCCHIO_DECLARE(name, lanes, feature) \
  namespace name {                              \
  extern const DenoiseSteps kDenoiseSteps;      \
  }
PINOCCHIO_ISAS(PINOCCHIO_DECLARE)
#undef PINOCCHIO_DECLARE

const DenoiseSteps& denoise_steps(Isa isa) {
  const DenoiseSteps* steps = &scalar::kDenoiseSteps;
#define PINOCCHIO_CHOOSE(name, lanes, feature) \
  if (isa == Isa::name) steps = &name::kDenoiseSteps;
  PINOCCHIO_ISAS(PINOCCHIO_CHOOSE)
#undef PINOCCHIO_CHOOSE
  return *steps;
}

}  // namespace pinocchio
