// Points and lines as balls and tubes.
#include <algorithm>
#include <cmath>
#include <random>

#include "core/geometry/round.h"
#include "pinocchio/animation.h"
#include "pinocchio/save.h"
#include "pinocchio/tracer.h"
#include "tests/support/gltf.h"

namespace pinocchio {
namespace {

Expected<Scene> load_text(const std::string& name, const std::string& text, const LoadOptions& options,
                          Warnings* warnings = nullptr) {
  const std::filesystem::path path = own_file(name);
  std::ofstream(path, std::ios::binary) << text;
  return load_scene(path, options, warnings);
}

Scene load_or_fail(const std::string& name, const std::string& text, const LoadOptions& options) {
  Expected<Scene> scene = load_text(name, text, options);
  EXPECT_TRUE(scene) << scene.error().message();
  return scene ? std::move(*scene) : Scene{};
}

// The least and the largest distance of a silhouette from the axis through the origin along `view`; of tubes,
// in the direction `across` alone.
struct Reach {
  double least = 1e9, most = 0.0;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

std::vector<glm::dvec2> hull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points,
                    [](const auto& a, const auto& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<glm::dvec2> all;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = all.size();
    for (const glm::dvec2& p : points) {
      while (all.size() > first + 1 &&
             cross(all.back() - all[all.size() - 2], p - all[all.size() - 2]) <= 0.0)
        all.pop_back();
      all.push_back(p);
    }
    all.pop_back();
    std::ranges::reverse(points);
  }
  return all;
}

void see(const std::vector<glm::dvec3>& points, const glm::dvec3& view, Reach& reach) {
  const glm::dmat3 frame(frame_along(glm::normalize(glm::vec3(view))));
  std::vector<glm::dvec2> seen;
  for (const glm::dvec3& p : points) seen.emplace_back(glm::dot(p, frame[0]), glm::dot(p, frame[1]));
  const std::vector<glm::dvec2> outline = hull(seen);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    reach.least = std::min(reach.least, std::abs(cross(a, b)) / glm::length(b - a));
    reach.most = std::max(reach.most, glm::length(a));
  }
}

TEST(Round, SilhouettesErrByWhatTheTableStates) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (std::size_t d = 0; d < kRoundDetails.size(); ++d) {
    const RoundShape ball = round_ball(static_cast<int>(d)), tube = round_tube(static_cast<int>(d));
    EXPECT_EQ(ball.triangles.size(), static_cast<std::size_t>(kRoundDetails[d].ball_triangles));
    EXPECT_EQ(ball.normals.size(), static_cast<std::size_t>(kRoundDetails[d].ball_vertices));
    EXPECT_EQ(tube.triangles.size(), static_cast<std::size_t>(kRoundDetails[d].tube_triangles()));
    EXPECT_EQ(tube.normals.size(), static_cast<std::size_t>(kRoundDetails[d].tube_vertices()));
    std::vector<glm::dvec3> points;
    for (const glm::vec3& n : ball.normals) points.emplace_back(glm::dvec3(n) * double{ball.reach});
    Reach reach;
    for (int i = 0; i < 300; ++i) see(points, {normal(random), normal(random), normal(random)}, reach);
    for (std::size_t i = 0; i < ball.triangles.size(); i += ball.triangles.size() / 80 + 1) {
      const glm::uvec3& t = ball.triangles[i];
      see(points, points[t.x], reach);
      see(points, points[t.x] + points[t.y], reach);
      see(points, points[t.x] + points[t.y] + points[t.z], reach);
    }
    // A tube's sides, seen along the line: their distance is the half width from every side.
    points.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(kRoundDetails[d].sides); ++i)
      points.emplace_back(glm::dvec3(tube.normals[i]) * double{tube.reach});
    Reach of_tube;
    see(points, {0, 0, 1}, of_tube);
    const double error =
        0.5 * std::max({reach.most - 1.0, 1.0 - reach.least, of_tube.most - 1.0, 1.0 - of_tube.least});
    EXPECT_LE(error, kRoundDetails[d].error) << d;
    EXPECT_GE(error, 0.95 * kRoundDetails[d].error) << d;  // the table states no more than it is
  }
}

