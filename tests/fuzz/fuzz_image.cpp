// A texture's bytes.
#include <cstdint>

#include "core/scene/texture_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pinocchio::MemoryLimit limit(std::uint64_t{64} << 20);
  (void)pinocchio::decode_texture("fuzz", "fuzz", {data, size}, limit);
  return 0;
}
