#include <fstream>

#include "tests/support/own_file.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

std::filesystem::path write_file(const std::string& name, const std::string& text) {
  const std::filesystem::path path = own_file(name);
  std::ofstream(path) << text;
  return path;
}

Scene load_text(const std::string& obj, const std::string& mtl = "", Warnings* warnings = nullptr) {
  write_file("test.mtl", mtl);
  Expected<Scene> scene = load_scene(write_file("test.obj", "mtllib test.mtl\n" + obj), warnings);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? std::move(*scene) : Scene{};
}

InputError error_of(const std::string& obj) {
  const Expected<Scene> scene = load_scene(write_file("bad.obj", obj));
  EXPECT_FALSE(scene);
  return scene ? InputError{} : scene.error();
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(LoadObj, ReadsTrianglesPolygonsAndRelativeIndices) {
  const Scene scene = load_text(kTriangle + "v 1 1 0\nf 1 2 4 3\nf -4 -3 -2\n");
  EXPECT_EQ(scene.mesh->triangles.size(), 3u);
  EXPECT_EQ(scene.mesh->normals[0], glm::vec3(0.0f));  // flat: no normals, no smoothing group
  ASSERT_EQ(scene.source_files.size(), 2u);
  EXPECT_EQ(scene.source_files[0], scene.source);
  EXPECT_EQ(std::filesystem::path(scene.source_files[1]).filename(), "test.mtl");
  EXPECT_EQ(scene.mesh->materials[scene.mesh->triangle_materials[0]].name, "default");
}

TEST(LoadObj, SmoothingGroupsMakeNormals) {
  // Two triangles that meet at a right angle along the z axis.
  const std::string roof = "v 0 0 0\nv 0 0 1\nv -1 -1 0\nv 1 -1 0\n";
  const Scene smooth = load_text(roof + "s 1\nf 1 3 2\nf 1 2 4\n");
  ASSERT_EQ(smooth.mesh->positions.size(), 4u);
  EXPECT_NEAR(std::abs(smooth.mesh->normals[0].y), 1.0f, 1e-6f);
  const Scene apart = load_text(roof + "s 1\nf 1 3 2\ns 2\nf 1 2 4\n");
  EXPECT_EQ(apart.mesh->positions.size(), 6u);
  EXPECT_NEAR(std::abs(apart.mesh->normals[0].y), std::sqrt(0.5f), 1e-6f);
  // Also across a seam of texture coordinates.
  const Scene seam = load_text(roof + "vt 0 0\nvt 1 1\ns 1\nf 1/1 3/1 2/1\nf 1/2 2/2 4/2\n");
  ASSERT_EQ(seam.mesh->positions.size(), 6u);
  EXPECT_NEAR(std::abs(seam.mesh->normals[0].y), 1.0f, 1e-6f);
  EXPECT_EQ(seam.mesh->normals[3], seam.mesh->normals[0]);
  const Scene off = load_text(roof + "s off\nf 1 3 2\nf 1 2 4\n");
  EXPECT_EQ(off.mesh->normals[0], glm::vec3(0.0f));
}

TEST(LoadObj, IlluminationModels) {
  const std::string faces =
      kTriangle +
      "usemtl plain\nf 1 2 3\nusemtl mirror\nf 1 2 3\nusemtl glass\nf 1 2 3\nusemtl not_glass\nf 1 2 "
      "3\nusemtl varnish\nf 1 2 3\nusemtl by_d\nf 1 2 3\n";
  const Scene scene = load_text(faces,
                                "newmtl plain\nKd .1 .2 .3\nKs .4 .4 .4\nNs 50\nillum 2\nKe 1 2 3\n"
                                "newmtl mirror\nKd .1 .1 .1\nKs .9 .9 .9\nillum 3\n"
                                "newmtl glass\nKd 0 0 0\nKs 1 1 1\nNi 1.5\nTf .9 .8 .7\nillum 7\n"
                                "newmtl not_glass\nKd .5 .5 .5\nKs 1 1 1\nNi 1.5\nd 1\nillum 7\n"
                                "newmtl varnish\nKd .5 .5 .5\nKs .04 .04 .04\nillum 5\n"
                                "newmtl by_d\nKd .5 .5 .5\nNi 1.3\nd 0.25\nillum 4\n");
  const auto material = [&](std::uint32_t i) { return scene.mesh->material_of(i); };
  EXPECT_EQ(material(0).diffuse, glm::vec3(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(material(0).ambient, material(0).diffuse);  // no Ka
  EXPECT_EQ(material(0).shininess, 50.0f);
  EXPECT_EQ(material(0).emission, glm::vec3(1, 2, 3));
  EXPECT_FALSE(material(0).spawns_rays());
  EXPECT_EQ(material(1).reflectance, glm::vec3(0.9f));
  EXPECT_FALSE(material(1).fresnel);
  EXPECT_EQ(material(2).transmittance, glm::vec3(0.9f, 0.8f, 0.7f));
  EXPECT_EQ(material(2).ior, 1.5f);
  EXPECT_FALSE(material(3).transmits());  // exporters write illum 7 for plain materials
  EXPECT_TRUE(material(4).fresnel);
  EXPECT_EQ(material(5).transmittance, glm::vec3(0.75f));
  const std::string one = kTriangle + "usemtl m\nf 1 2 3\n", shiny = "newmtl m\nKs .4 .4 .4\nNs 50\n";
  EXPECT_EQ(load_text(one, shiny).mesh->material_of(0).specular, glm::vec3(0.4f));  // no illum
  EXPECT_EQ(load_text(one, shiny + "illum 1\n").mesh->material_of(0).specular, glm::vec3(0.0f));
}

TEST(LoadObj, AMaterialFileIsReadOnce) {
  const Scene scene = load_text("mtllib test.mtl\nmtllib test.mtl\n" + kTriangle + "usemtl m\nf 1 2 3\n",
                                "newmtl m\nKd 1 0 0\n");
  EXPECT_EQ(scene.mesh->materials.size(), 2u);  // and the default one
  EXPECT_EQ(scene.mesh->material_of(0).name, "m");
}

TEST(LoadObj, MissingMaterialsAndTexturesAreWarnings) {
  Warnings warnings;
  const Expected<Scene> scene =
      load_scene(write_file("w.obj", "mtllib nowhere.mtl\n" + kTriangle + "usemtl m\nf 1 2 3\n"), &warnings);
  ASSERT_TRUE(scene);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].message().find("nowhere.mtl"), std::string::npos);
  warnings = {};
  (void)load_text(kTriangle + "vt 0 0\nusemtl m\nf 1/1 2/1 3/1\n", "newmtl m\nmap_Kd none.png\n", &warnings);
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings[0].message().find("none.png"), std::string::npos);
}

