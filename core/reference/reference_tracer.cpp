#include "core/reference/reference_tracer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/reference/reference_lobe.h"
#include "core/reference/reference_shading.h"

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

ReferenceTracer::Pixel ReferenceTracer::pixel(const shared::ViewParams& view, int x, int y, int depth) const {
  const double footprint = static_cast<double>(options_.texture_footprint);
  ReferenceRay ray = reference_pixel_ray(view, x, y);
  // The angle between parallel rays is 0, which would mean that nothing is averaged.
  const double height = footprint * glm::length(glm::dvec3(view.step_y));
  ray.angle = view.parallel ? std::min(height, 1e-30) : height;
  if (view.parallel) ray.width = height;
  ray.of_camera = true;
  const ReferenceHit hit = closest_hit(ray);
  Pixel pixel;
  pixel.triangle = hit.triangle;
  if (!hit.valid()) {
    pixel.color = glm::vec4(behind(ray));
    return pixel;
  }
  const double side = view.parallel ? footprint : footprint * hit.t;
  ReferenceSpread spread{ray.direction, side * glm::dvec3(view.step_x), side * glm::dvec3(view.step_y)};
  if (footprint == 0.0) spread = {};
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit, spread);
  const glm::dvec3 own = direct(surface, &pixel.mask);
  const glm::dvec3 mirrored = from_sky(surface) + bounced(surface, depth, cone_after(ray, hit),
                                                          media_at(nullptr, hit, surface), kLobeSide);
  pixel.reflection = glm::vec3(mirrored);
  const double left = options_.background.is_transparent() ? left_behind(ray, hit, depth) : 0.0;
  pixel.color = glm::vec4(glm::vec3(own + mirrored), static_cast<float>(1.0 - left));
  return pixel;
}

glm::dvec4 ReferenceTracer::behind(const ReferenceRay& ray) const {
  glm::dvec3 light(0.0);
  if (backdrop_) light = backdrop_->radiance(ray.direction);
  if (options_.background.kind == Background::Kind::color) light = glm::dvec3(options_.background.color);
  const double lost = options_.catcher_height ? lost_on_ground(ray) : 0.0;
  return {(1.0 - lost) * light, lost};
}

// The share of its light that a white matt plane loses to shadows where the ray meets it from above.
double ReferenceTracer::lost_on_ground(const ReferenceRay& ray) const {
  const auto height = static_cast<double>(*options_.catcher_height);
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
    const double light = luminance(point.radiance) * std::max(point.to_light.y, 0.0);
    all += light;
    if (casts) lost += light * (1.0 - unblocked(point.shadow));
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
    if (straight.weight == glm::dvec3(0.0) || depth <= 0) return 0.0;
    left *= 1.0 - surface.material.alpha;
    ray = straight.ray;
    ray.of_camera = true;
    hit = closest_hit(ray);
  }
  return left * (1.0 - behind(ray).a);
}

// The surface's light without mirrors and glass. `reached`: becomes whether each casting light reaches the
// point.
glm::dvec3 ReferenceTracer::direct(const ReferenceSurface& surface, std::vector<bool>* reached) const {
  glm::dvec3 sum = surface.material.ambient * glm::dvec3(scene_.ambient_light) +
                   reference_below_layers(surface) * surface.material.emission;
  for (const Light& light : scene_.lights) {
    double seen = 0.0, all = 0.0;  // sums over the points of a light
    for (const ReferenceLight& point : reference_lights(light, surface, options_.terminator)) {
      const bool hidden = light.casts_shadow && point.way_up && tree_.occluded(*point.way_up);
      const double share = hidden ? 0.0 : light.casts_shadow ? unblocked(point.shadow) : 1.0;
      seen += share;
      all += 1.0;
      sum += share * reference_reflected(surface, point, lobes_ && light.casts_shadow);
    }
    if (light.casts_shadow && reached) reached->push_back(all > 0.0 && seen >= 0.5 * all);
  }
  return surface.material.alpha * sum;
}

// The environment's light that the surface reflects.
glm::dvec3 ReferenceTracer::from_sky(const ReferenceSurface& surface) const {
  glm::dvec3 sum(0.0);
  if (!environment_) return sum;
  for (const ReferenceLight& point : reference_sky(*environment_, surface, options_.terminator)) {
    if (point.way_up && tree_.occluded(*point.way_up)) continue;
    sum += unblocked(point.shadow) * reference_reflected(surface, point, lobes_);
  }
  return surface.material.alpha * sum;
}

// Ir(R) + It(T), with at most `depth` bounces.
glm::dvec3 ReferenceTracer::bounced(const ReferenceSurface& surface, int depth, const Cone& cone,
                                    const Media& media, int lobe_side) const {
  glm::dvec3 sum(0.0);
  const bool lobe = lobes_ && surface.material.ggx_alpha > 0.0;
  if (lobe) sum += along_lobe(surface, depth, cone, media, lobe_side);
  if (depth <= 0) return sum;
  const auto follow = [&](const ReferenceBounce& bounce, const Material* medium, int side,
                          bool straight = false) {
    ReferenceRay ray = bounce.ray;
    ray.width = cone.width;
    ray.angle = cone.angle;
    ray.of_camera = straight && cone.of_camera;
    sum += bounce.weight * seen(ray, medium, depth - 1, side);
  };
  const std::array<ReferenceBounce, 3> bounces = reference_bounces(surface);
  for (std::size_t i = 0; i < bounces.size(); ++i) {
    if (bounces[i].weight == glm::dvec3(0.0) || (lobe && i < 2)) continue;
    if (i > 0 || surface.material.gloss == 0.0) {
      follow(bounces[i], i == 1 ? media.beyond : media.here, lobe_side, i == 2);
    } else {
      for (const ReferenceBounce& ray : reference_lobe(surface, bounces[i], lobe_side))
        follow(ray, media.here, std::max(lobe_side / 4, 1));
    }
  }
  return sum;
}

