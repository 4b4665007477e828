// A camera path's JSON.
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "app/camera_path.h"
#include "app/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("pinocchio-fuzz-" + std::to_string(getpid()) + ".path");
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const pinocchio::app::CameraPath path = pinocchio::app::read_camera_path(file.string(), {});
    for (const int number : {0, 1, 1000, 2'000'000'000}) (void)pinocchio::app::camera_on_path(path, number);
  } catch (const pinocchio::app::Exit&) {  // one clear line
  }
  std::filesystem::remove(file);
  return 0;
}
