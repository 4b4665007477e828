#include "core/reference/reference_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/reference/reference_lobe.h"
#include "core/reference/reference_shading.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The sides of a square of that width at right angles to the ray.
ReferenceSpread spread_of(const ReferenceRay& ray, double width) {
  if (ray.angle == 0.0) return {};
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(ray.direction[axis]) < std::abs(ray.direction[least])) least = axis;
  glm::dvec3 axis(0.0);
  axis[least] = 1.0;
  const glm::dvec3 across = glm::normalize(glm::cross(ray.direction, axis));
  return {ray.direction, width * across, width * glm::normalize(glm::cross(ray.direction, across))};
}

// The share of light that is left after a path through a medium (Beer and Lambert).
glm::dvec3 left_of_light(const Material* medium, double way) {
  if (!medium) return glm::dvec3(1.0);
  return glm::pow(glm::dvec3(medium->attenuation_color), glm::dvec3(way / medium->attenuation_distance));
}

}  // namespace

ReferenceTracer::Cone ReferenceTracer::cone_after(const ReferenceRay& ray, const ReferenceHit& hit) {
  return {ray.width + ray.angle * hit.t * glm::length(ray.direction), ray.angle, ray.of_camera};
}

ReferenceTracer::Pixel ReferenceTracer::pixel(const ReferenceCamera& camera, int x, int y, int depth) const {
  const ReferenceCamera::PixelRay of = camera.pixel(x, y, options_.texture_footprint);
  const ReferenceRay& ray = of.ray;
  const ReferenceHit hit = of.sees() ? closest_hit(ray) : ReferenceHit{};
  Pixel pixel;
  pixel.triangle = hit.triangle;
  if (depth <= 0) depth = -kStraightBeyond;  // nothing is followed
  if (!hit.valid()) {
    pixel.color = glm::vec4(behind(ray));
    return pixel;
  }
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit, of.spread_at(hit.t));
  Media media = media_at(nullptr, hit, surface);
  media.here = medium_of_eye(camera);
  if (media.here && surface.material.ior == 1.0 && !scene_.mesh->material_of(hit.triangle).attenuates())
    media.beyond = media.here;
  const glm::dvec3 way = left_of_light(media.here, hit.t * glm::length(ray.direction));
  const Direct own = direct(surface, media.here, &pixel.mask);
  const glm::dvec3 mirrored = way * (own.tinted + from_sky(surface, media.here) +
                                     bounced(surface, depth, cone_after(ray, hit), media, kLobeSide, 0.0));
  pixel.reflection = glm::vec3(mirrored);
  const double left = options_.background.is_transparent() ? left_behind(ray, hit, depth) : 0.0;
  pixel.color = glm::vec4(glm::vec3(way * own.free + mirrored), as_float(1.0 - left));
  return pixel;
}

glm::dvec4 ReferenceTracer::behind(const ReferenceRay& ray) const {
  glm::dvec3 light(0.0);
  const bool sees = ray.direction != glm::dvec3(0.0);
  if (backdrop_ && sees) light = backdrop_->radiance(ray.direction);
  if (options_.background.kind == Background::Kind::color) light = glm::dvec3(options_.background.color);
  const double lost = options_.catcher_height && sees ? lost_on_ground(ray) : 0.0;
  return {(1.0 - lost) * light, lost};
}