TEST(LoadObj, TextureCoordinatesGrowDownwards) {
  write_file("t.ppm", "P3 1 1 255 10 20 30\n");  // not what stb reads as text; P6 is
  std::ofstream(own_file("t.ppm"), std::ios::binary) << "P6 1 1 255\n"
                                                     << "\x0a\x14\x1e";
  const Scene scene =
      load_text(kTriangle + "vt 0.25 0.75\nusemtl m\nf 1/1 2/1 3/1\n", "newmtl m\nmap_Kd t.ppm\n");
  ASSERT_EQ(scene.mesh->textures.size(), 1u);
  EXPECT_EQ(scene.mesh->textures[0].image().at(0, 0), glm::u8vec4(10, 20, 30, 255));
  EXPECT_EQ(scene.mesh->texcoords[0], glm::vec2(0.25f, 0.25f));
}

TEST(LoadObj, LinesMayEndInACarriageReturnAlone) {
  const Scene scene = load_text("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r");
  EXPECT_EQ(scene.mesh->triangles.size(), 1u);
  EXPECT_EQ(error_of("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 9999999\r").line, 4);
  EXPECT_EQ(error_of("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 9\r\n").line, 4);
}

TEST(LoadObj, BackslashesJoinLines) {
  const Scene scene =
      load_text("v 0 0 \\\n0\nv 1 0 0\r\nv 0 1 0\nusemtl m\nf 1 \\\r\n2 3\n", "newmtl m\nKd 1 \\\n0 0\n");
  ASSERT_EQ(scene.mesh->triangles.size(), 1u);
  EXPECT_EQ(scene.mesh->material_of(0).diffuse, glm::vec3(1, 0, 0));
  EXPECT_EQ(error_of("v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 9\n").line, 5);
}

