// Scenes of strangers: what their names may open.
#include <fcntl.h>
#include <sys/stat.h>

#include <fstream>

#include "core/files/input_files.h"
#include "pinocchio/load.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

// A folder with the scene's, and files and links in and around it.
class Confine : public testing::Test {
 protected:
  void SetUp() override {
    write(inside("own.txt"), "own");
    write(inside("sub/deep.txt"), "own");
    write(root() / "secret.txt", "secret");
    write(root() / "other/secret.txt", "secret");
    write(root() / "inside but not/secret.txt", "secret");  // its name begins as the folder's
    fs::create_symlink(root() / "secret.txt", inside("link.txt"));
    fs::create_symlink("../secret.txt", inside("up.txt"));
    fs::create_symlink(root() / "other", inside("elsewhere"));
    fs::create_symlink("sub/deep.txt", inside("near.txt"));
    fs::create_symlink(inside("sub"), inside("same"));
    fs::create_symlink("gone.txt", inside("dangling.txt"));
    fs::create_symlink(root() / "inside", root() / "by link");
  }
  static fs::path root() { return own_folder(); }
  static fs::path inside(const std::string& name) { return root() / "inside" / name; }

  static LoadOptions confined() {
    LoadOptions options;
    options.confine = true;
    return options;
  }
  static std::string error_of(const fs::path& scene) {
    EXPECT_TRUE(load_scene(scene)) << scene;  // whoever trusts it sees it
    const Expected<Scene> loaded = load_scene(scene, confined());
    EXPECT_FALSE(loaded) << scene;
    return loaded ? "" : loaded.error().message();
  }
  static void expect_outside(const std::string& error, const std::string& file) {
    EXPECT_NE(error.find(file), std::string::npos) << error;
    EXPECT_NE(error.find("lies outside the scene's folder"), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
};

TEST_F(Confine, NamesAndLinksThatLeadOutAreRefused) {
  for (const bool kernel_resolves : {true, false})
    for (const char* folder : {"inside", "by link"}) {
      InputFiles files(root() / folder / "scene.gltf", true, kernel_resolves);
      for (const std::string& name :
           {std::string("own.txt"), std::string("sub/deep.txt"), std::string("sub/../own.txt"),
            std::string("../inside/own.txt"), std::string("near.txt"), std::string("same/deep.txt"),
            std::string("sub\\deep.txt"), inside("own.txt").string()}) {
        const Expected<FileBytes> read = files.read(files.named(name), nullptr);
        ASSERT_TRUE(read) << name << ": " << read.error().message();
        EXPECT_EQ(read->text(), "own") << name;
      }
      EXPECT_FALSE(files.read(files.named("missing.txt"), nullptr));
      EXPECT_FALSE(files.read(files.named("dangling.txt"), nullptr));
      EXPECT_FALSE(files.read(files.named("sub"), nullptr));
      EXPECT_FALSE(files.error());
      for (const std::string& name :
           {std::string("../secret.txt"), std::string("sub/../../secret.txt"), std::string("..\\secret.txt"),
            (root() / "secret.txt").string(), std::string("/etc/passwd"), std::string("link.txt"),
            std::string("up.txt"), std::string("elsewhere/secret.txt"),
            std::string("../inside but not/secret.txt"), std::string("../nowhere.txt"),
            std::string("elsewhere/nowhere.txt"), std::string("/proc/self/root/etc/passwd"),
            std::string("/proc/self/environ"), std::string("..")}) {
        InputFiles once(root() / folder / "scene.gltf", true, kernel_resolves);
        EXPECT_FALSE(once.read(once.named(name), nullptr)) << name;
        ASSERT_TRUE(once.error()) << name;
        expect_outside(once.error()->message(), "");
      }
    }
}

TEST_F(Confine, ASceneInTheCurrentFolder) {
  const fs::path before = fs::current_path();
  fs::current_path(root() / "inside");
  InputFiles files("scene.gltf", true);
  EXPECT_TRUE(files.read(files.named("sub/deep.txt"), nullptr));
  EXPECT_FALSE(files.read(files.named("../secret.txt"), nullptr));
  fs::current_path(before);
}

TEST_F(Confine, APipeDoesNotMakeUsWait) {
  ASSERT_EQ(mkfifo(inside("pipe").c_str(), 0600), 0);
  InputFiles files(inside("scene.gltf"), true);
  EXPECT_FALSE(files.read(files.named("pipe"), nullptr));
}

TEST_F(Confine, BuffersOfAGltf) {
  Json json = triangle_json();
  fs::rename(own_file("test.bin"), root() / "test.bin");
  fs::create_symlink(root() / "test.bin", inside("linked.bin"));
  fs::create_symlink(root(), inside("all"));
  for (const char* uri : {"../test.bin", "%2e%2e/test.bin", "%2E%2e%2Ftest.bin", "..%5Ctest.bin",
                          "./../test.bin", "elsewhere/../test.bin", "linked.bin", "all/test.bin"}) {
    json["buffers"][0]["uri"] = uri;
    write(inside("scene.gltf"), json.dump());
    expect_outside(error_of(inside("scene.gltf")), "inside");
  }
  json["buffers"][0]["uri"] = (root() / "test.bin").string();
  write(inside("scene.gltf"), json.dump());
  expect_outside(error_of(inside("scene.gltf")), (root() / "test.bin").string());
  fs::copy_file(root() / "test.bin", inside("sub/test.bin"));
  json["buffers"][0]["uri"] = "sub/test.bin";
  write(inside("scene.gltf"), json.dump());
  EXPECT_TRUE(load_scene(inside("scene.gltf"), confined()));
  // The scene itself is its person's choice; what it names is looked for beside the name that was given.
  fs::create_symlink(inside("scene.gltf"), root() / "chosen.gltf");
  fs::create_symlink(inside("sub"), root() / "sub");
  EXPECT_TRUE(load_scene(root() / "chosen.gltf", confined()));
}

TEST_F(Confine, ImagesMaterialsAndTextures) {
  Json json = textured_json({{"uri", "../picture.ppm"}});
  fs::rename(own_file("test.bin"), inside("test.bin"));
  write(root() / "picture.ppm", "P6 1 1 255\nabc");
  write(inside("image.gltf"), json.dump());
  expect_outside(error_of(inside("image.gltf")), "picture.ppm");

  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n";
  write(root() / "m.mtl", "newmtl m\nKd 1 0 0\n");
  write(inside("library.obj"), "mtllib ../m.mtl\n" + triangle);
  expect_outside(error_of(inside("library.obj")), "m.mtl");
  write(inside("own.mtl"), "newmtl m\nKd 1 0 0\nmap_Kd ../picture.ppm\n");
  write(inside("texture.obj"), "mtllib own.mtl\n" + triangle);
  expect_outside(error_of(inside("texture.obj")), "picture.ppm");
  write(inside("texture.ply"),
        "ply\nformat ascii 1.0\ncomment TextureFile ../picture.ppm\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nproperty float u\nproperty float v\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n");
  expect_outside(error_of(inside("texture.ply")), "picture.ppm");
}

}  // namespace
}  // namespace pinocchio