TEST(Round, DetailFollowsTheNumber) {
  EXPECT_EQ(round_detail_for(1), 4);
  EXPECT_EQ(round_detail_for(1000), 3);
  EXPECT_EQ(round_detail_for(10000), 2);
  EXPECT_EQ(round_detail_for(1e5), 1);
  EXPECT_EQ(round_detail_for(1e6), 0);
}

TEST(Round, SurfacesAreClosedAndFaceOutwards) {
  for (int d = 0; d < std::ssize(kRoundDetails); ++d)
    for (const RoundShape& shape : {round_ball(d), round_tube(d)}) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
      for (const glm::uvec3& t : shape.triangles) {
        std::array<glm::dvec3, 3> p;
        for (int c = 0; c < 3; ++c) {
          ++edges[{t[c], t[(c + 1) % 3]}];
          p[c] = glm::dvec3(shape.normals[t[c]]) + glm::dvec3(0, 0, 3.0 * shape.ends[t[c]]);
        }
        const glm::dvec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
        const glm::dvec3 middle = (p[0] + p[1] + p[2]) / 3.0;
        EXPECT_GT(glm::dot(n, middle - glm::dvec3(0, 0, glm::clamp(middle.z, 0.0, shape.ends.back() * 3.0))),
                  0.0);
      }
      for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
      }
    }
}

const std::string kCloud =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n"
    "0 0 0 255 0 0\n2 0 0 0 255 0\nnan 0 0 0 0 255\n";

TEST(Strokes, PlyCloud) {
  Warnings warnings;
  const Expected<Scene> scene = load_text("cloud.ply", kCloud, {.point_size = 0.5f}, &warnings);
  ASSERT_TRUE(scene) << scene.error().message();
  const Mesh& mesh = *scene->mesh;
  ASSERT_EQ(mesh.triangles.size(), 2u * 1280u);
  ASSERT_EQ(mesh.colors.size(), mesh.positions.size());
  EXPECT_EQ(mesh.colors[mesh.triangles.front().x], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(mesh.colors[mesh.triangles.back().x], glm::vec4(0, 1, 0, 1));
  EXPECT_NEAR(mesh.bounds().hi.x, 2.25f, 0.001f);
  EXPECT_NEAR(mesh.bounds().lo.y, -0.25f, 0.001f);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::vec3 center(mesh.positions[i].x > 1.0f ? 2.0f : 0.0f, 0.0f, 0.0f);
    EXPECT_GT(glm::dot(glm::normalize(mesh.positions[i] - center), mesh.normals[i]), 0.9999f);
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].message().find("points and lines on vertices that are no finite numbers"),
            std::string::npos);
}

TEST(Strokes, AFileOfPointsThatAreNowhereIsNoCrash) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
      "float z\nend_header\nnan 0 0\n";
  const Expected<Scene> scene = load_text("cloud.ply", text, {.point_size = 1.0f});
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find("holds no triangles"), std::string::npos);
}

TEST(Strokes, AMillionPointsAreCountedBeforeTheyAreMade) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  text.resize(text.size() + 12000000);
  const Expected<Scene> scene =
      load_text("cloud.ply", text, {.limit_bytes = std::uint64_t{64} << 20, .point_size = 1.0f});
  ASSERT_FALSE(scene);
  EXPECT_NE(scene.error().message().find("drawing 1000000 points and 0 lines as 8000000 triangles needs"),
            std::string::npos)
      << scene.error().message();
}

