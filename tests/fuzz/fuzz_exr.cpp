// An EXR, as compare reads it.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "pinocchio/exr.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("pinocchio-fuzz-" + std::to_string(getpid()) + ".exr");
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  (void)pinocchio::read_exr(file);
  std::filesystem::remove(file);
  return 0;
}
