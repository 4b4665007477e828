#include "core/files/atomic_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "core/image/codecs/png.h"
#include "pinocchio/error.h"
#include "pinocchio/exr.h"
#include "pinocchio/save.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  std::filesystem::path folder_ = own_folder() / "atomic";
};

TEST_F(AtomicFile, ReplacesTheOldFileAsAWhole) {
  write_text(folder_ / "a.txt", "old");
  write_text(folder_ / "a.txt", "new");
  EXPECT_EQ(read("a.txt"), "new");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, AFailureLeavesTheOldFileAndNothingElse) {
  write_text(folder_ / "a.txt", "old");
  const auto fail = [](const std::filesystem::path& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("disk full");
  };
  EXPECT_THROW(write_atomically(folder_ / "a.txt", fail), std::runtime_error);
  EXPECT_EQ(read("a.txt"), "old");
  EXPECT_EQ(files(), 1u);
}

TEST_F(AtomicFile, SaysBeforehandWhatCannotBeWritten) {
  EXPECT_NO_THROW(check_writable(folder_ / "fine.txt"));
  EXPECT_EQ(files(), 0u);
  EXPECT_THROW(check_writable(folder_ / "nowhere" / "x.txt"), EnvironmentError);
  EXPECT_THROW(check_writable(folder_), EnvironmentError);
  EXPECT_THROW(check_writable("/dev/full"), EnvironmentError);
  EXPECT_THROW(check_writable("/proc/x.txt"), EnvironmentError);  // root or not
}

// A limit on a file's size fails a write in its middle, as a full disk does.
TEST_F(AtomicFile, ADiskThatFillsKeepsTheOldFiles) {
  for (const char* name : {"a.exr", "a.png", "a.glb", "a.obj"}) write_text(folder_ / name, "old");
  Scene scene;
  MeshData mesh;
  mesh.positions.assign(3000, glm::vec3(0.5f));
  mesh.normals.assign(3000, glm::vec3(0.0f, 1.0f, 0.0f));
  for (std::uint32_t i = 0; i < 1000; ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  mesh.materials.emplace_back();
  mesh.triangle_materials.assign(1000, 0);
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  ExrFile exr{
      {64, 64}, {{0, 0}, {64, 64}}, {{"Z", ExrChannel::Type::real, std::vector<float>(4096), {}}}, {}, {}};
  for (std::size_t i = 0; i < 4096; ++i) exr.channels[0].values[i] = static_cast<float>(i * i);

  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const rlimit small{2048, usual.rlim_max};
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  EXPECT_THROW(write_exr(folder_ / "a.exr", exr), EnvironmentError);
  Image<glm::u8vec3> noise({64, 64});
  for (std::size_t i = 0; i < 4096; ++i) noise[i] = glm::u8vec3(i * i * i >> 7u, i * i >> 3u, i * 7919 >> 5u);
  EXPECT_THROW(write_png(folder_ / "a.png", noise), EnvironmentError);
  EXPECT_THROW(save_scene(scene, folder_ / "a.glb"), EnvironmentError);
  EXPECT_THROW(save_scene(scene, folder_ / "a.obj"), EnvironmentError);
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, handler);
  for (const char* name : {"a.exr", "a.png", "a.glb", "a.obj"}) EXPECT_EQ(read(name), "old") << name;
  EXPECT_EQ(files(), 4u);
}

TEST_F(AtomicFile, ALinkToItselfIsRefusedAndKept) {
  std::filesystem::create_symlink("a.txt", folder_ / "a.txt");
  EXPECT_THROW(check_writable(folder_ / "a.txt"), EnvironmentError);
  EXPECT_THROW(write_text(folder_ / "a.txt", "text"), EnvironmentError);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "a.txt"));
}

}  // namespace
}  // namespace pinocchio
