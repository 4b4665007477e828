// A plan's JSON.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "hybrid/settings/json.h"
#include "pinocchio/tracer.h"

// Without the tracer, whose kernels are not built here.
bool pinocchio::isa_supported(pinocchio::Isa) { return true; }
pinocchio::Isa pinocchio::default_isa() { return pinocchio::Isa::scalar; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("pinocchio-fuzz-" + std::to_string(getpid()) + ".json");
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  (void)pinocchio::load_settings(file);
  std::filesystem::remove(file);
  return 0;
}
