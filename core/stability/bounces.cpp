// Mirrors and glass in closed rooms whose light is known: what leaks, or hits its own surface, changes it.
#include <array>
#include <cmath>

#include "core/procedural/mesh_builder.h"
#include "core/stability/count.h"
#include "core/stability/shapes.h"
#include "core/trace/passes.h"
#include "core/trace/view.h"

namespace pinocchio::stability {
namespace {

Material glowing(float light) {
  Material m;
  m.ambient = m.diffuse = glm::vec3(0.0f);
  m.emission = glm::vec3(light);
  return m;
}

Material glass(float ior) {
  Material m = glowing(0.0f);
  m.transmittance = glm::vec3(1.0f);
  m.ior = ior;
  return m;
}

void append(Scene& to, const Scene& from, const Material& material) {
  const auto first = static_cast<std::uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  for (const glm::uvec3& t : from.triangles) to.triangles.push_back(t + first);
  to.materials.push_back(material);
  to.triangle_materials.resize(to.triangles.size(), static_cast<std::uint32_t>(to.materials.size() - 1));
}

struct Drawn {
  Image<std::uint32_t> ids;
  Image<glm::vec3> radiance;
  Tally tally;
};

Drawn draw(const Scene& scene, const Camera& camera, const Method& method, int rays, int depth) {
  const int side = std::max(16, static_cast<int>(std::sqrt(static_cast<float>(rays) / 16.0f)));
  Drawn drawn{Image<std::uint32_t>(glm::ivec2(side)), {}, {}};
  const Tracer tracer = method.tracer(scene);
  Workers one(1);
  const TraceJob job{scene, tracer, one, view_params(camera, drawn.ids.size())};
  const Timed timed(drawn.tally);
  trace_visibility(job, drawn.ids);
  trace_reflection(job, drawn.ids, depth, drawn.radiance);
  return drawn;
}

// Pixels of glass, in a room that glows with 1: all light gets there but what too many bounces hold back, so
// a pixel is 1, or less by at most `lost`.
Tally in_a_furnace(Scene scene, float size, const Method& method, int rays, float lost) {
  append(scene, box(glm::vec3(-8.0f * size), glm::vec3(8.0f * size), 2), glowing(1.0f));
  const Camera camera{"", size * glm::vec3(0.3f, 0.4f, 4.0f), glm::vec3(0.0f), {0, 1, 0}, 35.0f};
  Drawn drawn = draw(scene, camera, method, rays, 24);
  for (std::size_t i = 0; i < drawn.ids.pixels().size(); ++i) {
    if (drawn.ids[i] == kNoTriangle || !scene.material_of(drawn.ids[i]).transmits()) continue;
    ++drawn.tally.trials;
    const float light = drawn.radiance[i].x;
    drawn.tally.failures += light >= 1.0f - lost && light <= 1.0f + 1e-4f ? 0 : 1;  // NaN is a failure
  }
  return drawn.tally;
}

// A ball of water in a ball of glass; small, where an offset of one length for all is no longer small.
Tally glass_in_glass(const Method& method, int rays) {
  Tally tally;
  for (const float size : {1.0f, 0x1p-14f}) {
    Scene scene;
    append(scene, ball(glm::vec3(0.0f), size, 32), glass(1.5f));
    append(scene, ball(glm::vec3(0.0f), 0.6f * size, 32), glass(1.33f / 1.5f));
    tally += in_a_furnace(std::move(scene), size, method, rays / 2, 0.05f);
  }
  return tally;
}

// From inside a block of glass: beyond the critical angle all is mirrored, many times over.
Tally total_reflection(const Method& method, int rays) {
  Tally tally;
  for (const float size : {1.0f, 0x1p-14f}) {
    Scene scene;
    append(scene, box(size * glm::vec3(-1, -0.5f, -0.25f), size * glm::vec3(1, 0.5f, 0.25f), 4), glass(2.0f));
    tally += in_a_furnace(std::move(scene), size, method, rays / 2, 0.05f);
  }
  return tally;
}

// A closed room of perfect mirrors that glow a little: every bounce adds the same, so that every pixel is
// depth times that, if no ray gets out.
Tally mirror_to_mirror(const Method& method, int rays) {
  constexpr int kDepth = 32;
  constexpr float kGlow = 0x1p-6f;
  Material mirror = glowing(kGlow);
  mirror.reflectance = glm::vec3(1.0f);
  Tally tally;
  for (const float size : {1.0f, 0x1p-14f}) {
    Scene scene;
    append(scene, box(-size * glm::vec3(1, 0.5f, 0.5f), size * glm::vec3(1, 0.5f, 0.5f), 8), mirror);
    const Camera camera{"", glm::vec3(0.0f), size * glm::vec3(1.0f, 0.1f, 0.2f), {0, 1, 0}, 90.0f};
    Drawn drawn = draw(scene, camera, method, rays / 2, kDepth);
    for (const glm::vec3& radiance : drawn.radiance.pixels()) {
      ++drawn.tally.trials;
      drawn.tally.failures += radiance.x == kGlow * static_cast<float>(kDepth) ? 0 : 1;
    }
    tally += drawn.tally;
  }
  return tally;
}

constexpr std::array kTroubles{
    Trouble{"glass inside glass", "pixels with light lost or won", glass_in_glass},
    Trouble{"total internal reflection", "pixels with light lost or won", total_reflection},
    Trouble{"mirror against mirror", "pixels whose ray got out", mirror_to_mirror},
};

}  // namespace

std::span<const Trouble> bounce_troubles() {
  return kTroubles;
}

}  // namespace pinocchio::stability