// Points inside the ideal tubes, as far from their lines as the coarsest silhouette may be, are covered from
// every side: corners have no gaps.
TEST(Strokes, TubesOfAPolylineLeaveNoGaps) {
  const std::vector<glm::vec3> corners{{0, 0, 0},        {1, 0, 0},        {0.05f, 0.1f, 0},
                                       {0.05f, 1, 0.3f}, {0.05f, 1, 0.3f}, {0.05f, 1.2f, 0.3f}};
  std::string text;
  for (const glm::vec3& c : corners)
    text += "v " + std::to_string(c.x) + " " + std::to_string(c.y) + " " + std::to_string(c.z) + "\n";
  text += "l 1 2 3 4 5 6\n";
  const float width = 0.2f;
  const Scene scene = load_or_fail("line.obj", text, {.line_width = width});
  ASSERT_EQ(scene.mesh->triangles.size(), 4u * 1024u + 1280u);  // a line of no length is a ball
  const Tracer tracer(scene.mesh);
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> along(0.0f, 1.0f);
  std::vector<Ray> rays;
  for (int i = 0; i < 20000; ++i) {
    const std::size_t s = static_cast<std::size_t>(i) % 3;
    // Mostly beside the corners.
    const float t = i % 2 == 0 ? along(random) : (i % 4 == 1 ? 0.0f : 1.0f);
    const glm::vec3 center = glm::mix(corners[s], corners[s + 1], t);
    const glm::vec3 view = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
    const glm::mat3 frame = frame_along(view);
    const float angle = 6.2831853f * along(random);
    const glm::vec3 aim = center + 0.49f * width * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    rays.push_back({.origin = aim - 10.0f * view, .direction = view});
  }
  std::vector<Hit> hits(rays.size());
  for (const Backfaces backs : {Backfaces::draw, Backfaces::cull}) {
    tracer.closest_hits(rays, hits, backs);
    EXPECT_EQ(std::ranges::count_if(hits, [](const Hit& hit) { return hit.triangle == kNoTriangle; }), 0);
  }
}

TEST(Strokes, ObjKeepsMaterialsColorsAndFaces) {
  const auto mtl = own_file("paint.mtl");
  std::ofstream(mtl) << "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n";
  const Scene scene =
      load_or_fail("mixed.obj",
                   "mtllib paint.mtl\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 1 1 1\nusemtl red\n"
                   "f 1 2 3\nusemtl blue\np 1 -1\nl 1 2\n",
                   {.point_size = 0.1f, .line_width = 0.1f});
  const Mesh& mesh = *scene.mesh;
  ASSERT_EQ(mesh.triangles.size(), 1u + 2u * 1280u + 1024u);
  EXPECT_EQ(mesh.material_of(0).name, "red");
  EXPECT_EQ(mesh.material_of(1).name, "blue");
  EXPECT_EQ(mesh.material_of(1 + 2 * 1280).name, "blue");
  EXPECT_EQ(mesh.colors[mesh.triangles[1].x], glm::vec4(1, 0, 0, 1));
  bool red = false, green = false;  // a tube's ends have their vertices' colours
  for (std::size_t i = 1 + 2 * 1280; i < mesh.triangles.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const glm::vec4 color = mesh.colors[mesh.triangles[i][c]];
      red |= color == glm::vec4(1, 0, 0, 1), green |= color == glm::vec4(0, 1, 0, 1);
    }
  EXPECT_TRUE(red && green);
}

TEST(Strokes, ObjStatementsAreChecked) {
  const auto error_of = [](const std::string& text) {
    const Expected<Scene> scene = load_text("bad.obj", text, {.point_size = 1.0f, .line_width = 1.0f});
    EXPECT_FALSE(scene) << text;
    return scene ? "" : scene.error().message();
  };
  EXPECT_NE(error_of("v 0 0 0\nl 1 x\n").find("a line names vertex 'x'"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\np -2\n").find("a point names vertex '-2'"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nl 1 7\n").find("a line names vertex 7, there are 1"), std::string::npos);
  EXPECT_NE(error_of("v 0 0 0\nl 1\np\n").find("holds no triangles"), std::string::npos);
}

// Four vertices as this mode, in a node that is scaled and moved.
Json strokes_json(int mode) {
  Json json = triangle_json();
  json["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", 0}}}, {"mode", mode}};
  json["nodes"][0]["name"] = "wire";
  return json;
}

Expected<Scene> load_strokes(const Json& json, Warnings* warnings = nullptr) {
  return load_text("strokes.gltf", json.dump(), {.point_size = 0.5f, .line_width = 0.5f}, warnings);
}

TEST(Strokes, GltfModes) {
  const std::array<std::size_t, 4> triangles{4 * 1280, 2 * 1024, 4 * 1024, 3 * 1024};
  for (int mode = 0; mode < 4; ++mode) {
    const Expected<Scene> scene = load_strokes(strokes_json(mode));
    ASSERT_TRUE(scene) << scene.error().message();
    EXPECT_EQ(scene->mesh->triangles.size(), triangles[static_cast<std::size_t>(mode)]) << mode;
    EXPECT_EQ(scene->nodes->node_of(0), 0);
    EXPECT_EQ(scene->nodes->nodes[0].triangles, scene->mesh->triangles.size());
  }
}