// The share of its light that a white matt plane loses to shadows where the ray meets it from above.
double ReferenceTracer::lost_on_ground(const ReferenceRay& ray) const {
  const auto height = as_double(*options_.catcher_height);
  if (!(ray.direction.y < 0.0 && ray.origin.y > height)) return 0.0;
  const double t = (height - ray.origin.y) / ray.direction.y;
  ReferenceSurface ground{};
  ground.p_world = ray.origin + t * ray.direction;
  ground.p_world.y = height;
  ground.n_geometric = ground.n_shading = ground.n_vertices = glm::dvec3(0.0, 1.0, 0.0);
  ground.to_viewer = -glm::normalize(ray.direction);
  ground.error = 1e-12 * glm::length(ground.p_world);
  ground.material.alpha = 1.0;
  const auto luminance = [](const glm::dvec3& c) { return glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722)); };
  double all = luminance(glm::dvec3(scene_.ambient_light)), lost = 0.0;
  const auto add = [&](const ReferenceLight& point, bool casts) {
    const double cosine = std::max(point.to_light.y, 0.0);
    all += luminance(point.radiance) * cosine;
    if (casts) lost += luminance(point.radiance * (1.0 - arriving(point.shadow, nullptr).all())) * cosine;
  };
  for (const Light& light : scene_.lights)
    for (const ReferenceLight& point : reference_lights(light, ground, options_.terminator))
      add(point, light.casts_shadow);
  if (environment_)
    for (const ReferenceLight& point : reference_sky(*environment_, ground, options_.terminator))
      add(point, true);
  return all > 0.0 ? lost / all : 0.0;
}

double ReferenceTracer::left_behind(ReferenceRay ray, ReferenceHit hit, int depth) const {
  double left = 1.0;
  for (; hit.valid(); --depth) {
    const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit);
    const ReferenceBounce straight = reference_bounces(surface)[2];
    if (straight.weight == glm::dvec3(0.0) || depth <= -kStraightBeyond) return 0.0;
    left *= 1.0 - surface.material.alpha;
    ray = straight.ray;
    ray.of_camera = true;
    hit = closest_hit(ray);
  }
  return left * (1.0 - behind(ray).a);
}

// The surface's light without mirrors and glass. `reached`: becomes whether each casting light reaches the
// point.
ReferenceTracer::Direct ReferenceTracer::direct(const ReferenceSurface& surface, const Material* medium,
                                                std::vector<bool>* reached) const {
  Direct sum;
  sum.free = surface.material.ambient * glm::dvec3(scene_.ambient_light) +
             reference_below_layers(surface) * surface.material.emission;
  for (const Light& light : scene_.lights) {
    double seen = 0.0, all = 0.0;  // sums over the points of a light
    for (const ReferenceLight& point : reference_lights(light, surface, options_.terminator)) {
      const bool hidden = light.casts_shadow && point.way_up && tree_.occluded(*point.way_up);
      Arrival share;
      if (hidden) share.free = 0.0;
      if (light.casts_shadow && !hidden) share = arriving(point.shadow, medium);
      seen += share.free;
      all += 1.0;
      const glm::dvec3 reflected = reference_reflected(surface, point, lobes_ && light.casts_shadow);
      sum.free += share.free * reflected;
      sum.tinted += share.tinted * reflected;
    }
    if (light.casts_shadow && reached) reached->push_back(all > 0.0 && seen >= 0.5 * all);
  }
  return {surface.material.alpha * sum.free, surface.material.alpha * sum.tinted};
}

// The environment's light that the surface reflects.
glm::dvec3 ReferenceTracer::from_sky(const ReferenceSurface& surface, const Material* medium) const {
  glm::dvec3 sum(0.0);
  if (!environment_) return sum;
  for (const ReferenceLight& point : reference_sky(*environment_, surface, options_.terminator)) {
    if (point.way_up && tree_.occluded(*point.way_up)) continue;
    sum += arriving(point.shadow, medium).all() * reference_reflected(surface, point, lobes_);
  }
  return surface.material.alpha * sum;
}

