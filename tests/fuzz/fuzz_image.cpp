// A texture's bytes.
#include "core/image/codecs/formats.h"
#include "tests/fuzz/input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pinocchio::MemoryLimit limit(pinocchio::fuzz::kMemory_bytes);
  (void)pinocchio::decode_texture({"fuzz", "fuzz", {data, size}, limit});
  return 0;
}
