#include "core/trace/lanes/holes.h"

#include <bit>

#include "core/parallel/tiles.h"
#include "core/shade/mapped_material.h"
#include "core/shade/surface.h"
#include "core/trace/lanes/lane_steps.h"

namespace pinocchio {
namespace {

glm::vec3 at(float* const (&columns)[3], std::size_t i) {
  return {columns[0][i], columns[1][i], columns[2][i]};
}

void append(RayQueue& queue, const glm::vec3& origin, const glm::vec3& direction, std::uint32_t from) {
  const std::size_t i = queue.size++;
  for (int axis = 0; axis < 3; ++axis) {
    queue.origin[axis][i] = origin[axis];
    queue.direction[axis][i] = direction[axis];
  }
  queue.pixel[i] = from;
}

// Others stop every ray.
bool has_alpha(const Mesh& mesh, std::uint32_t triangle) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  return maps && maps->alpha_mode != AlphaMode::opaque;
}

std::uint32_t mixed(std::uint32_t x) {  // Wellons 2018
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return x ^ x >> 16;
}

// The same whatever part of the picture is drawn, and however it is cut in tiles.
float threshold_of(const SamplePlace& place, std::uint32_t pixel, std::uint32_t triangle) {
  if (place.jitter == glm::vec2(0.0f)) return 0.5f;
  const auto mask = static_cast<std::uint32_t>(TileGrid::kTileSize - 1);
  std::uint32_t seed = std::bit_cast<std::uint32_t>(place.jitter.x);
  for (const std::uint32_t part :
       {std::bit_cast<std::uint32_t>(place.jitter.y),
        static_cast<std::uint32_t>(place.corner.x) + (pixel & mask),
        static_cast<std::uint32_t>(place.corner.y) + (pixel >> kTileBits & mask), triangle})
    seed = mixed(seed) + part;
  return static_cast<float>(mixed(seed) >> 8) * 0x1p-24f;
}

}  // namespace

bool passes_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights, const SamplePlace& place,
                 std::uint32_t pixel) {
  return lets_shadow_ray_pass(mesh, triangle, weights, threshold_of(place, pixel, triangle));
}

// Appends ray i of `rays` again, from behind the triangle that it met.
void Holes::go_on(const Tracer& tracer, const RayQueue& rays, std::size_t i, std::uint32_t triangle) {
  const glm::vec3 origin = at(rays.origin, i), direction = at(rays.direction, i);
  const glm::vec3 weights = weights_at(tracer.mesh(), triangle, origin, direction);
  const BareSurface s = bare_surface_at(tracer.mesh(), triangle, direction, weights, tracer.offset());
  append(next_, offset_origin(s, direction), direction, static_cast<std::uint32_t>(i));
}

void Holes::pass(const Tracer& tracer, RayQueue& rays, const PassedBacks* backs) {
  const Mesh& mesh = tracer.mesh();
  // By the ray from its first origin, as surfaces are.
  const auto meets_hole = [&](std::size_t i) {
    return rays.triangle[i] != kNoTriangle && has_alpha(mesh, rays.triangle[i]) &&
           is_hole(mesh, rays.triangle[i],
                   weights_at(mesh, rays.triangle[i], at(rays.origin, i), at(rays.direction, i)));
  };
  next_.make_room(rays.size);
  for (std::size_t i = 0; i < rays.size; ++i)
    if (meets_hole(i)) go_on(tracer, rays, i, rays.triangle[i]);
  for (int layer = 0; next_.size > 0 && layer < kMostLayers; ++layer) {
    std::swap(on_, next_);
    next_.make_room(on_.size);
    tracer.closest_hits(on_.columns(), on_.size, on_.triangle, nullptr, backs);
    for (std::size_t k = 0; k < on_.size; ++k) {
      const std::size_t i = on_.pixel[k];
      rays.triangle[i] = on_.triangle[k];
      if (meets_hole(i)) go_on(tracer, rays, i, rays.triangle[i]);
    }
  }
}

void Holes::shadows(const Tracer& tracer, const RayQueue& rays, float reach, const SamplePlace& place,
                    std::uint8_t* blocked) {
  const Mesh& mesh = tracer.mesh();
  next_.make_room(rays.size);
  for (std::size_t i = 0; i < rays.size; ++i)
    append(next_, at(rays.origin, i), at(rays.direction, i), static_cast<std::uint32_t>(i));
  for (int layer = 0; next_.size > 0 && layer < kMostLayers; ++layer) {
    std::swap(on_, next_);
    next_.make_room(on_.size);
    tracer.closest_hits(on_.columns(reach), on_.size, on_.triangle);
    for (std::size_t k = 0; k < on_.size; ++k) {
      const std::uint32_t from = on_.pixel[k], triangle = on_.triangle[k];
      blocked[from] = 0;
      if (triangle == kNoTriangle) continue;
      if (!has_alpha(mesh, triangle)) {
        blocked[from] = 1;
        continue;
      }
      const glm::vec3 origin = at(on_.origin, k), direction = at(on_.direction, k);
      const glm::vec3 weights = weights_at(mesh, triangle, origin, direction);
      if (!passes_hole(mesh, triangle, weights, place, rays.pixel[from])) {
        blocked[from] = 1;
        continue;
      }
      const BareSurface s = bare_surface_at(mesh, triangle, direction, weights, tracer.offset());
      const glm::vec3 behind = offset_origin(s, direction);
      // A light that has a position stays there, at t = 1.
      append(next_, behind, reach == 1.0f ? origin + direction - behind : direction, from);
    }
  }
}

}  // namespace pinocchio
