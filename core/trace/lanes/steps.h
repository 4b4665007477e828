// Part of walk/kernel.h's files: the steps of lanes/lane_steps.h, included last.
#pragma once

#include <optional>

#include "core/base/prefetch.h"
#include "core/bsp/clear/clear_ways.h"
#include "core/trace/lanes/environment.h"
#include "core/trace/lanes/glass.h"
#include "core/trace/lanes/holes.h"
#include "core/trace/lanes/in_triangle.h"
#include "core/trace/lanes/lobe.h"
#include "core/trace/lanes/maps.h"
#include "core/trace/lanes/sampled.h"
#include "core/trace/lanes/scatter.h"
#include "core/trace/lanes/settled.h"
#include "core/trace/lanes/terminator.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

void camera_rays(const shared::ViewParams& view, glm::ivec2 corner, RayQueue& rays) {
  // Parallel rays differ in their origins, other rays in their directions.
  const Vec first(view.parallel ? view.eye : view.corner), same(view.parallel ? view.corner : view.eye);
  const Vec step_x(view.step_x), step_y(view.step_y);
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Int pixel = Int::load(rays.pixel + i), row = shift_right<kTileBits>(pixel);
    const Float x =
        Float(view.first.x) + to_float(pixel - shift_left<kTileBits>(row) + Int(as_uint32(corner.x)));
    const Float y = Float(view.first.y) + to_float(row + Int(as_uint32(corner.y)));
    put(first + step_x * x + step_y * y, view.parallel ? rays.origin : rays.direction, i);
    put(same, view.parallel ? rays.direction : rays.origin, i);
  }
}

void keep_hits(RayQueue& rays) {
  const Int none(kNoTriangle);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    const Mask in_queue = lanes_from(i, rays.size), hit = in_queue & ~(Int::load(rays.triangle + i) == none);
    if (hit.bits() != 0 && (kept < i || hit.bits() != in_queue.bits())) {
      for (float* const* columns : {rays.origin, rays.direction, rays.light})
        for (int axis = 0; axis < 3; ++axis)
          store_packed(columns[axis] + kept, Float::load(columns[axis] + i), hit);
      store_packed(rays.pixel + kept, Int::load(rays.pixel + i), hit);
      if (rays.width) store_packed(rays.width + kept, Float::load(rays.width + i), hit);
      if (rays.density) store_packed(rays.density + kept, Float::load(rays.density + i), hit);
      if (rays.way) store_packed(rays.way + kept, Float::load(rays.way + i), hit);
      if (rays.medium) store_packed(rays.medium + kept, Int::load(rays.medium + i), hit);
      store_packed(rays.triangle + kept, Int::load(rays.triangle + i), hit);
    }
    kept += as_size(__builtin_popcount(hit.bits()));
  }
  rays.size = kept;
}

// Shadow rays of `lanes` towards a light that casts. They carry `light`.
inline void append_shadow_rays(const BounceLight& from, const LaneSurface& s, const ShadowStarts& starts,
                               const Incident& incident, const Vec& light, Int pixel, Mask lanes,
                               const Bounce& bounce) {
  if (lanes.bits() == 0) return;
  const Vec origin = starts.origins(incident.to_light);
  const bool far = from.params.kind == shared::kLightDirectional;
  const Vec direction = far ? incident.to_light : incident.target - origin;  // the light sits at t = 1
  append_shadow_ray(s, origin, direction, light, pixel, lanes, bounce.shadow[from.queue]);
  starts.append_ways_up(lanes, bounce.shadow[from.queue], bounce.ways_up[from.queue]);
}