TEST(LoadObj, VertexColors) {
  const Scene scene = load_text("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(scene.mesh->colors.size(), 3u);
  EXPECT_EQ(scene.mesh->colors[0], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene.mesh->colors[2], glm::vec4(1.0f));
  EXPECT_EQ(scene.mesh->material_of(0).diffuse, glm::vec3(1.0f));
  EXPECT_TRUE(load_text("v 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nf 1 2 3\n").mesh->colors.empty());  // w
}

TEST(LoadObj, NamesWithSpacesAndPathsOfWindows) {
  std::filesystem::create_directories(own_file("maps"));
  std::ofstream(own_file("maps") / "my texel.ppm", std::ios::binary) << "P6 1 1 255\n\x0a\x14\x1e";
  const Scene scene = load_text(kTriangle + "vt 0 0\nusemtl red paint\nf 1/1 2/1 3/1\n",
                                "newmtl red paint \nKd 1 0 0\nmap_Kd maps\\my texel.ppm\n");
  EXPECT_EQ(scene.mesh->material_of(0).name, "red paint");
  EXPECT_EQ(scene.mesh->textures.size(), 1u);
}

TEST(LoadObj, SlashesMayEndACorner) {
  // The parser would take the next corner's vertex for a normal that there is not.
  EXPECT_EQ(load_text(kTriangle + "f 1// 2// 3//\n").mesh->triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(load_text(kTriangle + "vt 0 0\nf 1/1/ 2/1/ 3/1/\n").mesh->triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(error_of(kTriangle + "f 1/2/3/4 2 3\n").line, 4);
}

TEST(LoadObj, MaterialFilesMayHaveSpacesInTheirNames) {
  write_file("my red.mtl", "newmtl red\nKd 1 0 0\n");
  Warnings warnings;
  const std::string text = "mtllib my red.mtl\n" + kTriangle + "usemtl red\nf 1 2 3\n";
  const Expected<Scene> scene = load_scene(write_file("my red.obj", text), &warnings);
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->mesh->material_of(0).diffuse, glm::vec3(1, 0, 0));
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
}

TEST(LoadObj, SeveralMaterialFilesMayHaveSpacesInTheirNames) {
  write_file("my red.mtl", "newmtl red\nKd 1 0 0\n");
  write_file("blue.mtl", "newmtl blue\nKd 0 0 1\n");
  const std::string faces = kTriangle + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n";
  for (const std::string names : {"blue.mtl my red.mtl", "my red.mtl blue.mtl"}) {
    Warnings warnings;
    ASSERT_TRUE(load_scene(write_file("two.obj", "mtllib " + names + "\n" + faces), &warnings));
    EXPECT_TRUE(warnings.empty()) << warnings[0].message();
  }
  Warnings warnings;
  ASSERT_TRUE(
      load_scene(write_file("none.obj", "mtllib my green.mtl\n" + kTriangle + "f 1 2 3\n"), &warnings));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("my green.mtl: there is no such file"), std::string::npos);
}

TEST(LoadObj, MaterialsThatNoFileExplainsAreWarnings) {
  Warnings warnings;
  const Scene scene =
      load_text(kTriangle + "usemtl blue\nf 1 2 3\nusemtl blue\nf 1 2 3\n", "newmtl red\n", &warnings);
  EXPECT_EQ(scene.mesh->material_of(0).name, "default");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("blue"), std::string::npos);
}

