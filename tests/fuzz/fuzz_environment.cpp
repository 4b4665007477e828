// An environment: EXR or Radiance.
#include "pinocchio/environment.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto sky = pinocchio::load_environment(pinocchio::fuzz::written("sky", data, size), nullptr,
                                               pinocchio::fuzz::kMemory_bytes);
  if (sky) (void)(*sky)->is_black();
  return 0;
}