// The lanes whose shadow rays need not be traced.
inline Mask with_clear_ways(const BounceLight& light, const LaneSurface& s, const ShadowStarts& starts,
                            Int triangle, Mask lanes) {
  const Float least(kInnerWeight + kWeightError);
  const Mask inside =
      lanes & ~starts.lifted() & (least < s.weights.x) & (least < s.weights.y) & (least < s.weights.z);
  Mask clear = Mask::from_bits(0);
  ClearWays& ways = *light.clear_ways;
  const auto count = [](Mask some) { return as_uint32(__builtin_popcount(some.bits())); };
  for_each_distinct(triangle, inside, [&](std::uint32_t id, Mask same) {
    const ClearWays::Way way = ways.way_of(id, count(same));
    if (way == ClearWays::Way::clear) clear = clear | same;
    if (way != ClearWays::Way::by_part) return;
    for_each_distinct(part_of(s.weights), same, [&](std::uint32_t part, Mask in_part) {
      if (ways.is_part_clear(id, part, count(in_part))) clear = clear | in_part;
    });
  });
  return clear;
}

// The light that comes from one light to the points of a packet.
template <bool kSampled>
[[gnu::always_inline]] inline Incident light_from(const BounceLight& light, const LaneSurface& s,
                                                  const SampledPixel* sampling, std::uint32_t dimension) {
  if constexpr (kSampled)
    if (light.has_size)
      return sampled_light(light.params, s.p_world,
                           sample_2d(*sampling, dimension + shared::kLightDimension + light.index));
  return incident_light(light.params, light.params.position, s.p_world);
}

// An upper bound of what the light adds to the point, in its brightest colour: Phong's terms with the
// highlight at its greatest; what glTF's model returns. Of points without maps, which not every step reads.
inline Float most_light(const LaneMaterial& material, const Incident& incident, const LaneSurface& s,
                        Float lobe) {
  const Float n_dot_l = max(dot(s.n_shading, incident.to_light), Float(0.0f));
  const Float phong = largest(incident.radiance * (material.diffuse * n_dot_l + material.specular));
  const Mask microfacet = Mask::from_bits(material.microfacet & ~material.mapped);
  if (microfacet.bits() == 0) return phong;
  return select(microfacet,
                largest(reflected_light(material, incident, s.n_shading, s.to_viewer, microfacet, lobe)),
                phong);
}

// Lights the points of a packet: appends shadow rays and returns the light that needs none.
template <bool kSampled>
inline Vec light_points(const Bounce& bounce, const Corners& corners, const LaneSurface& s,
                        const LaneMaterial& m, const Vec& throughput, const LaneLobe& lobe,
                        const SampledPixel* sampling, Int triangle, Int pixel, Mask lanes) {
  // With a cutoff, visible points with maps choose their shadow rays by the geometric normal alone.
  const bool cuts = bounce.cuts_light();
  const unsigned mapped = cuts ? m.mapped : 0;
  ShadowStarts starts(bounce.options->terminator, corners, s);
  Vec sum(Float(0.0f)), unshadowed(Float(0.0f));
  if (bounce.adds_ambient) sum = phong_ambient(m, bounce.ambient_light);
  for (std::size_t i = 0; i < bounce.light_count; ++i) {
    const BounceLight& light = bounce.lights[i];
    const Incident incident = light_from<kSampled>(light, s, sampling, bounce.dimension);
    const bool apart = kSampled && bounce.sampled != 0 && light.has_size;
    if (apart && bounce.points) unshadowed = unshadowed + unshadowed_light(light.params, s, m);
    const Float counted = light.slot < 0 ? Float(0.0f) : lobe.counted;  // lobes look for casting lights
    Mask lit = lanes & starts.faces_light(incident.to_light, Mask::from_bits(mapped)) &
               (incident.radiance != Vec(0.0f));
    if (const Mask plain = lit & ~Mask::from_bits(mapped); cuts && light.slot >= 0 && plain.bits() != 0)
      lit = lit & ~(plain & (most_light(m, incident, s, counted) < Float(bounce.options->light_cutoff)));
    if (lit.bits() == 0) continue;
    Vec term(Float(0.0f));
    if (bounce.adds_light || apart || bounce.tints_at_once()) {
      term = reflected_light(m, incident, s.n_shading, s.to_viewer, lit, counted);
      if (mapped != 0) term = select(Float(0.0f) < dot(s.n_shading, incident.to_light), term, Vec(0.0f));
    }
    if (bounce.options->terminator == Terminator::smoothed)
      term = term * terminator_factor(s.n_shading, s.n_geometric, incident.to_light);
    if (apart && light.slot < 0) {
      add_light(throughput * term, lamp_pixel(bounce, pixel), lit, bounce.traced);
      continue;
    }
    if (light.slot < 0) {
      sum = select(lit, sum + term, sum);
      continue;
    }
    const Vec carried = throughput * term;
    if (!bounce.visible) lit = lit & ~(largest(carried) < Float(bounce.options->throughput_cutoff));
    if (light.clear_ways) {
      const Mask clear = with_clear_ways(light, s, starts, triangle, lit);
      append_light(carried, pixel, clear, bounce.clear[light.queue]);
      lit = lit & ~clear;
    }
    // Visible points' rays also set the mask.
    const Int of = apart && !bounce.visible ? lamp_pixel(bounce, pixel) : pixel;
    append_shadow_rays(light, s, starts, incident, carried, of, lit, bounce);
  }
  if constexpr (kSampled)
    if (bounce.points) add_unshadowed(bounce, throughput * unshadowed, pixel, lanes);
  if constexpr (kSampled)
    if (bounce.environment)
      sample_environment(bounce, starts, s, m, throughput, lobe, *sampling, sampled_pixel(bounce, pixel),
                         lanes);
  return sum;
}