// Ir(R) + It(T), with at most `depth` bounces, and straight on until depth is -kStraightBeyond.
// density: of the direction that the surface is met from.
glm::dvec3 ReferenceTracer::bounced(const ReferenceSurface& surface, int depth, const Cone& cone,
                                    const Media& media, int lobe_side, double density) const {
  glm::dvec3 sum(0.0);
  const bool lobe = lobes_ && surface.material.ggx_alpha > 0.0;
  if (lobe) sum += along_lobe(surface, depth, cone, media, lobe_side, density);
  if (depth <= -kStraightBeyond) return sum;
  const auto follow = [&](const ReferenceBounce& bounce, const Material* medium, int side,
                          bool straight = false, double of_direction = 0.0) {
    ReferenceRay ray = bounce.ray;
    ray.width = cone.width;
    ray.angle = cone.angle;
    ray.of_camera = straight && cone.of_camera;
    sum += bounce.weight * seen(ray, medium, depth - 1, side, of_direction);
  };
  // Samples of the environment go straight on through glass, too.
  const double straight_on = options_.glass_shadows == GlassShadows::tinted ? density : 0.0;
  const std::array<ReferenceBounce, 3> bounces = reference_bounces(surface);
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    if (bounces[i].weight == glm::dvec3(0.0) || (i < 2 && (lobe || depth <= 0))) continue;
    if (i > 0 || surface.material.gloss == 0.0) {
      follow(bounces[i], i == 1 ? media.beyond : media.here, lobe_side, i == 2, i > 0 ? straight_on : 0.0);
    } else {
      for (const ReferenceBounce& ray : reference_lobe(surface, bounces[i], lobe_side))
        follow(ray, media.here, std::max(lobe_side / 4, 1));
    }
  }
  return sum;
}

// The light along directions of the glossy lobe: of lights with a size, and of what rays that way see.
glm::dvec3 ReferenceTracer::along_lobe(const ReferenceSurface& s, int depth, const Cone& cone,
                                       const Media& media, int lobe_side, double density_of_ray) const {
  const ReferenceMaterial& m = s.material;
  const bool glass = m.transmits(), thin = m.ior == 1.0;
  const auto counts = [&](double own, double other) {
    return glass || own == 0.0 ? 1.0 : own / (own + other);
  };
  const auto along = [&](const glm::dvec3& direction, const Material* medium, double density) {
    ReferenceRay ray{leave(s, direction), direction};
    ray.width = cone.width;
    ray.angle = cone.angle;
    if (depth > 0) return seen(ray, medium, depth - 1, std::max(lobe_side / 4, 1), density);
    if (!environment_) return glm::dvec3(0.0);
    return counts(density, environment_->density(direction)) * arriving(ray, medium).all() *
           environment_->radiance(direction);
  };
  const auto found = [&](const ReferenceLobe& lobe) {
    glm::dvec3 light(0.0);
    for (const Light& each : scene_.lights) {
      if (!each.has_size() || !each.casts_shadow) continue;
      if (const auto met = reference_meeting(each, s, lobe.direction))
        light += arriving(met->shadow, media.here).all() * counts(lobe.density, met->density) * met->radiance;
    }
    return light + along(lobe.direction, media.here, glass ? 0.0 : lobe.density);
  };
  glm::dvec3 sum(0.0);
  if (m.layers.coat > 0.0)
    for (const ReferenceLobe& lobe : reference_lobe_samples(s, reference_coat(s), lobe_side))
      sum += lobe.share * reference_coat_share(s) * found(lobe);
  const double below = reference_below_layers(s);
  for (const ReferenceLobe& lobe : reference_lobe_samples(s, reference_base(s), lobe_side)) {
    const double cosine = glm::dot(s.to_viewer, lobe.facet), eta = s.leaving ? 1.0 / m.ior : m.ior;
    glm::dvec3 mirrored = reference_schlick(m, cosine), through(0.0);
    double passed = 0.0;
    if (glass) {
      through = thin ? lobe.direction - 2.0 * glm::dot(s.n_shading, lobe.direction) * s.n_shading
                     : glm::refract(-s.to_viewer, lobe.facet, 1.0 / eta);
      if (glm::dot(through, s.n_geometric) >= 0.0) through = glm::dvec3(0.0);
      const ReferenceGlass at = reference_glass(m, cosine, eta);
      mirrored = through == glm::dvec3(0.0) ? glm::dvec3(1.0) : at.mirrored;
      passed = 1.0 - at.kept;
    }
    sum += lobe.share * below * mirrored * found(lobe);
    if (through != glm::dvec3(0.0) && depth > 0)
      sum +=
          lobe.share * passed * m.transmittance *
          along(through, media.beyond, options_.glass_shadows == GlassShadows::tinted ? density_of_ray : 0.0);
  }
  return m.alpha * sum;
}

