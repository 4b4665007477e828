// Files and messages of a program that has set a locale with a decimal comma.
#include <clocale>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <locale>

#include "core/base/decimal.h"
#include "pinocchio/animation.h"
#include "pinocchio/save.h"
#include "tests/support/moving_gltf.h"

namespace pinocchio {
namespace {

class GermanLocale : public testing::Test {
 protected:
  void SetUp() override {
    const std::string folder = own_folder().string(), name = folder + "/de_DE.UTF-8";
    const std::string command = "localedef -i de_DE -f UTF-8 '" + name + "' 2>&1 >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << "install the package locales";
    setenv("LOCPATH", folder.c_str(), 1);
    std::locale::global(std::locale("de_DE.UTF-8"));  // streams'; and C's, as setlocale does
    ASSERT_EQ(std::string(std::localeconv()->decimal_point), ",");
  }
  void TearDown() override { std::locale::global(std::locale::classic()); }
};

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Scene odd_triangle() {
  MeshData mesh;
  add_triangle(mesh, {0.5f, 0.1f, 1e-20f}, {1.25f, -0.75f, 12345.678f}, {0, 1, 0.3333333f});
  mesh.materials[0].diffuse = {0.25f, 0.5f, 0.125f};
  mesh.materials[0].shininess = 12.5f;
  return Scene(std::move(mesh));
}

TEST_F(GermanLocale, SavedScenesComeBack) {
  const Scene saved = odd_triangle();
  for (const char* name : {"odd.obj", "odd.gltf", "odd.glb"}) {
    save_scene(saved, own_file(name));
    const Scene loaded = load_or_die(own_file(name));
    ASSERT_EQ(loaded.mesh->triangles.size(), 1u) << name;
    for (int c = 0; c < 3; ++c)
      EXPECT_EQ(loaded.mesh->positions[loaded.mesh->triangles[0][c]],
                saved.mesh->positions[saved.mesh->triangles[0][c]])
          << name;
    EXPECT_EQ(loaded.mesh->material_of(0).diffuse, saved.mesh->materials[0].diffuse) << name;
    EXPECT_EQ(loaded.mesh->material_of(0).shininess, 12.5f) << name;
  }
  for (const char* name : {"odd.obj", "odd.mtl"})
    EXPECT_EQ(text_of(own_file(name)).find(','), std::string::npos) << text_of(own_file(name));
}

// A float's digits and exponents beyond a double's, which take a path of their own.
TEST_F(GermanLocale, NumbersOfTextFilesAreRead) {
  const std::string zeros(400, '0');
  std::ofstream(own_file("far.obj")) << "v 1.5e-400 0." << zeros << "1 0\nv 1.25 0 0\nv 0 1.25 0\nf 1 2 3\n";
  EXPECT_EQ(load_or_die(own_file("far.obj")).mesh->positions[0], glm::vec3(0.0f));
  for (const std::string& number :
       std::vector<std::string>{"1.5e400", "-1.5e400", "1" + zeros + ".5", "0.0001e400"}) {
    std::ofstream(own_file("huge.obj")) << "v " << number << " 0 0\nv 1.25 0 0\nv 0 1.25 0\nf 1 2 3\n";
    Warnings warnings;
    EXPECT_FALSE(load_scene(own_file("huge.obj"), &warnings) && warnings.empty()) << number;
    std::ofstream(own_file("huge.ply"))
        << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        << "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
        << number << " 0 0\n1.25 0 0\n0 1.25 0\n3 0 1 2\n";
    EXPECT_FALSE(load_scene(own_file("huge.ply"), &warnings) && warnings.empty()) << number;
  }
}

TEST_F(GermanLocale, MessagesHaveAPoint) {
  const Expected<Scene> never = at_time(Scene{}, std::numeric_limits<double>::infinity());
  ASSERT_FALSE(never);
  EXPECT_EQ(decimal(0.5), "0.5");
  EXPECT_EQ(decimal(1.0 / 3.0, 4), "0.3333");
}

TEST(Decimal, NumbersBeyondTheTypeAreZeroOrInfinite) {
  const auto read = [](std::string_view text) {
    double value = 7.0;
    const auto [end, failure] = read_decimal(text, value);
    EXPECT_EQ(failure, std::errc()) << text;
    EXPECT_EQ(end, text.data() + text.size()) << text;
    return value;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  const std::string zeros(400, '0');
  EXPECT_EQ(read("1e400"), infinite);
  EXPECT_EQ(read("-1e+400"), -infinite);
  EXPECT_EQ(read("1e-400"), 0.0);
  EXPECT_EQ(read("0.0001e400"), infinite);
  EXPECT_EQ(read("1000e-400"), 0.0);
  EXPECT_EQ(read("1" + zeros), infinite);
  EXPECT_EQ(read("0." + zeros + "1"), 0.0);
  EXPECT_EQ(read("1e99999999999999999999"), infinite);
  EXPECT_EQ(read("1e-99999999999999999999"), 0.0);
  EXPECT_EQ(read("0." + zeros + "1e401"), 1.0);
  double value = 7.0;
  EXPECT_EQ(read_decimal("x", value).ec, std::errc::invalid_argument);
}

}  // namespace
}  // namespace pinocchio