// How many rays ahead of a packet its triangles are fetched, and then their corners. On meshes of small
// triangles the step would wait for memory most of its time.
constexpr std::size_t kTrianglesAhead = 96, kCornersAhead = 32;

// Calls fetch(triangle) for a packet of rays from `first` on; once for neighbours that meet the same one.
template <class Fetch>
inline void for_each_ahead(const RayQueue& rays, std::size_t first, Fetch fetch) {
  const std::size_t end = first + kWidth < rays.size ? first + kWidth : rays.size;
  for (std::size_t k = first; k < end; ++k)
    if (k == first || rays.triangle[k] != rays.triangle[k - 1]) fetch(rays.triangle[k]);
}

inline void fetch_triangles(const SceneArrays& scene, const RayQueue& rays, std::size_t first) {
  if (!scene.is_large) return;
  for_each_ahead(rays, first, [&](std::uint32_t triangle) {
    prefetch(scene.triangles + triangle);
    prefetch(scene.triangle_materials + triangle);
  });
}

inline void fetch_corners(const SceneArrays& scene, const RayQueue& rays, std::size_t first) {
  if (!scene.is_large) return;
  for_each_ahead(rays, first, [&](std::uint32_t triangle) {
    const glm::uvec3& corners = scene.triangles[triangle];
    for (const std::uint32_t corner : {corners.x, corners.y, corners.z}) {
      prefetch(scene.positions + corner);
      prefetch(scene.normals + corner);
    }
  });
}

// The widths of the rays' footprints where the rays from i on start, and where they end after `way`.
inline Float width_at_start(const Bounce& bounce, const RayQueue& rays, std::size_t i) {
  if (bounce.footprint->angle <= 0.0f) return Float(0.0f);
  return bounce.visible ? Float(bounce.footprint->start_width) : Float::load(rays.width + i);
}
inline Float width_at_end(const Bounce& bounce, Float start, const Vec& way) {
  if (bounce.footprint->angle <= 0.0f) return Float(0.0f);
  return start + Float(bounce.footprint->angle) * sqrt(dot(way, way));
}

// Of the rays' directions, as add_environment counts them.
inline Float density_of(const Bounce& bounce, const RayQueue& rays, std::size_t i) {
  if (bounce.of_matt) return Float(-1.0f);
  return rays.density ? Float::load(rays.density + i) : Float(0.0f);
}

// The material as the viewer sees it.
inline void view_microfacets(LaneSurface& s, LaneMaterial& m) {
  turn_normals_to_viewer(s, m);
  if (m.layered != 0)
    static_cast<ShadingParams&>(m) = viewed_from(s.to_viewer, s.n_shading, m);
  else
    m.diffuse = viewed_diffuse(s.to_viewer, s.n_shading, m);
}

