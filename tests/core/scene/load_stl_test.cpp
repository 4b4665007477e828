#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

Expected<Scene> load_bytes(const std::string& bytes, Warnings* warnings = nullptr,
                           const LoadOptions& options = {}) {
  const std::filesystem::path path = own_file("test.stl");
  std::ofstream(path, std::ios::binary) << bytes;
  return load_scene(path, options, warnings);
}

std::string why_refused(const std::string& bytes) {
  const Expected<Scene> scene = load_bytes(bytes);
  EXPECT_FALSE(scene);
  return scene ? "" : scene.error().message();
}

const std::string kFacet =
    "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 2.5e0 -3\n endloop\n"
    "endfacet\n";

void append(std::string& to, const void* value, std::size_t bytes) {
  to.append(static_cast<const char*>(value), bytes);
}

// `said`: the number of triangles in the header.
std::string binary(const std::vector<glm::mat3>& triangles, std::uint32_t said, const std::string& begin = "",
                   std::uint16_t attribute = 0) {
  std::string bytes = begin;
  bytes.resize(80, ' ');
  append(bytes, &said, 4);
  for (const glm::mat3& corners : triangles) {
    const glm::vec3 normal(0, 0, 1);
    append(bytes, &normal, 12);
    append(bytes, &corners, 36);
    append(bytes, &attribute, 2);
  }
  return bytes;
}

const glm::mat3 kCorners{{0, 0, 0}, {1, 0, 0}, {0, 2.5f, -3}};

std::string on_one_line(std::string text, char separator) {
  std::ranges::replace(text, '\n', separator);
  return text;
}

TEST(LoadStl, BothKindsHoldTheSameTriangles) {
  for (const std::string& bytes :
       {"solid part\n" + kFacet + kFacet + "endsolid part\n", "SOLID\r\n" + kFacet + kFacet,
        "\xef\xbb\xbfsolid vertex\n" + kFacet + kFacet, "\n\n  solid part\n" + kFacet + kFacet,
        on_one_line("solid part " + kFacet + kFacet, ' '),
        on_one_line("solid part\n" + kFacet + kFacet, '\r'), binary({kCorners, kCorners}, 2),
        binary({kCorners, kCorners}, 2, "solid, but binary")}) {
    Warnings warnings;
    const Expected<Scene> scene = load_bytes(bytes, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_TRUE(warnings.empty());
    ASSERT_EQ(scene->mesh->triangles.size(), 2u);
    const glm::uvec3 t = scene->mesh->triangles[1];
    for (int corner = 0; corner < 3; ++corner)
      EXPECT_EQ(scene->mesh->positions[t[corner]], kCorners[corner]) << corner;
    EXPECT_EQ(scene->mesh->normals[t.x], glm::vec3(0.0f));  // flat
  }
}

TEST(LoadStl, ZPointsUpIfTheCallerSaysSo) {
  const Expected<Scene> scene = load_bytes(binary({kCorners}, 1), nullptr, {.up_axis = UpAxis::z});
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->positions[2], glm::vec3(0, -3, -2.5f));
}

TEST(LoadStl, HostileFilesAreRefusedInOneLine) {
  const auto says = [](const std::string& bytes, const std::string& what) {
    const std::string why = why_refused(bytes);
    EXPECT_NE(why.find(what), std::string::npos) << why;
    EXPECT_EQ(why.find('\n'), std::string::npos);
  };
  says("no stl", "is not STL");
  says(std::string(84, '\0'), "holds no triangles");
  says(binary({kCorners}, 0xffffffffu), "states 4294967295 triangles, its 134 bytes hold 1");
  says(binary({kCorners, kCorners}, 3), "states 3 triangles");
  says("solid x\n", "holds no triangles");
  says("solid x\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", ":5: a facet has 2 vertices");
  says("solid x\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nvertex 1 1 1\n", ":5: a facet has more");
  says("solid x\nfacet\nvertex 0 zero 0\n", ":3: a vertex is not three numbers");
  says("solid x\nfacet\nvertex 0 0\n", ":3: a vertex is not three numbers");
  says("solid x\nfacet\nvertex 0 0 0\n", "ends within a facet");
}

TEST(LoadStl, WhatIsLeftOutIsSaid) {
  glm::mat3 broken = kCorners;
  broken[1].y = std::numeric_limits<float>::quiet_NaN();
  for (const auto& [bytes, what] :
       {std::pair(binary({kCorners, broken}, 2), "no finite numbers"),
        std::pair(binary({kCorners}, 1, "", 31), "colours of triangles"),
        std::pair(binary({kCorners}, 1) + "more", "bytes after the last triangle"),
        std::pair("solid x\n" + kFacet + "facet\nvertex 0 0 1e99\nvertex 1 0 0\nvertex 0 1 0\nendfacet",
                  "no finite numbers")}) {
    Warnings warnings;
    const Expected<Scene> scene = load_bytes(bytes, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->triangles.size(), 1u);
    ASSERT_EQ(warnings.size(), 1u) << what;
    EXPECT_NE(warnings[0].what.find(what), std::string::npos) << warnings[0].what;
  }
}

// Any bytes end in a scene or in an error, never elsewhere.
TEST(LoadStl, CutFilesEndInAnError) {
  const std::string whole = binary({kCorners, kCorners}, 2), text = "solid a\n" + kFacet;
  for (std::size_t n = 1; n < whole.size(); ++n) EXPECT_FALSE(load_bytes(whole.substr(0, n))) << n;
  for (std::size_t n = 1; n < text.size() - 1; ++n) (void)load_bytes(text.substr(0, n));
}

}  // namespace
}  // namespace pinocchio
