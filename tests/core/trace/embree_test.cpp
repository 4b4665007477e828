// Embree 3 as an oracle: primary hits, shadow mask bits and first reflection hits of whole pictures.
#include <cmath>
#include <memory>
#include <optional>

#include "bench/one_ray/passes.h"
#include "bench/one_ray/surface_at.h"
#include "core/trace/view/view_params.h"
#include "tests/support/embree.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{800, 600};
constexpr double kLeastAgreement = 0.9999;
// Two hits are one where they name the same triangle, or meet where two triangles do.
constexpr float kSamePlace = 1e-5f;  // relative distance

bool same(const Hit& a, const Hit& b) {
  if (a.triangle == b.triangle) return true;
  return a.valid() && b.valid() && std::abs(a.t - b.t) <= kSamePlace * std::max(a.t, b.t);
}

// Whether something changes within one pixel: a silhouette, by Embree's distances alone.
bool at_silhouette(const Image<Hit>& hits, int x, int y) {
  constexpr float kJump = 0.002f;  // relative distance from one pixel to the next
  const float t = hits.at(x, y).t;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int nx = x + dx, ny = y + dy;
      if (nx < 0 || ny < 0 || nx >= kSize.x || ny >= kSize.y) return true;
      const Hit& n = hits.at(nx, ny);
      if (n.valid() != hits.at(x, y).valid() || std::abs(n.t - t) > kJump * std::min(n.t, t)) return true;
    }
  return false;
}

// ... or a shadow's edge.
bool at_shadow_edge(const Image<unsigned>& masks, int x, int y) {
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const int nx = std::clamp(x + dx, 0, kSize.x - 1), ny = std::clamp(y + dy, 0, kSize.y - 1);
      if (masks.at(nx, ny) != masks.at(x, y)) return true;
    }
  return false;
}

// Ours and Embree's answer for every pixel.
struct Comparison {
  explicit Comparison(Scene s)
      : scene(std::move(s)),
        tracer(scene.mesh),
        embree(*scene.mesh),
        workers(2),
        view(view_params(camera(), kSize)) {
    TraceJob job{scene, tracer, workers, view};
    job.options.terminator = Terminator::off;  // Embree's rays start on the facets
    trace_visibility(job, ids);
    trace_shadow_mask(job, ids, MaskImage::bits_for(static_cast<int>(casting_lights(scene).size())), mask);
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const Ray ray = pixel_ray(view, x, y);
        tracer.closest_hits({&ray, 1}, {&ours.at(x, y), 1});
        theirs.at(x, y) = embree.closest_hit(ray);
      }
  }

  [[nodiscard]] Camera camera() const {
    return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  }

  Scene scene;
  Tracer tracer;
  Embree embree;
  Workers workers;
  shared::ViewParams view;
  Image<std::uint32_t> ids{kSize};
  MaskImage mask;
  Image<Hit> ours{kSize}, theirs{kSize};
};

// Counts pixels, prints the share that agrees, and fails below the bar or where a disagreement is not at
// an edge.
class Tally {
 public:
  explicit Tally(std::string what) : what_(std::move(what)) {}
  void add(bool agrees, int x, int y, const std::function<bool()>& at_edge) {
    ++all_;
    if (agrees) return;
    ++different_;
    EXPECT_TRUE(at_edge()) << what_ << " disagree away from any edge at pixel " << x << ", " << y;
  }
  void finish() const {
    const double share = all_ == 0 ? 1.0 : 1.0 - static_cast<double>(different_) / static_cast<double>(all_);
    std::printf("  %-22s %zu of %zu differ, %.4f %% agree\n", what_.c_str(), different_, all_, 100.0 * share);
    EXPECT_GE(share, kLeastAgreement) << what_;
  }

 private:
  std::string what_;
  std::size_t all_ = 0, different_ = 0;
};