inline void add_prefiltered_sky(const Bounce& bounce, const LaneSurface& s, const LaneMaterial& m,
                                const Vec& own, Int pixel, Mask lanes) {
  const SkyLight sky =
      light_of_sky(*bounce.prefiltered, s, m, bounce.mirrored != nullptr, bounce.lobes, lanes);
  if (bounce.options->sky_occlusion > 0)
    hide_sky(bounce, s, sky, own, pixel, lanes);
  else
    add_light(own * (sky.matt + sky.mirrored), pixel, lanes, bounce.traced);
}

// kSampled: some light has a size, some mirror is rough, or there is light from all around. Other scenes pay
// nothing for it.
template <bool kSampled>
void bounce_packets(const Bounce& bounce, const RayQueue& rays) {
  const bool colors = bounce.adds_light || bounce.adds_ambient || bounce.environment || bounce.prefiltered ||
                      bounce.diffuse || bounce.sampled != 0 || bounce.points || bounce.tints_at_once() ||
                      bounce.lobes;
  const bool cuts = bounce.cuts_light();
  const bool reads_material = colors || bounce.mirrored || cuts;
  const MapsWanted wanted(
      colors, bounce.mirrored != nullptr, !cuts, bounce.adds_ambient,
      bounce.prefiltered || (bounce.adds_ambient && bounce.ambient_light != glm::vec3(0.0f)));
  const bool reads_maps = bounce.scene.maps && wanted.any();
  for (std::size_t i = 0; i < kTrianglesAhead; i += kWidth) fetch_triangles(bounce.scene, rays, i);
  for (std::size_t i = 0; i < kCornersAhead; i += kWidth) fetch_corners(bounce.scene, rays, i);
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    fetch_triangles(bounce.scene, rays, i + kTrianglesAhead);
    fetch_corners(bounce.scene, rays, i + kCornersAhead);
    const Mask lanes = lanes_from(i, rays.size);
    const Int triangle = Int::load(rays.triangle + i), pixel = Int::load(rays.pixel + i);
    const Corners corners(bounce.scene, triangle, lanes);
    const Vec origin = Vec::load(rays.origin, i), direction = Vec::load(rays.direction, i);
    LaneSurface s = surface_of(corners, origin, direction, bounce.offset);
    LaneMaterial m(bounce.scene, corners.material,
                   reads_material || bounce.scene.maps ? lanes : Mask::from_bits(0));
    if (m.layered != 0) m.coat_normal = s.n_shading;
    s.n_vertices = s.n_shading;
    const Float start_width = width_at_start(bounce, rays, i);
    s.width = width_at_end(bounce, start_width, s.p_world - origin);
    if (reads_maps && m.mapped != 0)
      apply_maps(bounce, corners, triangle, origin, direction, start_width, wanted, s, m);
    Vec throughput = bounce.visible ? Vec(Float(1.0f)) : Vec::load(rays.light, i);
    std::optional<LaneMedia> surrounding;
    if (bounce.attenuates) {
      const Int of_ray = rays.medium ? Int::load(rays.medium + i) : Int(bounce.eye_medium);
      surrounding = media_at(bounce, of_ray, corners.material, s, m.ior, lanes);
      if (bounce.visible) surrounding->here = of_ray;  // the back of an open mesh does not end a medium
      const Vec way = s.p_world - origin;
      throughput = throughput * attenuation(bounce, surrounding->here, sqrt(dot(way, way)), lanes);
      s.medium = surrounding->here;
    }
    if (bounce.tints) s.density = density_of(bounce, rays, i);
    const LaneMedia* const media = surrounding ? &*surrounding : nullptr;
    const Vec own = m.blends != 0 ? throughput * m.alpha : throughput;
    std::optional<SampledPixel> sampling;
    if constexpr (kSampled)
      sampling = sampled_pixel(bounce.options->sampling, whole_picture_pixel(bounce, pixel));
    const SampledPixel* const samples = kSampled ? &*sampling : nullptr;
    LaneLobe lobe;
    // Without colours, shadow rays of mapped points are chosen without the material.
    if (m.microfacet != 0 &&
        (colors || !cuts || (m.reflects | m.transmits | (m.microfacet & ~m.mapped)) != 0)) {
      view_microfacets(s, m);
      if constexpr (kSampled)
        if (bounce.lobes) lobe = sample_lobe(s, m, own, *samples, lanes, bounce);
    }
    if constexpr (kSampled)
      if (bounce.points && !bounce.lights_alone) {
        s.way = length(s.p_world - origin);
        if (rays.way) s.way = Float::load(rays.way + i) + s.way;
        add_points(bounce, s, m, throughput, pixel, lanes);
      }
    const Vec certain =
        light_points<kSampled>(bounce, corners, s, m, own, lobe, samples, triangle, pixel, lanes);
    if (bounce.adds_light) add_light(own * certain, rays.pixel + i, lanes, bounce.radiance);
    if (bounce.prefiltered) add_prefiltered_sky(bounce, s, m, own, pixel, lanes);
    if constexpr (kSampled)
      if (lobe.lanes.bits() != 0) {
        const Int of_lobe = lobe_pixel(bounce, lobe, pixel);
        light_along_lobe(bounce, s, lobe, own, select(lobe.rough, lamp_pixel(bounce, pixel), pixel));
        if (bounce.environment && !bounce.mirrored) sky_along_lobe(bounce, s, lobe, own, of_lobe);
      }
    if (bounce.straight && (m.blends & lanes.bits()) != 0)
      go_straight_on(s, m, throughput, pixel, lanes, bounce, media);
    if (bounce.mirrored) scatter<kSampled>(s, m, throughput, lobe, samples, pixel, lanes, bounce, media);
    if constexpr (kSampled)
      if (bounce.diffuse)
        scatter_diffuse(bounce, s, m, own, *samples, sampled_pixel(bounce, pixel), lanes, media);
  }
}

