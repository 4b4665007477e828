#include "bench/rays/motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "bench/rays/sides/measure.h"
#include "core/files/atomic_file.h"
#include "core/math/median.h"
#include "core/parallel/workers.h"
#include "core/trace/tiles/trace_tiles.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/nodes.h"
#include "pinocchio/tracer.h"
#include "scenes/generator/mesh_builder.h"

namespace pinocchio::bench {
namespace {

// Where a part is at rest: in a cube of parts.
glm::vec3 place_of(int part, int side) {
  const glm::vec3 cell(part % side, part / side % side, part / (side * side));
  return 2.2f * (cell - 0.5f * static_cast<float>(side - 1));
}

int side_of(int parts) {
  return static_cast<int>(std::ceil(std::cbrt(static_cast<double>(parts)) - 1e-9));
}

Scene balls(int parts, int triangles) {
  // A sphere has 2 n (n / 2 - 1) triangles.
  const double each = static_cast<double>(triangles) / parts;
  const int around = std::max(4, 2 * static_cast<int>(std::lround(0.5 * (1.0 + std::sqrt(1.0 + each)))));
  MeshData one;
  MeshBuilder builder(one);
  builder.use(Material{});
  builder.sphere(glm::vec3(0.0f), 1.0f, around);
  const Scene ball{std::move(one)};
  std::vector<Part> all;
  for (int p = 0; p < parts; ++p)
    all.push_back(
        {"part " + std::to_string(p), ball, glm::translate(glm::mat4(1.0f), place_of(p, side_of(parts)))});
  Scene scene = assembled(all).value();
  const Camera camera = camera_for_whole_scene(scene);
  scene.lights.push_back(default_light(scene, camera));
  scene.cameras.push_back(camera);
  return scene;
}

// The moving parts turn and rock, those in the middle of the list first: they are in the middle of the scene.
std::vector<NodeTransform> pose_at(int frame, const MotionOptions& o) {
  std::vector<NodeTransform> transforms;
  const auto at = static_cast<float>(frame);
  for (int i = 0; i < o.moving; ++i) {
    const int part = (o.parts / 2 + i) % o.parts;
    const glm::vec3 rocks =
        0.3f * glm::vec3(std::sin(0.31f * at + static_cast<float>(i)), std::cos(0.17f * at), 0);
    const glm::mat4 place = glm::translate(glm::mat4(1.0f), place_of(part, side_of(o.parts)) + rocks);
    transforms.push_back({part, glm::rotate(place, 0.1f * at, glm::vec3(0.6f, 0.8f, 0.0f))});
  }
  return transforms;
}

struct Picture {
  Image<std::uint32_t> ids;
  Image<glm::vec4> color;
  MaskImage mask;
  Image<glm::vec3> reflection;
};

void draw(const Scene& scene, const Tracer& tracer, const MotionOptions& o, Workers& workers, Picture& to) {
  TileOutputs out;
  out.size = o.size;
  out.mask_bits = MaskImage::bits_for(static_cast<int>(casting_lights(scene).size()));
  out.mask = &to.mask;
  out.reflection = &to.reflection;
  out.ids = &to.ids;
  out.color = &to.color;
  trace_tiles({scene, tracer, workers, view_params(scene.cameras.front(), o.size)}, out);
}

std::size_t differing(const Picture& a, const Picture& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.color.pixels().size(); ++i)
    count += a.color.pixels()[i] != b.color.pixels()[i] || a.ids.pixels()[i] != b.ids.pixels()[i];
  return count;
}

}  // namespace

Motion measure_motion(const MotionOptions& o, const BuildOptions& tree) {
  constexpr int kBefore = 4;   // frames in which the trees of what moves come to be, or caches fill
  constexpr int kAtOnce = 10;  // moving frames, and then still ones
  const Scene base = balls(o.parts, o.triangles);
  Workers workers(o.threads);
  Motion result{.moving = o.moving,
                .parts = o.parts,
                .triangles = base.mesh->triangles.size(),
                .size = o.size,
                .threads = workers.count()};
  BuildOptions options = tree;
  options.threads = o.threads;
  for (const Light& light : base.lights) options.lights.push_back(light.position);
  const auto tracer_of = [&](const Scene& scene, const Tracer* before) {
    return std::make_shared<const Tracer>(scene, options, o.isa, OffsetMethod::error_bound, before);
  };
  std::vector<double> still, pose, trees, drawn, frame, rebuild;
  Scene scene = base;
  std::shared_ptr<const Tracer> tracer = tracer_of(scene, nullptr), whole;
  Picture kept, rebuilt;
  for (int first = 0; first < o.frames; first += kAtOnce) {
    for (int i = -kBefore; i < kAtOnce; ++i) {
      const std::vector<NodeTransform> transforms = pose_at(first + i, o);
      const double pose_s = seconds_of([&] { scene = posed(base, transforms).value(); });
      const double trees_s = seconds_of([&] { tracer = tracer_of(scene, tracer.get()); });
      const double drawn_s = seconds_of([&] { draw(scene, *tracer, o, workers, kept); });
      if (i < 0) continue;
      pose.push_back(pose_s);
      trees.push_back(trees_s);
      drawn.push_back(drawn_s);
      frame.push_back(pose_s + trees_s + drawn_s);
    }
    rebuild.push_back(seconds_of([&] { whole = tracer_of(scene, nullptr); }));
    for (int i = -kBefore; i < kAtOnce; ++i) {
      const double still_s = seconds_of([&] { draw(scene, *whole, o, workers, rebuilt); });
      if (i >= 0) still.push_back(still_s);
    }
    result.differ += differing(kept, rebuilt);
  }
  const auto ms = [](std::vector<double>& seconds) { return 1e3 * median(seconds); };
  result.isa = std::string(isa_name(tracer->isa()));
  result.still_ms = ms(still);
  result.pose_ms = ms(pose);
  result.trees_ms = ms(trees);
  result.drawn_ms = ms(drawn);
  result.frame_ms = ms(frame);
  result.rebuild_ms = ms(rebuild);
  return result;
}

void print(const Motion& m) {
  std::printf("%d of %d parts move, %zu triangles, %dx%d, %d threads, %s; milliseconds a frame:\n", m.moving,
              m.parts, m.triangles, m.size.x, m.size.y, m.threads, m.isa.c_str());
  std::printf("%8s %8s %8s %8s %8s %6s %10s %6s %8s\n", "still", "pose", "trees", "drawn", "frame", "lost",
              "one tree", "lost", "differ");
  std::printf("%8.2f %8.2f %8.2f %8.2f %8.2f %5.1f%% %10.2f %5.1f%% %8zu\n", m.still_ms, m.pose_ms,
              m.trees_ms, m.drawn_ms, m.frame_ms, 100.0 * m.lost(), m.rebuild_ms,
              100.0 * m.lost_by_rebuilding(), m.differ);
}

void save(const Motion& m, const std::string& file) {
  const nlohmann::json json{{"moving", m.moving},          {"parts", m.parts},
                            {"triangles", m.triangles},    {"size", {m.size.x, m.size.y}},
                            {"threads", m.threads},        {"isa", m.isa},
                            {"still_ms", m.still_ms},      {"pose_ms", m.pose_ms},
                            {"trees_ms", m.trees_ms},      {"drawn_ms", m.drawn_ms},
                            {"frame_ms", m.frame_ms},      {"lost", m.lost()},
                            {"one_tree_ms", m.rebuild_ms}, {"lost_by_rebuilding", m.lost_by_rebuilding()},
                            {"differing_pixels", m.differ}};
  write_text(file, json.dump(2) + "\n");
}

}  // namespace pinocchio::bench