// A surface that is hit from behind ends the ray's medium, whichever surface the medium began at. Walls
// without thickness do not refract, and the medium is the same behind them.
ReferenceTracer::Media ReferenceTracer::media_at(const Material* of_ray, const ReferenceHit& hit,
                                                 const ReferenceSurface& surface) const {
  const Material& own = scene_.mesh->material_of(hit.triangle);
  if (!own.attenuates()) return {of_ray, surface.material.ior == 1.0 ? of_ray : nullptr};
  return surface.leaving ? Media{&own, nullptr} : Media{of_ray, &own};
}

glm::dvec3 ReferenceTracer::seen(const ReferenceRay& ray, const Material* medium, int depth, int lobe_side,
                                 double density) const {
  const ReferenceHit hit = closest_hit(ray);
  if (!hit.valid() && ray.of_camera) return glm::dvec3(behind(ray));
  if (!hit.valid()) {
    if (!environment_) return glm::dvec3(0.0);
    const double share = density > 0.0 ? density / (density + environment_->density(ray.direction)) : 1.0;
    return share * environment_->radiance(ray.direction);
  }
  const Cone cone = cone_after(ray, hit);
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit, spread_of(ray, cone.width));
  const Media media = media_at(medium, hit, surface);
  const double way = hit.t * glm::length(ray.direction);
  const Direct own = direct(surface, media.here);
  return left_of_light(media.here, way) * (own.free + own.tinted + from_sky(surface, media.here) +
                                           bounced(surface, depth, cone, media, lobe_side, density));
}

namespace {

// Continues the ray behind the hit, by the hit's error. The ray's end stays.
ReferenceRay continued(const Mesh& mesh, const ReferenceRay& ray, const ReferenceHit& hit) {
  const ReferenceSurface surface = reference_surface(mesh, ray, hit);
  ReferenceRay rest{leave(surface, ray.direction), ray.direction};
  rest.of_camera = ray.of_camera;
  if (std::isinf(ray.t_max)) return rest;
  rest.direction = ray.origin + ray.t_max * ray.direction - rest.origin;
  rest.t_max = 1.0;
  return rest;
}

}  // namespace

// Whether the ray comes from the camera and meets the triangle's back, and its material has one side.
bool ReferenceTracer::passes_back(const ReferenceRay& ray, std::uint32_t triangle) const {
  const std::optional<bool>& double_sided = scene_.mesh->material_of(triangle).double_sided;
  const bool stays = options_.backfaces == Backfaces::draw ||
                     (options_.backfaces == Backfaces::automatic && !double_sided) ||
                     (double_sided && *double_sided);
  if (stays || !ray.of_camera) return false;
  const glm::uvec3& corners = scene_.mesh->triangles[triangle];
  const glm::dvec3 a(scene_.mesh->positions[corners.x]), b(scene_.mesh->positions[corners.y]),
      c(scene_.mesh->positions[corners.z]);
  return glm::dot(glm::cross(b - a, c - a), ray.direction) > 0.0;
}

// The first hit that is not in a hole, nor on a passed back.
ReferenceHit ReferenceTracer::closest_hit(const ReferenceRay& ray) const {
  ReferenceRay rest = ray;
  ReferenceTree::IsPassed is_passed;
  if (ray.of_camera && options_.backfaces != Backfaces::draw)
    is_passed = [&](std::uint32_t triangle) { return passes_back(ray, triangle); };
  for (double passed = 0.0;;) {
    ReferenceHit hit = tree_.closest_hit(rest, is_passed);
    if (!hit.valid()) return hit;
    if (!reference_hole(*scene_.mesh, hit)) {
      hit.t += passed;
      return hit;
    }
    passed += hit.t;
    rest = continued(*scene_.mesh, rest, hit);
  }
}