void bounce_rays(const Bounce& bounce, const RayQueue& rays) {
  bounce.samples ? bounce_packets<true>(bounce, rays) : bounce_packets<false>(bounce, rays);
}

void visible_points(const Bounce& bounce, const glm::vec3& axis, const RayQueue& rays,
                    const SeenColumns& to) {
  const bool reads_material = to.albedo[0] != nullptr;
  const MapsWanted wanted =
      reads_material ? MapsWanted(true, false, true, false, false) : MapsWanted::normals();
  const bool by_distance = axis == glm::vec3(0.0f);
  for (std::size_t i = 0; i < rays.size; i += kWidth) {
    fetch_triangles(bounce.scene, rays, i + kTrianglesAhead);
    fetch_corners(bounce.scene, rays, i + kCornersAhead);
    const Mask lanes = lanes_from(i, rays.size);
    const Int triangle = Int::load(rays.triangle + i);
    const Corners corners(bounce.scene, triangle, lanes);
    const Vec origin = Vec::load(rays.origin, i), direction = Vec::load(rays.direction, i);
    LaneSurface s = surface_of(corners, origin, direction, bounce.offset);
    LaneMaterial m(bounce.scene, corners.material,
                   reads_material || bounce.scene.maps ? lanes : Mask::from_bits(0));
    if (m.mapped != 0) apply_maps(bounce, corners, triangle, origin, direction, Float(0.0f), wanted, s, m);
    if (to.depth) {
      const Vec way = s.p_world - origin;
      (by_distance ? sqrt(dot(way, way)) : dot(way, Vec(axis))).store(to.depth + i);
    }
    if (to.position[0]) put(s.p_world, to.position, i);
    if (to.normal[0]) put(s.n_shading, to.normal, i);
    // glTF's base colour; of Phong's materials the matt part.
    if (to.albedo[0]) put(select(Mask::from_bits(m.microfacet), m.ambient, m.diffuse), to.albedo, i);
  }
}

}  // namespace

const LaneSteps kSteps{camera_rays, keep_hits,   find_settled,   find_holes,      lanes_in_holes,  go_behind,
                       cross_glass, bounce_rays, visible_points, add_environment, paint_background};

}  // namespace pinocchio::PINOCCHIO_LANES
