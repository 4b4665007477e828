#include "core/scene/formats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "pinocchio/error.h"
#include "pinocchio/save.h"
#include "tests/support/gltf.h"
#include "tests/support/source_path.h"

namespace pinocchio {
namespace {

template <class Do>
void for_each_extension(const Do& visit) {
  for (const SceneFormat& format : scene_formats())
    for (const std::string_view extension : format.extensions)
      if (!extension.empty()) visit(format, std::string(extension));
}

TEST(SceneFormats, ExtensionsBelongToOneFormatEach) {
  std::set<std::string> known;
  for_each_extension([&](const SceneFormat& format, const std::string& extension) {
    EXPECT_TRUE(known.insert(extension).second) << extension;
    EXPECT_EQ(find_scene_format("a" + extension), &format) << extension;
    std::string upper = extension;
    std::ranges::transform(upper, upper.begin(), [](unsigned char c) { return std::toupper(c); });
    EXPECT_EQ(find_scene_format("a" + upper), &format) << upper;
  });
  EXPECT_EQ(find_scene_format("a"), nullptr);
  EXPECT_EQ(find_scene_format("a.xyz"), nullptr);
}

TEST(SceneFormats, WhatIsWrittenIsReadAgain) {
  const Scene scene = load_good(triangle_json());
  for_each_extension([&](const SceneFormat& format, const std::string& extension) {
    const std::filesystem::path file = own_file("saved" + extension);
    if (!format.save) {
      EXPECT_THROW(save_scene(scene, file), EnvironmentError) << extension;
      return;
    }
    save_scene(scene, file);
    const Expected<Scene> again = load_scene(file);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->mesh->triangles.size(), scene.mesh->triangles.size()) << extension;
  });
}

TEST(SceneFormats, EachIsReadByItsExtension) {
  for_each_extension([](const SceneFormat& format, const std::string& extension) {
    const std::filesystem::path file = own_file("broken" + extension);
    std::ofstream(file) << "neither";
    const Expected<Scene> scene = load_scene(file);
    ASSERT_FALSE(scene) << extension;
    EXPECT_EQ(scene.error().message().find("is not of a format"), std::string::npos) << format.name;
  });
}

TEST(SceneFormats, ErrorsListThem) {
  const std::filesystem::path file = own_file("scene.xyz");
  std::ofstream(file) << "text";
  const std::string error = load_scene(file).error().message();
  EXPECT_NE(error.find("convert it to " + scene_extensions(FormatUse::read)), std::string::npos) << error;
  for_each_extension([&](const SceneFormat& format, const std::string& extension) {
    EXPECT_NE(scene_extensions(FormatUse::read).find(extension), std::string::npos) << extension;
    EXPECT_EQ(scene_extensions(FormatUse::written).find(extension) != std::string::npos,
              format.save != nullptr)
        << extension;
    EXPECT_NE(scene_format_names().find(format.name), std::string::npos) << format.name;
  });
}

// No other source lists extensions: PLY's, which nothing but a list would name.
// A format's room alone names its extensions.
TEST(SceneFormats, ThereIsOneList) {
  for (const char* folder : {"core", "hybrid", "app"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source_path(folder))) {
      const std::filesystem::path room = entry.path().parent_path().filename();
      if (entry.path().extension() != ".cpp" || entry.path().filename() == "formats.cpp" || room == "ply")
        continue;
      std::ifstream in(entry.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      EXPECT_EQ(text.find(".ply\""), std::string::npos) << entry.path();
    }
}

}  // namespace
}  // namespace pinocchio
