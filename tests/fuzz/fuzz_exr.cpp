// An EXR, as compare reads it.
#include "core/image/codecs/exr_open.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)pinocchio::read_exr(pinocchio::fuzz::written("exr", data, size), pinocchio::fuzz::kMemory_bytes);
  return 0;
}
