// What the fuzzers begin with and what they found (tests/fuzz), through the same readers, with any compiler.
#include <fstream>

#include "core/image/codecs/texture_file.h"
#include "pinocchio/environment.h"
#include "pinocchio/exr.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

void read(const std::filesystem::path& file, const std::string& format) {
  constexpr std::uint64_t kLimit = std::uint64_t{64} << 20;
  if (format == "exr") return (void)read_exr(file);
  if (format == "environment") return (void)load_environment(file, nullptr, kLimit);
  if (format == "image") {
    Warnings warnings;
    MemoryLimit limit(kLimit);
    InputFiles files(file, false);
    const LoadOptions usual;
    Loading loading{warnings, nullptr, limit, files, usual};
    return (void)load_texture(file, loading);
  }
  const bool is_mtl = format == "mtl";
  const std::filesystem::path scene = own_file("corpus." + (is_mtl ? std::string("obj") : format));
  if (is_mtl) {
    std::filesystem::copy_file(file, own_file("corpus.mtl"),
                               std::filesystem::copy_options::overwrite_existing);
    std::ofstream(scene) << "mtllib corpus.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  } else {
    std::filesystem::copy_file(file, scene, std::filesystem::copy_options::overwrite_existing);
  }
  const Expected<Scene> loaded = load_scene(scene, nullptr, nullptr, kLimit);
  EXPECT_TRUE(loaded || !loaded.error().what.empty()) << file;
  const LoadOptions all{.limit_bytes = kLimit, .point_size = 0.1f, .line_width = 0.1f};
  const Expected<Scene> with_strokes = load_scene(scene, all);
  EXPECT_TRUE(with_strokes || !with_strokes.error().what.empty()) << file;
}

TEST(LoadCorpus, IsReadOrRefused) {
  int files = 0;
  for (const char* folder : {"tests/fuzz/corpus", "tests/fuzz/found"})
    for (const char* format : {"gltf", "glb", "obj", "mtl", "ply", "image", "exr", "environment"}) {
      std::error_code none;  // nothing may have been found of a format
      for (const auto& entry : std::filesystem::directory_iterator(source_path(folder) / format, none)) {
        read(entry.path(), format);
        ++files;
      }
    }
  EXPECT_GE(files, 15);
}

}  // namespace
}  // namespace pinocchio