TEST(LoadObj, MessagesAreOneLineWithoutCommandsForTheTerminal) {
  const InputError error = error_of(kTriangle + "f 1 2 \x1b[31m\\\n3\n");
  EXPECT_EQ(error.line, 4);
  EXPECT_NE(error.message().find("a face names vertex '?[31m'"), std::string::npos) << error.message();
  EXPECT_EQ(error.message().find_first_of("\n\r\v\x1b"), std::string::npos);
  EXPECT_EQ(error_of("v 1 2\n").what, "a vertex has too few numbers");
}

TEST(LoadObj, BadInputNamesTheLine) {
  EXPECT_EQ(error_of(kTriangle + "f 1 2 9\n").line, 4);
  EXPECT_EQ(error_of(kTriangle + "f 1 2 0\n").line, 4);
  EXPECT_EQ(error_of(kTriangle + "f -1 -2 -4\n").line, 4);
  EXPECT_EQ(error_of(kTriangle + "\n# comment\nf 1 2 x\n").line, 6);
  EXPECT_EQ(error_of("v 0 0 0\nv 0 3.1+e2 0\n").line, 2);
  EXPECT_EQ(error_of("v 0 0 0\nv 0 0\n").line, 2);
  EXPECT_EQ(error_of("v a b c\n").line, 1);
  EXPECT_NE(error_of(kTriangle).what.find("no triangles"), std::string::npos);
  EXPECT_NE(error_of("").what.find("empty"), std::string::npos);
}

TEST(LoadObj, OtherNumbersThatAreNotFiniteAreLeftOut) {
  write_file("texel.ppm", "P6 1 1 255\nabc");
  Warnings warnings;
  const Scene scene = load_text(
      "v 0 0 0 nan 0 0\nv 1 0 0 0 0 0\nv 0 1 0\nvn nan 0 1\nvt 2 inf\nusemtl map\nf 1/1/1 2/1/1 3/1/1\n",
      "newmtl map\nmap_Kd texel.ppm\n", &warnings);
  ASSERT_EQ(scene.mesh->positions.size(), 3u);
  EXPECT_EQ(scene.mesh->normals[0], glm::vec3(0.0f));       // flat
  EXPECT_EQ(scene.mesh->texcoords[0], glm::vec2(0, 1));     // OBJ's (0, 0)
  EXPECT_EQ(scene.mesh->colors[0], glm::vec4(1.0f));        // white
  EXPECT_EQ(scene.mesh->colors[1], glm::vec4(0, 0, 0, 1));  // as it is
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(
      warnings[0].message().find("line 2 (v): normals, colours and texture coordinates that are no finite "
                                 "numbers are left out (and in 2 more places)"),
      std::string::npos)
      << warnings[0].message();
}

TEST(LoadObj, TheIndex0IsLeftOut) {
  for (const auto& [face, whose] :
       {std::pair("f 1//0 2//0 3//0\n", "normal"), {"f 1/0 2/0 3/0\n", "texture coordinate"}}) {
    Warnings warnings;
    const Scene scene = load_text(kTriangle + "vn 0 0 1\nvt 1 1\n" + face, "", &warnings);
    ASSERT_EQ(scene.mesh->triangles.size(), 1u);
    EXPECT_EQ(scene.mesh->normals[0], glm::vec3(0.0f));
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].message().find(std::string("line 7 (f): the index 0 of a ") + whose +
                                         " is left out: they count from 1 (and in 2 more places)"),
              std::string::npos)
        << warnings[0].message();
  }
}