TEST(Strokes, GltfBallsAreRoundInTheWorldAndMoveWithTheirNode) {
  Json json = strokes_json(0);
  json["nodes"][0]["scale"] = {10, 1, -2};
  json["nodes"][0]["rotation"] = {0, 0.6, 0, 0.8};
  json["nodes"][0]["translation"] = {5, 6, 7};
  const Expected<Scene> scene = load_strokes(json);
  ASSERT_TRUE(scene) << scene.error().message();
  const glm::mat4 world = scene->nodes->world_from(0);
  const glm::vec3 center(world * glm::vec4(0, 0, 0, 1));
  const Mesh& mesh = *scene->mesh;
  for (std::size_t i = 0; i < 642; ++i) {  // the first point's
    EXPECT_NEAR(glm::length(mesh.positions[i] - center), 0.25f, 0.002f);
    EXPECT_GT(glm::dot(glm::normalize(mesh.positions[i] - center), mesh.normals[i]), 0.9999f);
  }
  const glm::uvec3 t = mesh.triangles.front();
  const glm::vec3 n =
      glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
  EXPECT_GT(glm::dot(n, mesh.normals[t.x]), 0.0f);
  const glm::mat4 moved = glm::mat4(glm::mat3(world));  // the same without the translation
  const NodeTransform transform{0, moved};
  const Expected<Scene> posed_scene = posed(*scene, {&transform, 1});
  ASSERT_TRUE(posed_scene);
  for (std::size_t i = 0; i < 642; ++i)
    EXPECT_NEAR(glm::distance(posed_scene->mesh->positions[i], mesh.positions[i] - glm::vec3(5, 6, 7)), 0.0f,
                1e-5f);
}

TEST(Strokes, GltfBesideTrianglesAndInstances) {
  Json json = triangle_json();
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"mode", 2}});
  json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = 0;
  const Expected<Scene> scene = load_strokes(json);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_EQ(scene->mesh->triangles.size(), 4u * (2u + 3u * 1024u));
}

TEST(Strokes, GltfThatIsWrongIsAnError) {
  Json json = strokes_json(1);
  json["meshes"][0]["primitives"][0]["indices"] = 1;
  json["accessors"][1]["count"] = 4;
  json["accessors"][0]["count"] = 2;
  const Expected<Scene> few = load_strokes(json);
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message().find("mesh 0's primitive 0: names vertex 2, it has 2"), std::string::npos)
      << few.error().message();
  json = strokes_json(0);
  json["meshes"][0]["primitives"][0]["material"] = 9;
  EXPECT_FALSE(load_strokes(json));
  json = strokes_json(0);
  json["nodes"][0]["scale"] = {0, 0, 0};
  EXPECT_TRUE(load_strokes(json));
}

// A morph target and a skin move a ball's vertices as they move its point.
TEST(Strokes, GltfDeforms) {
  Json json = strokes_json(0);
  json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  json["meshes"][0]["weights"] = {1.0};
  const Expected<Scene> scene = load_strokes(json);
  ASSERT_TRUE(scene) << scene.error().message();
  EXPECT_NEAR(scene->mesh->bounds().hi.x, 2.25f, 0.002f);  // (1, 1, 0) is twice as far
  EXPECT_NEAR(scene->mesh->bounds().lo.x, -0.25f, 0.002f);
}

TEST(Strokes, SavedAsTriangles) {
  const Expected<Scene> scene = load_strokes(strokes_json(3));
  ASSERT_TRUE(scene);
  for (const char* name : {"saved.gltf", "saved.obj"}) {
    const auto path = own_file(name);
    Warnings warnings;
    save_scene(*scene, path, nullptr, &warnings);
    const Expected<Scene> again = load_scene(path);
    ASSERT_TRUE(again) << again.error().message();
    EXPECT_EQ(again->mesh->triangles.size(), scene->mesh->triangles.size());
  }
}

}  // namespace
}  // namespace pinocchio
