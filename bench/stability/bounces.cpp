// Mirrors and glass in closed rooms with known light: a ray that leaks or hits its own surface changes it.
#include <array>
#include <cmath>

#include "bench/one_ray/passes.h"
#include "bench/stability/count.h"
#include "bench/stability/shapes.h"
#include "core/reference/reference.h"
#include "core/trace/view/view_params.h"
#include "scenes/generator/paint.h"

namespace pinocchio::stability {
namespace {

Material glass(float ior) {
  Material m = glowing("", glm::vec3(0.0f));
  m.transmittance = glm::vec3(1.0f);
  m.ior = ior;
  return m;
}

void append(MeshData& to, const MeshData& from, const Material& material) {
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
  FailureCount count;
};

Drawn draw(const Scene& scene, const Camera& camera, const Method& method, int rays, int depth) {
  const int side = std::clamp(static_cast<int>(std::sqrt(static_cast<float>(rays) / 16.0f)), 16, 64);
  Drawn drawn{Image<std::uint32_t>(glm::ivec2(side)), {}, {}};
  const Tracer tracer = method.tracer(*scene.mesh);
  Workers one(1);
  const TraceJob job{scene, tracer, one, view_params(camera, drawn.ids.size())};
  const Timed timed(drawn.count);
  trace_visibility(job, drawn.ids);
  trace_reflection(job, drawn.ids, depth, drawn.radiance);
  return drawn;
}

// A room around the object with six sides that glow, each in a colour of its own.
void append_glowing_room(MeshData& mesh, float size) {
  const MeshData room = box(glm::vec3(-8.0f * size), glm::vec3(8.0f * size), 1);
  append(mesh, room, glowing("", glm::vec3(0.2f)));
  const std::size_t first = mesh.triangles.size() - room.triangles.size();
  for (std::uint32_t side = 1; side < 6; ++side) {
    mesh.materials.push_back(glowing("", glm::vec3(0.2f + 0.15f * static_cast<float>(side))));
    for (const std::size_t half : {0, 1})
      mesh.triangle_materials[first + 2 * side + half] =
          static_cast<std::uint32_t>(mesh.materials.size() - 1);
  }
}

// Compares pixels of glass with the reference's. Glass spreads rays that are close together: pixels where the
// reference changes within a thirtieth of a pixel are not compared.
FailureCount against_reference(MeshData mesh, float size, const Method& method, int rays) {
  constexpr int kDepth = 8;
  constexpr float kTolerance = 0.01f, kShift = 0.03f;
  append_glowing_room(mesh, size);
  const Scene scene(std::move(mesh));
  const Camera camera{"", size * glm::vec3(0.3f, 0.4f, 4.0f), glm::vec3(0.0f), {0, 1, 0}, 35.0f};
  Drawn drawn = draw(scene, camera, method, rays, kDepth);
  View view{camera, drawn.ids.size()};
  Workers one(1);
  const Image<glm::vec3> expected = reference_render(scene, view, kDepth, one).reflection;
  view.jitter = glm::vec2(kShift);
  const Image<glm::vec3> beside = reference_render(scene, view, kDepth, one).reflection;
  for (std::size_t i = 0; i < drawn.ids.pixels().size(); ++i) {
    if (drawn.ids[i] == kNoTriangle || !scene.mesh->material_of(drawn.ids[i]).transmits()) continue;
    ++drawn.count.trials;
    const bool same = std::abs(drawn.radiance[i].x - expected[i].x) <= kTolerance;  // false for NaN
    const bool steady = std::abs(beside[i].x - expected[i].x) <= kTolerance;
    drawn.count.excused += !same && !steady ? 1 : 0;
    drawn.count.failures += !same && (steady || !std::isfinite(drawn.radiance[i].x)) ? 1 : 0;
  }
  return drawn.count;
}

// At the usual scale, and at one where a fixed offset is no longer small.
constexpr std::array kSizes{1.0f, 0x1p-14f};

// A ball of water in a ball of glass.
FailureCount glass_in_glass(const Method& method, int rays) {
  FailureCount count;
  for (const float size : kSizes) {
    MeshData mesh;
    append(mesh, ball(glm::vec3(0.0f), size, 32), glass(1.5f));
    append(mesh, ball(glm::vec3(0.0f), 0.6f * size, 32), glass(1.33f / 1.5f));
    count += against_reference(std::move(mesh), size, method, rays / 2);
  }
  return count;
}

// From inside a block of glass: beyond the critical angle there is total reflection, many times.
FailureCount total_reflection(const Method& method, int rays) {
  FailureCount count;
  for (const float size : kSizes) {
    MeshData mesh;
    append(mesh, box(size * glm::vec3(-1, -0.5f, -0.25f), size * glm::vec3(1, 0.5f, 0.25f), 4), glass(2.0f));
    count += against_reference(std::move(mesh), size, method, rays / 2);
  }
  return count;
}

// A closed room with walls that glow a little and absorb nothing: every bounce adds the same light, so that
// every pixel is that light times `bounces` if no ray leaks. `draw` draws its reflection; `error`: of
// rounding.
template <class Draw>
FailureCount even_room(Material wall, int bounces, float error, const Draw& draw) {
  constexpr float kGlow = 0x1p-6f;
  wall.emission = glm::vec3(kGlow);
  FailureCount count;
  for (const float size : kSizes) {
    MeshData mesh;
    append(mesh, box(-size * glm::vec3(1, 0.5f, 0.5f), size * glm::vec3(1, 0.5f, 0.5f), 8), wall);
    const Camera camera{"", glm::vec3(0.0f), size * glm::vec3(1.0f, 0.1f, 0.2f), {0, 1, 0}, 90.0f};
    Drawn drawn = draw(Scene(std::move(mesh)), camera);
    for (const glm::vec3& radiance : drawn.radiance.pixels()) {
      ++drawn.count.trials;
      drawn.count.failures +=
          std::abs(radiance.x / (kGlow * static_cast<float>(bounces)) - 1.0f) <= error ? 0 : 1;
    }
    count += drawn.count;
  }
  return count;
}

FailureCount mirror_to_mirror(const Method& method, int rays) {
  constexpr int kDepth = 32;
  Material mirror = glowing("", glm::vec3(0.0f));
  mirror.reflectance = glm::vec3(1.0f);
  return even_room(mirror, kDepth, 0.0f, [&](const Scene& scene, const Camera& camera) {
    return draw(scene, camera, method, rays / 2, kDepth);
  });
}

// Sampled light, of the environment and of `indirect` bounces between matt surfaces.
Drawn draw_samples(const Scene& scene, const Camera& camera, const Method& method, int rays, int indirect) {
  const int side = std::clamp(static_cast<int>(std::sqrt(static_cast<float>(rays) / 16.0f)), 16, 64);
  Drawn drawn{Image<std::uint32_t>(glm::ivec2(side)), {}, {}};
  const Tracer tracer = method.tracer(*scene.mesh);
  Workers one(1);
  TraceJob job{scene, tracer, one, view_params(camera, drawn.ids.size())};
  job.options.terminator = method.terminator;
  TileOutputs out;
  out.size = drawn.ids.size();
  out.ids = &drawn.ids;
  out.environment_light = true;
  out.indirect = indirect;
  out.reflection = &drawn.radiance;
  const Timed timed(drawn.count);
  trace_tiles(job, out);
  return drawn;
}

constexpr int kMattBounces = 8;

// In a closed room with a bright sky around it nothing is lit. A coarse ball in the room nearly touches the
// walls.
FailureCount sky_outside(const Method& method, int rays) {
  FailureCount count;
  for (const float size : kSizes) {
    MeshData mesh;
    append(mesh, box(glm::vec3(-size), glm::vec3(size), 8), Material{});
    append(mesh, ball(glm::vec3(0.0f), size * (1.0f - 0x1p-7f), 12), Material{});
    Scene scene(std::move(mesh));
    scene.ambient_light = glm::vec3(0.0f);
    scene.environment = std::make_shared<const Environment>(Image<glm::vec3>({8, 4}, glm::vec3(1e4f)));
    const Camera camera{"", size * glm::vec3(0.95f), glm::vec3(0.0f), {0, 1, 0}, 90.0f};
    Drawn drawn = draw_samples(scene, camera, method, rays / 2, kMattBounces);
    for (const glm::vec3& radiance : drawn.radiance.pixels()) {
      ++drawn.count.trials;
      drawn.count.failures += radiance == glm::vec3(0.0f) ? 0 : 1;
    }
    count += drawn.count;
  }
  return count;
}

FailureCount white_room(const Method& method, int rays) {
  Material white = glowing("", glm::vec3(0.0f));
  white.diffuse = glm::vec3(1.0f);
  return even_room(white, kMattBounces, 1e-4f, [&](const Scene& scene, const Camera& camera) {
    return draw_samples(scene, camera, method, rays / 2, kMattBounces);
  });
}

constexpr std::array kBounceCases{
    StressCase{"glass inside glass", "pixels unlike the reference's", glass_in_glass},
    StressCase{"total internal reflection", "pixels unlike the reference's", total_reflection},
    StressCase{"mirror against mirror", "pixels whose ray got out", mirror_to_mirror},
    StressCase{"sky around a closed room", "pixels that are lit", sky_outside},
    StressCase{"white room", "pixels whose ray got out", white_room},
};

}  // namespace

std::span<const StressCase> bounce_cases() {
  return kBounceCases;
}

}  // namespace pinocchio::stability