// The bits by Embree alone: its hit, its occlusion, the point in double precision.
unsigned embree_mask(const Comparison& c, const Hit& hit, const Ray& ray) {
  if (!hit.valid()) return 0;
  const SurfaceInteraction surface = surface_at(*c.scene.mesh, hit.triangle, ray.origin, ray.direction);
  const glm::vec3 size = glm::abs(surface.p_world);
  const double largest = static_cast<double>(std::max({size.x, size.y, size.z}));
  const glm::dvec3 point = glm::dvec3(ray.origin) + static_cast<double>(hit.t) * glm::dvec3(ray.direction) +
                           4e-6 * largest * glm::dvec3(surface.n_geometric);
  unsigned bits = 0;
  const std::vector<int> casting = casting_lights(c.scene);
  for (std::size_t slot = 0; slot < casting.size(); ++slot) {
    const Light& light = c.scene.lights[static_cast<std::size_t>(casting[slot])];
    if (!shadow_ray(light_params(light), surface, glm::vec2(0.5f), Terminator::off)) continue;
    const glm::vec3 origin(point);
    if (!c.embree.occluded({origin, 1.0f, light.position - origin})) bits |= 1u << slot;
  }
  return bits;
}

void compare_primary(const Comparison& c) {
  Tally tally("primary hits");
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      EXPECT_EQ(c.ids.at(x, y), c.ours.at(x, y).triangle);
      tally.add(same(c.ours.at(x, y), c.theirs.at(x, y)), x, y,
                [&] { return at_silhouette(c.theirs, x, y); });
    }
  tally.finish();
}

void compare_masks(const Comparison& c) {
  Image<unsigned> theirs(kSize, 0u);
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      theirs.at(x, y) = embree_mask(c, c.theirs.at(x, y), pixel_ray(c.view, x, y));
  Tally tally("shadow mask");
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      tally.add(c.mask.get(x, y) == theirs.at(x, y), x, y,
                [&] { return at_shadow_edge(theirs, x, y) || at_silhouette(c.theirs, x, y); });
  tally.finish();
}

// The mirrored ray of a surface that mirrors.
std::optional<Ray> mirrored_ray(const SurfaceInteraction& s) {
  const glm::vec3 shares = s.material.reflectance + s.material.transmittance;
  if (shares == glm::vec3(0.0f)) return std::nullopt;
  glm::vec3 direction = glm::reflect(-s.to_viewer, s.n_shading);
  if (glm::dot(direction, s.n_geometric) <= 0.0f) direction = glm::reflect(-s.to_viewer, s.n_geometric);
  return Ray{offset_origin(s, direction), kInfinity, direction};
}

void compare_reflections(const Comparison& c) {
  // The first generation's rays, ours; what they hit, both. A pixel without such a ray has a hit at 0.
  Image<Hit> ours(kSize, Hit{0.0f, kNoTriangle}), theirs = ours;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      if (!c.ours.at(x, y).valid()) continue;
      const Ray seen = pixel_ray(c.view, x, y);
      const std::optional<Ray> ray =
          mirrored_ray(surface_at(*c.scene.mesh, c.ours.at(x, y).triangle, seen.origin, seen.direction));
      if (!ray) continue;
      c.tracer.closest_hits({&*ray, 1}, {&ours.at(x, y), 1});
      theirs.at(x, y) = c.embree.closest_hit(*ray);
    }
  Tally tally("first reflection hits");
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x)
      if (ours.at(x, y).t > 0.0f)
        tally.add(same(ours.at(x, y), theirs.at(x, y)), x, y, [&] { return at_silhouette(theirs, x, y); });
  tally.finish();
}

void compare(const Scene& scene) {
  const Comparison comparison(scene);
  compare_primary(comparison);
  compare_masks(comparison);
  compare_reflections(comparison);
}

class EmbreeTest : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EmbreeTest, testing::ValuesIn(own_scenes()),
                         [](const auto& scene) { return "scene" + std::to_string(scene.index); });

TEST_P(EmbreeTest, Agrees) {
  std::printf("  %s\n", GetParam().c_str());
  compare(load_or_die(source_path(GetParam())));
}

TEST(EmbreeBunny, Agrees) {
  const std::optional<std::filesystem::path> path = extra_scene("stanford-bunny.obj");
  if (!path) GTEST_SKIP() << "PINOCCHIO_EXTRA_SCENES is not set: the bunny is not compared";
  Scene scene = load_or_die(*path);
  for (MeshEdit mesh(scene); Material & material : mesh->materials)
    material.reflectance = glm::vec3(0.5f);  // or it has no reflections
  scene.lights = {default_light(scene, camera_for_whole_scene(scene)), point_light({0.3f, 0.5f, 0.2f})};
  compare(scene);
}

}  // namespace
}  // namespace pinocchio
