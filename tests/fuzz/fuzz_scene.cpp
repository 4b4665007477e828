// A scene file of the format that the target is built for. Of MTL the bytes are the material file of an OBJ.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "pinocchio/animation.h"
#include "pinocchio/load.h"

namespace {

constexpr std::string_view kFormat = PINOCCHIO_FUZZ_FORMAT;

const std::filesystem::path& folder() {
  static const std::filesystem::path path = [] {
    std::filesystem::path made = std::filesystem::temp_directory_path() / ("pinocchio-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directories(made);
    std::atexit([] { std::filesystem::remove_all(folder()); });
    return made;
  }();
  return path;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::filesystem::path file = folder() / ("fuzz." + std::string(kFormat));
  std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  std::filesystem::path scene = file;
  if (kFormat == "mtl") {
    scene = folder() / "fuzz.obj";
    std::ofstream(scene) << "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  }
  pinocchio::Warnings warnings;
  constexpr std::uint64_t kLimit = std::uint64_t{64} << 20;
  const auto loaded = pinocchio::load_scene(scene, &warnings, nullptr, kLimit);
  for (const pinocchio::Warning& warning : warnings)
    if (warning.message().find('\n') != std::string::npos) std::abort();
  if (!loaded && loaded.error().what.empty()) std::abort();
  if (loaded && loaded->animation) (void)pinocchio::at_time(*loaded, 0.5);
  return 0;
}
