// A camera path's JSON.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "app/animation.h"
#include "app/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("pinocchio-fuzz-" + std::to_string(getpid()) + ".path");
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  pinocchio::app::AnimationOptions options;
  options.path = file.string();
  options.frames = "0-20x5";
  try {
    (void)pinocchio::app::animate(options, {});
  } catch (const pinocchio::app::Exit&) {  // one clear line
  }
  std::filesystem::remove(file);
  return 0;
}
