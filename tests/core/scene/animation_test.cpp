// Scenes that move by themselves, against closed forms.
#include "pinocchio/animation.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>

#include "pinocchio/save.h"
#include "tests/support/moving_gltf.h"

namespace pinocchio {
namespace {

TEST(Animation, InterpolatesAsGltfSays) {
  Moving m;
  m.animate(0, "translation", {1, 3}, m.floats({0, 0, 0, 4, 2, 0}, "VEC3"));
  const Scene scene = load_good(m.json);
  EXPECT_DOUBLE_EQ(duration_s(scene), 3.0);
  expect_near(scene.mesh->positions[0], {0, 0, 0});         // as its nodes have it
  expect_near(at(scene, 0).mesh->positions[0], {0, 0, 0});  // before the first key: that key
  expect_near(at(scene, 1.5).mesh->positions[0], {1, 0.5, 0});
  expect_near(at(scene, 99).mesh->positions[0], {4, 2, 0});  // behind the last
  EXPECT_EQ(at(scene, 1.5).mesh->triangles, scene.mesh->triangles);

  Moving step;
  step.animate(0, "translation", {0, 2}, step.floats({1, 0, 0, 5, 0, 0}, "VEC3"), "STEP");
  const Scene stepped = load_good(step.json);
  expect_near(at(stepped, 1.999).mesh->positions[0], {1, 0, 0});
  expect_near(at(stepped, 2).mesh->positions[0], {5, 0, 0});

  // Hermite from 0 with slope 3 to 1 with slope -1 over two seconds, at t = 1/4.
  Moving cubic;
  cubic.animate(0, "scale", {0, 2},
                cubic.floats({9, 9, 9, 0, 0, 0, 3, 3, 3, -1, -1, -1, 1, 1, 1, 9, 9, 9}, "VEC3"),
                "CUBICSPLINE");
  const double t = 0.25, h10 = t * t * t - 2 * t * t + t, h01 = 3 * t * t - 2 * t * t * t,
               h11 = t * t * t - t * t;
  const auto s = static_cast<float>(2 * h10 * 3 + h01 + 2 * h11 * -1);
  expect_near(at(load_good(cubic.json), 0.5).mesh->positions[1], {s, 0, 0});
}

// As KHR_animation_pointer names what moves.
void point_to(Moving& moving, const std::string& pointer) {
  Json& target = moving.json["animations"][0]["channels"].back()["target"];
  target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
}

TEST(Animation, PointersToNodesAreChannelsOfThem) {
  Moving m;
  m.json["extensionsUsed"] = m.json["extensionsRequired"] = {"KHR_animation_pointer"};
  m.animate(0, "", {0, 2}, m.floats({0, 0, 0, 4, 2, 0}, "VEC3"));
  point_to(m, "/nodes/0/translation");
  Warnings warnings;
  const Scene scene = load(m.json, &warnings).value();
  EXPECT_TRUE(warnings.empty());
  expect_near(at(scene, 1).mesh->positions[0], {2, 1, 0});
}

TEST(Animation, PointersToOtherThingsAreNamedOnceForEachKind) {
  Moving m;
  for (const char* pointer :
       {"/materials/0/emissiveFactor", "/materials/12/emissiveFactor",
        "/nodes/0/extensions/KHR_node_visibility/visible", "/nodes/x/translation", "/nodes/translation",
        "/nodes//scale", "/nodes/99999999999/scale", "translation"}) {
    m.animate(0, "", {0, 2}, m.floats({0, 0, 0, 4, 2, 0}, "VEC3"));
    point_to(m, pointer);
  }
  Warnings warnings;
  const Scene scene = load(m.json, &warnings).value();
  EXPECT_EQ(duration_s(scene), 0.0);
  std::map<std::string, std::size_t> places;
  for (const Warning& warning : warnings) places[warning.what] = warning.places;
  EXPECT_EQ(places.size(), 7u);
  EXPECT_EQ(places["KHR_animation_pointer to /materials/N/emissiveFactor is left out"], 2u);
  EXPECT_EQ(places["KHR_animation_pointer to /nodes/N/extensions/KHR_node_visibility/visible is left out"],
            1u);
}

// From 30 to 150 degrees around z; the quaternion of the second key is the negative one: the short way
// counts.
TEST(Animation, TurnsAtConstantSpeedTheShortWay) {
  const auto turn = [](float degrees) {
    return std::pair(std::sin(glm::radians(degrees) / 2), std::cos(glm::radians(degrees) / 2));
  };
  const auto [s0, c0] = turn(30);
  const auto [s1, c1] = turn(150);
  Moving m;
  m.animate(0, "rotation", {0, 1}, m.floats({0, 0, s0, c0, 0, 0, -s1, -c1}, "VEC4"));
  const Scene scene = load_good(m.json);
  for (const double t : {0.0, 0.1, 0.25, 0.5, 0.9, 1.0}) {
    const float angle = glm::radians(30.0f + 120.0f * static_cast<float>(t));
    expect_near(at(scene, t).mesh->positions[1], {std::cos(angle), std::sin(angle), 0});
  }
}

TEST(Animation, KeepsWhatOfANodeNothingMoves) {
  Moving m;
  m.json["nodes"][0]["translation"] = {5, 0, 0};
  m.json["nodes"][0]["scale"] = {2, 2, 2};
  m.animate(
      0, "rotation", {0, 1},
      m.floats({0, 0, 0, 1, 0, 0, std::sin(glm::quarter_pi<float>()), std::cos(glm::quarter_pi<float>())},
               "VEC4"));
  expect_near(at(load_good(m.json), 1).mesh->positions[1], {5, 2, 0});
}

// Light and camera hang on a child of what moves.
Moving lit_and_filmed() {
  Moving m;
  m.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  m.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
  m.json["nodes"][0]["children"] = {1};
  m.json["nodes"].push_back(
      {{"camera", 0}, {"translation", {0, 0, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  m.animate(0, "translation", {0, 1}, m.floats({0, 0, 0, 2, 0, 0}, "VEC3"));
  return m;
}

TEST(Animation, MovesLightsAndCameras) {
  const Moving m = lit_and_filmed();
  const Scene moved = at(load_good(m.json), 0.5);
  expect_near(moved.lights.at(0).position, {1, 0, 3});
  expect_near(moved.cameras.at(0).eye, {1, 0, 3});
  expect_near(moved.cameras.at(0).target, {1, 0, 2});
  expect_near(cameras_at(load_good(m.json), 0.5).at(0).eye, {1, 0, 3});
}

// Two instances of morph targets, of which the second is a mirror's; at 2 s the node is one, too.
Moving mirrored_and_morphed() {
  Moving m = morphed();
  m.json["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  m.json["nodes"][0]["rotation"] = {0.1, 0.2, 0.3, 0.927};
  m.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", m.floats({.1f, .2f, .3f, -3, 0, 0}, "VEC3")},
      {"SCALE", m.floats({1, 1, 1, -1.5, 1, 1}, "VEC3")}};
  m.animate(0, "scale", {0, 1, 2}, m.floats({1, 1, 1, .7f, .7f, .7f, -1, 1, 1}, "VEC3"));
  m.animate(0, "weights", {0, 2}, m.floats({0, 0, 1, 0.5}, "SCALAR"));
  return m;
}

// A time's mesh has the same bits, wherever one comes from; also of instances, which are placed twice.
TEST(Animation, IsMadeOfTheRestPoseAlone) {
  const Scene scene = load_good(mirrored_and_morphed().json);
  Scene walked = scene;
  for (const double t : {0.3, 1.9, 2.0, 0.0, 1.1, 0.7}) {
    walked = at(walked, t);
    const Scene alone = at(scene, t);
    EXPECT_EQ(walked.mesh->positions, alone.mesh->positions) << t;
    EXPECT_EQ(walked.mesh->normals, alone.mesh->normals) << t;
    EXPECT_EQ(walked.mesh->triangles, alone.mesh->triangles) << t;
  }
  // The second instance is a mirror's; at 2 s its node mirrors it back, and the first one is turned.
  const std::vector<glm::uvec3> before = scene.mesh->triangles, after = at(scene, 2).mesh->triangles;
  for (std::size_t i : {0u, 1u}) EXPECT_EQ(after[i], glm::uvec3(before[i].x, before[i].z, before[i].y));
  EXPECT_EQ(before[1] - before[0], glm::uvec3(4, 5, 3));
}

// What is saved, from whichever pose, and loaded moves as before: corners of each triangle within
// `tolerance`.
void expect_moves_alike(const Scene& scene, float tolerance) {
  for (const double saved_at : {0.0, 1.7}) {
    Warnings warnings;
    save_scene(at(scene, saved_at), own_file("moving.glb"), nullptr, &warnings);
    EXPECT_TRUE(warnings.empty());
    const Scene loaded = load_scene(own_file("moving.glb")).value();
    EXPECT_EQ(duration_s(loaded), duration_s(scene));
    for (const double seconds : {0.0, 0.3, 1.1, 2.0}) {
      const Scene a = at(scene, seconds), b = at(loaded, seconds);
      ASSERT_EQ(a.mesh->triangles.size(), b.mesh->triangles.size());
      for (std::size_t t = 0; t < a.mesh->triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
          const std::uint32_t v = a.mesh->triangles[t][c], w = b.mesh->triangles[t][c];
          EXPECT_LE(glm::distance(a.mesh->positions[v], b.mesh->positions[w]), tolerance) << seconds << " s";
          EXPECT_LE(glm::distance(a.mesh->normals[v], b.mesh->normals[w]), tolerance) << seconds << " s";
        }
      ASSERT_EQ(a.lights.size(), b.lights.size());
      for (std::size_t i = 0; i < a.lights.size(); ++i) EXPECT_EQ(a.lights[i].position, b.lights[i].position);
      ASSERT_EQ(a.cameras.size(), b.cameras.size());
      for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        EXPECT_EQ(a.cameras[i].eye, b.cameras[i].eye);
        expect_near(a.cameras[i].target, b.cameras[i].target);
      }
    }
  }
}

// Weights of skins are made to add up to 1 anew, which may round them once more; all else keeps its bits.
TEST(Animation, IsSavedWithSkinsAndMorphTargets) {
  expect_moves_alike(load_good(mirrored_and_morphed().json), 0.0f);
  expect_moves_alike(load_good(lit_and_filmed().json), 0.0f);
  Moving m = skinned();
  m.primitive()["targets"] = {{{"POSITION", m.floats({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3")}}};
  const float half = std::sin(glm::quarter_pi<float>());
  m.animate(2, "rotation", {0, 2}, m.floats({0, 0, 0, 1, 0, 0, half, half}, "VEC4"));
  m.animate(0, "weights", {0, 1}, m.floats({0, 0, 1, 0, 0, 0}, "SCALAR"), "CUBICSPLINE");
  expect_moves_alike(load_good(m.json), 1e-6f);
}

// Its first clip moves the one node; the other is for more.
Moving beside_another() {
  Moving m;
  m.json["nodes"].push_back({{"name", "other"}});
  m.json["scenes"][0]["nodes"] = {0, 1};
  m.animate(0, "translation", {0, 1}, m.floats({0, 0, 0, 1, 0, 0}, "VEC3"));
  return m;
}

TEST(Animation, ClipsAreSavedEachByItsName) {
  Moving m = beside_another();
  m.animate(1, "translation", {0, 2}, m.floats({0, 0, 0, 0, 1, 0}, "VEC3"), "LINEAR", 1);
  m.json["animations"][0]["name"] = "walk";
  m.json["animations"][1]["name"] = "wave";
  const Scene scene = load_good(m.json);
  save_scene(scene, own_file("clips.gltf"));
  const Scene saved = load_scene(own_file("clips.gltf")).value();
  ASSERT_EQ(saved.animation->clips.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(saved.animation->clips[i].name, scene.animation->clips[i].name);
    EXPECT_EQ(saved.animation->clips[i].duration_s, scene.animation->clips[i].duration_s);
  }
}

TEST(Animation, OfTwoThatMoveTheSameTheFirstPlays) {
  Moving m = beside_another();
  m.animate(0, "translation", {0, 9}, m.floats({0, 0, 0, 0, 1, 0}, "VEC3"), "LINEAR", 1);
  m.animate(1, "translation", {0, 2}, m.floats({0, 0, 0, 0, 1, 0}, "VEC3"), "LINEAR", 2);
  Warnings warnings;
  const Scene scene = load(m.json, &warnings).value();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].where, "animation 1");
  EXPECT_EQ(scene.animation->clips.size(), 2u);
  EXPECT_DOUBLE_EQ(duration_s(scene), 2.0);
  expect_near(at(scene, 1).mesh->positions[0], {1, 0, 0});
}

TEST(Animation, TheChosenOnePlaysAlone) {
  Moving m = beside_another();
  m.animate(0, "translation", {0, 9}, m.floats({0, 0, 0, 0, 9, 0}, "VEC3"), "LINEAR", 1);
  m.json["animations"][0]["name"] = "1";
  m.json["animations"][1]["name"] = "wave";
  std::ofstream(own_file("test.gltf")) << m.json.dump();
  const auto chosen = [](const std::string& name) {
    return load_scene(own_file("test.gltf"), LoadOptions{.animation = name});
  };
  const Scene wave = chosen("wave").value();
  EXPECT_DOUBLE_EQ(duration_s(wave), 9.0);
  expect_near(at(wave, 1).mesh->positions[0], {0, 1, 0});
  for (const char* const first : {"1", "0"}) {  // a name comes before a number
    const Scene scene = chosen(first).value();
    EXPECT_DOUBLE_EQ(duration_s(scene), 1.0);
    expect_near(at(scene, 1).mesh->positions[0], {1, 0, 0});
  }
  for (const char* const none : {"walk", "2", "-1", "0x"}) {
    const Expected<Scene> scene = chosen(none);
    ASSERT_FALSE(scene) << none;
    EXPECT_NE(scene.error().message().find("choose from 0 '1' or 1 'wave'"), std::string::npos)
        << scene.error().message();
  }
}

TEST(Animation, StillScenesPayNothing) {
  const Scene scene = load_good(triangle_json());
  EXPECT_FALSE(scene.animation);
  EXPECT_TRUE(scene.nodes->rest->deformations.empty());
  EXPECT_EQ(duration_s(scene), 0.0);
  EXPECT_EQ(at(scene, 1).mesh, scene.mesh);
}

TEST(Animation, TextureIsSharedByAllPoses) {
  MeshData mesh;
  mesh.textures = {Texture{"t", Image<glm::u8vec4>({2, 2})}};
  const MeshData copy = mesh;
  EXPECT_TRUE(copy.textures.shares_with(mesh.textures));
  mesh.textures.edit()[0].name = "other";
  EXPECT_EQ(copy.textures[0].name, "t");
}

// What is wrong in the file is said, and never shown.
TEST(Animation, SaysWhatIsWrong) {
  const auto says = [](const Json& json, const std::string& text) {
    EXPECT_NE(error_of(json).find(text), std::string::npos) << error_of(json);
  };
  const auto warns = [](const Json& json, const std::string& text) {
    Warnings warnings;
    const Expected<Scene> scene = load(json, &warnings);
    ASSERT_TRUE(scene) << scene.error().message();
    ASSERT_FALSE(warnings.empty()) << text;
    EXPECT_NE(warnings[0].message().find(text), std::string::npos) << warnings[0].message();
    EXPECT_TRUE(at_time(*scene, 0.5));
  };
  const auto moving = [](const std::vector<float>& times, const std::vector<float>& values) {
    Moving m;
    m.animate(0, "translation", times, m.floats(values, "VEC3"));
    return m.json;
  };
  warns(moving({1, 0}, {0, 0, 0, 1, 0, 0}), "times do not rise");
  warns(moving({0, 1}, {0, 0, 0, std::nanf(""), 0, 0}), "not finite");
  warns(moving({0, 1}, {0, 0, 0}), "a value for each time");
  Json json = moving({0, 1}, {0, 0, 0, 1, 0, 0});
  json["animations"][0]["channels"][0]["target"]["node"] = 7;
  says(json, "moves node 7, there are 1");
  json = moving({0, 1}, {0, 0, 0, 1, 0, 0});
  json["animations"][0]["channels"][0]["sampler"] = 3;
  says(json, "names sampler 3");
  json = moving({0, 1}, {0, 0, 0, 1, 0, 0});
  json["animations"][0]["channels"][0]["target"]["path"] = "weights";
  warns(json, "without morph targets");
  json = moving({0, 1}, {0, 0, 0, 1, 0, 0});
  json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  warns(json, "a matrix");
  EXPECT_FALSE(at_time(load_good(moving({0, 1}, {0, 0, 0, 1, 0, 0})), std::nan("")));
  EXPECT_FALSE(at_time(load_good(moving({0, 1}, {0, 0, 0, 1e30f, 0, 0})), 1));  // beyond what is drawn

  Moving m = skinned();
  m.primitive()["attributes"]["WEIGHTS_0"] =
      m.floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.1, 0, 0, 1, 0, 0, 0}, "VEC4");
  warns(m.json, "do not add up to 1");
  m = skinned();
  m.primitive()["attributes"]["JOINTS_0"] = m.bytes({0, 0, 0, 0, 9, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0}, false);
  says(m.json, "names joint 9 of skin 0, it has 2");
  m = skinned();
  m.json["skins"][0]["joints"] = {1, 7};
  says(m.json, "names node 7");
  m = skinned();
  m.json["nodes"][0]["skin"] = 4;
  says(m.json, "names skin 4");
  m = skinned();
  m.json["nodes"][1].erase("children");
  warns(m.json, "not in the scene");
  m = skinned();
  m.json["accessors"][static_cast<std::size_t>(m.json["skins"][0]["inverseBindMatrices"])]["count"] = 1;
  says(m.json, "1 inverse bind matrices");
  m = morphed();
  m.primitive()["targets"][0]["POSITION"] = m.floats({0, 0, 0}, "VEC3");
  says(m.json, "one element a vertex");
}

// An accessor without data may claim any count; so may a thousand channels of one.
TEST(Animation, StaysWithinTheMemoryLimit) {
  Moving m = morphed();
  m.json["accessors"].push_back({{"componentType", 5126},
                                 {"count", 2'000'000'000},
                                 {"type", "SCALAR"},
                                 {"sparse",
                                  {{"count", 0},
                                   {"indices", {{"bufferView", 1}, {"componentType", 5123}}},
                                   {"values", {{"bufferView", 0}}}}}});
  m.animate(0, "weights", {0, 1}, static_cast<int>(m.json["accessors"].size()) - 1);
  EXPECT_NE(error_of(m.json).find("MiB of memory"), std::string::npos) << error_of(m.json);
}

}  // namespace
}  // namespace pinocchio
