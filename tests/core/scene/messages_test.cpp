// What readers say about files, word by word, as docs/messages.md has it.
#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "pinocchio/environment.h"
#include "pinocchio/load.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

std::filesystem::path written(const std::string& name, const std::string& text) {
  std::filesystem::create_directories(own_folder());
  const std::filesystem::path file = own_folder() / name;
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string all_of(const Warnings& warnings) {
  std::string all;
  for (const Warning& warning : warnings) all += warning.message() + "\n";
  return all;
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Messages, OfStatementsInMtl) {
  struct Case {
    const char *statement, *said;
  };
  const std::vector<Case> cases{
      {"map_Ks a.png", "map_Ks is left out; highlights have one colour"},
      {"map_Ns a.png", "map_Ns is left out; highlights are equally sharp everywhere"},
      {"map_Tr a.png", "map_Tr is left out; its transparent parts are opaque"},
      {"disp a.png", "disp is left out; the surface looks smooth"},
      {"map_disp a.png", "map_disp is left out; the surface looks smooth"},
      {"map_Disp a.png", "map_Disp is left out; the surface looks smooth"},
      {"map_Pr a.png", "map_Pr is left out; highlights and mirrors are as Ks and Ns say"},
      {"map_Pm a.png", "map_Pm is left out; highlights and mirrors are as Ks and Ns say"},
      {"Ps 1", "Ps is left out; the sheen of cloth is missing"},
      {"map_Ps a.png", "map_Ps is left out; the sheen of cloth is missing"},
      {"Pc 1", "Pc is left out; highlights of the clear coat are missing"},
      {"Pcr 1", "Pcr is left out; highlights of the clear coat are missing"},
      {"aniso 1", "aniso is left out; highlights are round"},
      {"anisor 1", "anisor is left out; highlights are round"},
      {"decal a.png", "decal is left out; it is not drawn"},
      {"refl a.png", "refl is left out; its reflection map is not shown"},
      {"Glow 1", "unknown statements are left out; what they stand for is missing"},
      {"Kd spectral a.rfl", "a colour as 'spectral' is left out; it is black"},
      {"Ns much", "Ns 'much' is no number; it is 0"}};
  std::string text = "newmtl m\n";
  for (const Case& one : cases) text += std::string(one.statement) + "\n";
  (void)written("all.mtl", text);
  Warnings warnings;
  const auto scene =
      load_scene(written("all.obj", "mtllib all.mtl\nusemtl m\n" + std::string(kTriangle) + "f 1 2 3\n"),
                 LoadOptions{}, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  const std::string all = all_of(warnings);
  for (const Case& one : cases) EXPECT_NE(all.find(one.said), std::string::npos) << one.said << "\n" << all;
}

TEST(Messages, OfObjAndPly) {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string begin = "ply\nformat ascii 1.0\n", end = "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  struct Case {
    const char* file;
    std::string text;
    const char* said;
  };
  const std::vector<Case> cases{
      {"corner.obj", std::string(kTriangle) + "f 1/1/1/7 2 3\n",
       "a face has the corner '1/1/1/7', which has text after the index of its normal"},
      {"format.ply", "ply\n" + vertices + end, "its header has no format"},
      {"list.ply", begin + vertices + "element face 1\nproperty list half int vertex_indices\n" + end,
       "a list's length has a type that PLY does not know"},
      {"property.ply", begin + "property float x\n" + vertices + end,
       "property x belongs to no element or has a type that PLY does not know"},
      {"number.ply", begin + "element vertex many\n" + end,
       "element vertex has 'many' where its number is expected"},
      {"position.ply",
       begin + "element vertex 3\nproperty float a\nproperty float b\nproperty float c\n" +
           "element face 1\nproperty list uchar int vertex_indices\n" + end,
       "its vertices have no x, y and z"},
      {"faces.ply", begin + vertices + "element face 1\nproperty list uchar int corners\n" + end,
       "its faces have no list vertex_indices"},
      {"version.gltf", R"({"asset": {}})", "is not glTF: it does not say its version (asset.version)"},
      {"new.gltf", R"({"asset": {"version": "2.0", "minVersion": "2.7"}})",
       "needs a reader of glTF 2.7, this one reads 2.0; export it as glTF 2.0"},
      {"array.gltf", "[]", "is not glTF: its JSON is no object"}};
  for (const Case& one : cases) {
    const auto scene = load_scene(written(one.file, one.text));
    ASSERT_FALSE(scene) << one.file;
    EXPECT_NE(scene.error().message().find(one.said), std::string::npos) << scene.error().message();
  }
}

TEST(Messages, OfRadiancePictures) {
  const std::string format = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  struct Case {
    std::string text;
    const char* said;
  };
  const std::vector<Case> cases{
      {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd", "its FORMAT is not 32-bit_rle_rgbe"},
      {format + "+X 1 -Y 1\nabcd", "its rows are not in the order -Y +X (from the top down, left to right)"},
      {format + "-Y 0 +X 1\n", "its size is impossible"},
      {format + "-Y 1 +X 2\nabcd", "it is cut off"},
      {format + "-Y 1 +X 2\nabcd\x01\x01\x01\x05", "a run of equal pixels does not fit its row"}};
  for (const Case& one : cases) {
    const auto sky = load_environment(written("sky.hdr", one.text));
    ASSERT_FALSE(sky) << one.said;
    EXPECT_NE(sky.error().message().find(one.said), std::string::npos) << sky.error().message();
  }
}

}  // namespace
}  // namespace pinocchio