TEST(LoadObj, CommentsMayEndWithABackslashOrFollowAName) {
  Warnings warnings;
  const Scene scene =
      load_text("# from C:\\models\\\nmtllib test.mtl\n" + kTriangle + "usemtl red # as painted\nf 1 2 3\n",
                "newmtl red\nKd 1 0 0\n", &warnings);
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
  EXPECT_EQ(scene.mesh->material_of(0).diffuse, glm::vec3(1, 0, 0));
  // A name that is there as it is written goes first.
  const Scene other = load_text("mtllib test.mtl\n" + kTriangle + "usemtl red\nf 1 2 3\n",
                                "newmtl red # shiny\nKd 1 0 0\nnewmtl red\nKd 0 1 0\n");
  EXPECT_EQ(other.mesh->material_of(0).diffuse, glm::vec3(0, 1, 0));
}

// So many that a time that grows with their square would exceed the test's time limit.
TEST(LoadObj, ManyLinesAreJoined) {
  std::string text = kTriangle + "f 1 2";
  for (int i = 0; i < 300000; ++i) text += " \\\n  ";
  Warnings warnings;
  EXPECT_EQ(load_text(text + "3\n", "", &warnings).mesh->triangles.size(), 1u);
  EXPECT_TRUE(warnings.empty()) << warnings[0].message();
}

TEST(LoadObj, FacesOnVerticesThatAreNoFiniteNumbersAreLeftOut) {
  for (const char* number : {"nan", "-inf", "1e99", "1e400", "-1.#IND", "1.#QNAN", "1.#INF00", "-nan(ind)"}) {
    Warnings warnings;
    const Scene scene = load_text(
        kTriangle + "v 0 " + number + " 0\nf 1 2 4\nf 3 2 1\nf 1 2 3 4\nv nan 0 0\n", "", &warnings);
    EXPECT_EQ(scene.mesh->triangles.size(), 1u);
    EXPECT_EQ(scene.mesh->bounds().hi, glm::vec3(1, 1, 0));
    ASSERT_FALSE(warnings.empty());
    EXPECT_NE(warnings[0].message().find("line 5 (v): faces on vertices that are no finite numbers are left "
                                         "out (and in 1 more place); they are not drawn"),
              std::string::npos)
        << warnings[0].message();
  }
  EXPECT_NE(error_of("v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").what.find("no triangles"), std::string::npos);
}

TEST(LoadObj, NormalsAndTextureCoordinatesThatThereAreNotAreWarnings) {
  const std::filesystem::path path = own_file("dangling.obj");
  std::ofstream(path) << kTriangle << "vn 0 0 1\nf 1/5/1 2/5/1 3/5/7\n";
  Warnings warnings;
  const Expected<Scene> scene = load_scene(path, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].message().find("line 5: a face names texture coordinate 5, there are 0"),
            std::string::npos);
  EXPECT_NE(warnings[1].message().find("line 5: a face names normal 7, there are 1"), std::string::npos);
  EXPECT_EQ(scene->mesh->normals[scene->mesh->triangles[0].x], glm::vec3(0, 0, 1));
  EXPECT_EQ(scene->mesh->normals[scene->mesh->triangles[0].z], glm::vec3(0.0f));
}

TEST(LoadObj, RandomBytesNeverCrash) {
  Random random(5);
  const std::string letters = "vfnt 0123456789.-/\n\r\t\\eusmtl#\0\xff";
  for (int i = 0; i < 300; ++i) {
    std::string text = i % 2 ? kTriangle : "";
    for (std::uint32_t n = random.next() % 400; n > 0; --n) text += letters[random.next() % letters.size()];
    (void)load_scene(write_file("random.obj", text));
  }
}

TEST(LoadScene, FindsTheFileOfAName) {
  EXPECT_TRUE(load_scene(source_path("scenes/cornell")));
  EXPECT_TRUE(load_scene(source_path("scenes/speedboat")));
  const auto message = [](const std::filesystem::path& path) { return load_scene(path).error().message(); };
  EXPECT_NE(message("nowhere.obj").find("no such file"), std::string::npos);
  EXPECT_NE(message(source_path("core")).find("folder"), std::string::npos);
  EXPECT_NE(message(source_path("CMakeLists.txt")).find("format"), std::string::npos);
}

}  // namespace
}  // namespace pinocchio