// The share of light that the surface does not stop: beside what blends, and through glass.
glm::dvec3 ReferenceTracer::passing(const ReferenceSurface& s) const {
  return (1.0 - s.material.alpha) + s.material.alpha * passing_glass(s);
}

// The share of light that glass lets go straight on, by the angle outside.
glm::dvec3 ReferenceTracer::passing_glass(const ReferenceSurface& s) const {
  const ReferenceMaterial& m = s.material;
  if (options_.glass_shadows == GlassShadows::opaque || !m.transmits()) return glm::dvec3(0.0);
  const double cosine = std::clamp(glm::dot(s.n_shading, s.to_viewer), 0.0, 1.0);
  return (1.0 - reference_glass(m, cosine, m.ior).kept) * m.transmittance;
}

ReferenceTracer::Arrival ReferenceTracer::arriving(const ReferenceRay& ray, const Material* medium) const {
  constexpr int kMostSurfaces = 4096;
  const bool ends = !std::isinf(ray.t_max);
  const bool absorbed = ends && medium && options_.glass_shadows == GlassShadows::tinted;
  Arrival arrival{absorbed ? 0.0 : 1.0, glm::dvec3(absorbed ? 1.0 : 0.0)};
  glm::dvec3 of_free(1.0);  // what media leave of the unhindered light, should it meet glass later
  ReferenceRay rest = ray;
  for (int surfaces = 0; surfaces < kMostSurfaces; ++surfaces) {
    const ReferenceHit hit = tree_.closest_hit(rest);
    if (!hit.valid()) {
      if (ends) arrival.tinted *= left_of_light(medium, rest.t_max * glm::length(rest.direction));
      return arrival;
    }
    const ReferenceSurface surface = reference_surface(*scene_.mesh, rest, hit);
    const bool hole = reference_hole(*scene_.mesh, hit);
    const Media media = hole ? Media{medium, medium} : media_at(medium, hit, surface);
    const glm::dvec3 left = left_of_light(media.here, hit.t * glm::length(rest.direction));
    of_free *= left;
    arrival.tinted *= left;
    if (!hole) {
      arrival.tinted = passing(surface) * (arrival.tinted + arrival.free * of_free);
      arrival.free = 0.0;
    }
    if (arrival.all() == glm::dvec3(0.0)) return arrival;
    medium = media.beyond;
    rest = continued(*scene_.mesh, rest, hit);
  }
  return {0.0, glm::dvec3(0.0)};
}

// Three rays from the eye: where it is inside a body, they meet its surface from behind once more than from
// in front. Two have to agree.
const Material* ReferenceTracer::medium_of_eye(const ReferenceCamera& camera) const {
  const std::optional<glm::dvec3> eye = camera.eye();
  if (!absorbs_ || !eye) return nullptr;
  const auto along = [&](const glm::dvec3& direction) -> const Material* {
    std::vector<std::pair<const Material*, int>> depths;
    ReferenceRay ray{*eye, direction};
    for (int surfaces = 0; surfaces < 4096; ++surfaces) {
      const ReferenceHit hit = tree_.closest_hit(ray);
      if (!hit.valid()) return nullptr;
      const Material& m = scene_.mesh->material_of(hit.triangle);
      if (m.transmits() && (m.attenuates() || m.ior != 1.0f)) {
        auto found = std::ranges::find(depths, &m, [](const auto& pair) { return pair.first; });
        if (found == depths.end()) found = depths.insert(found, {&m, 0});
        found->second += reference_surface(*scene_.mesh, ray, hit).leaving ? 1 : -1;
        if (found->second > 0) return m.attenuates() ? &m : nullptr;
      }
      ray = continued(*scene_.mesh, ray, hit);
    }
    return nullptr;
  };
  const Material *const a = along({0.31, 0.87, 0.41}), *const b = along({-0.77, 0.13, 0.53}),
                        *const c = along({0.19, -0.59, -0.71});
  return a == b || a == c ? a : b == c ? b : nullptr;
}

}  // namespace pinocchio
