// A scene file of the format that the target is built for. Of MTL the bytes are the material file of an OBJ.
#include "pinocchio/animation.h"
#include "pinocchio/load.h"
#include "tests/fuzz/input.h"

namespace {

constexpr std::string_view kFormat = PINOCCHIO_FUZZ_FORMAT;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::filesystem::path scene = pinocchio::fuzz::written(std::string(kFormat), data, size);
  if (kFormat == "mtl") {
    scene = pinocchio::fuzz::folder() / "fuzz.obj";
    std::ofstream(scene) << "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  }
  pinocchio::Warnings warnings;
  pinocchio::LoadOptions options;
  options.limit_bytes = pinocchio::fuzz::kMemory_bytes;
  options.point_size = options.line_width = 0.01f;
  const auto loaded = pinocchio::load_scene(scene, options, &warnings);
  for (const pinocchio::Warning& warning : warnings)
    if (warning.message().find('\n') != std::string::npos) std::abort();
  if (!loaded && loaded.error().what.empty()) std::abort();
  if (loaded && !loaded->variants.empty()) {
    options.variant = loaded->variants.front();
    (void)pinocchio::load_scene(scene, options);
  }
  if (loaded && loaded->animation) (void)pinocchio::at_time(*loaded, 0.5);
  return 0;
}