// The light along directions of the glossy lobe: of lights with a size, and of what rays that way see.
glm::dvec3 ReferenceTracer::along_lobe(const ReferenceSurface& s, int depth, const Cone& cone,
                                       const Media& media, int lobe_side) const {
  const ReferenceMaterial& m = s.material;
  const bool glass = m.transmits(), thin = m.ior == 1.0;
  const auto counts = [&](double own, double other) {
    return glass || own == 0.0 ? 1.0 : own / (own + other);
  };
  const auto along = [&](const glm::dvec3& direction, const Material* medium, double density) {
    ReferenceRay ray{leave(s, direction), direction};
    ray.width = cone.width;
    ray.angle = cone.angle;
    const bool sky = environment_ && !closest_hit(ray).valid();
    const double share = sky ? counts(density, environment_->density(direction)) : 1.0;
    if (depth > 0) return share * seen(ray, medium, depth - 1, std::max(lobe_side / 4, 1));
    return sky ? share * unblocked(ray) * environment_->radiance(direction) : glm::dvec3(0.0);
  };
  const auto found = [&](const ReferenceLobe& lobe) {
    glm::dvec3 light(0.0);
    for (const Light& each : scene_.lights) {
      if (!each.has_size() || !each.casts_shadow) continue;
      if (const auto met = reference_meeting(each, s, lobe.direction))
        light += unblocked(met->shadow) * counts(lobe.density, met->density) * met->radiance;
    }
    return light + along(lobe.direction, media.here, lobe.density);
  };
  glm::dvec3 sum(0.0);
  if (m.coat > 0.0)
    for (const ReferenceLobe& lobe : reference_lobe_samples(s, reference_coat(s), lobe_side))
      sum += lobe.share * reference_coat_share(s) * found(lobe);
  const double below = reference_below_layers(s);
  for (const ReferenceLobe& lobe : reference_lobe_samples(s, reference_base(s), lobe_side)) {
    const double cosine = glm::dot(s.to_viewer, lobe.facet), eta = s.leaving ? 1.0 / m.ior : m.ior;
    glm::dvec3 mirrored = reference_schlick(m, cosine), through(0.0);
    if (glass) {
      through = thin ? lobe.direction - 2.0 * glm::dot(s.n_shading, lobe.direction) * s.n_shading
                     : glm::refract(-s.to_viewer, lobe.facet, 1.0 / eta);
      if (glm::dot(through, s.n_geometric) >= 0.0) through = glm::dvec3(0.0);
      if (through == glm::dvec3(0.0))
        mirrored = glm::dvec3(1.0);
      else if (!thin)
        mirrored = glm::dvec3(reference_fresnel(cosine, eta));
    }
    sum += lobe.share * below * mirrored * found(lobe);
    if (through != glm::dvec3(0.0) && depth > 0)
      sum += lobe.share * (1.0 - std::max({mirrored.x, mirrored.y, mirrored.z})) * m.transmittance *
             along(through, media.beyond, 0.0);
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

glm::dvec3 ReferenceTracer::seen(const ReferenceRay& ray, const Material* medium, int depth,
                                 int lobe_side) const {
  const ReferenceHit hit = closest_hit(ray);
  if (!hit.valid() && ray.of_camera) return glm::dvec3(behind(ray));
  if (!hit.valid()) return environment_ ? environment_->radiance(ray.direction) : glm::dvec3(0.0);
  const Cone cone = cone_after(ray, hit);
  const ReferenceSurface surface = reference_surface(*scene_.mesh, ray, hit, spread_of(ray, cone.width));
  const Media media = media_at(medium, hit, surface);
  const double way = hit.t * glm::length(ray.direction);
  return left_of_light(media.here, way) *
         (direct(surface) + from_sky(surface) + bounced(surface, depth, cone, media, lobe_side));
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

// The share of a light that comes along the ray. In a single sample, surfaces that blend block the light if
// alpha is at least one half. In a mean over samples, they let through the share that they do not cover.
double ReferenceTracer::unblocked(const ReferenceRay& ray) const {
  const bool one_of_many = options_.jitter != glm::vec2(0.0f);
  double share = 1.0;
  for (ReferenceRay rest = ray;;) {
    const ReferenceHit hit = tree_.closest_hit(rest);
    if (!hit.valid()) return share;
    const MaterialMaps* const maps = scene_.mesh->maps_of(hit.triangle);
    if (!maps || maps->alpha_mode == AlphaMode::opaque) return 0.0;
    const double alpha = std::clamp(reference_alpha(*scene_.mesh, hit), 0.0, 1.0);
    if (maps->alpha_mode == AlphaMode::mask ? !reference_hole(*scene_.mesh, hit)
                                            : !one_of_many && alpha >= 0.5)
      return 0.0;
    if (maps->alpha_mode == AlphaMode::blend && one_of_many) share *= 1.0 - alpha;
    if (share == 0.0) return 0.0;
    rest = continued(*scene_.mesh, rest, hit);
  }
}

ReferenceRay reference_pixel_ray(const shared::ViewParams& view, int x, int y) {
  const glm::dvec2 at = glm::dvec2(view.first) + glm::dvec2(x, y);
  const glm::dvec3 eye(view.eye), corner(view.corner),
      to_pixel = at.x * glm::dvec3(view.step_x) + at.y * glm::dvec3(view.step_y);
  if (view.parallel) return {eye + to_pixel, corner};
  return {eye, corner + to_pixel};
}

}  // namespace pinocchio
