#include "core/reference/reference_shading.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/reference/reference_lobe.h"
#include "pinocchio/conversion.h"

namespace pinocchio {

double reference_cone_share(const Light& light, const glm::dvec3& to_light) {
  const double cos_angle = -glm::dot(to_light, glm::dvec3(light.direction));
  const double outer = light.cos_outer, width = light.cos_inner - outer;
  return square(std::clamp((cos_angle - outer) / std::max(width, 1e-6), 0.0, 1.0));
}

double reference_fresnel(double cos_in, double eta) {
  const double sin2_out = (1.0 - square(cos_in)) / square(eta);  // Snell
  if (sin2_out >= 1.0) return 1.0;
  const double cos_out = std::sqrt(1.0 - sin2_out);
  const double parallel = (eta * cos_in - cos_out) / (eta * cos_in + cos_out);
  const double perpendicular = (cos_in - eta * cos_out) / (cos_in + eta * cos_out);
  return 0.5 * (square(parallel) + square(perpendicular));
}

ReferenceGlass reference_glass(const ReferenceMaterial& m, double cos_in, double eta) {
  const double fresnel = reference_fresnel(cos_in, eta);
  if (m.ggx_alpha <= 0.0) return {glm::dvec3(fresnel), fresnel};
  // How far the angle is on the way from F0 to F90. Thin walls: Schlick's formula.
  const double f0 = square((m.ior - 1.0) / (m.ior + 1.0));
  const double rise = m.ior == 1.0 ? std::pow(1.0 - std::clamp(cos_in, 0.0, 1.0), 5.0)
                                   : std::max(fresnel - f0, 0.0) / std::max(1.0 - f0, 1e-6);
  return {(1.0 - rise) * m.specular + rise * m.grazing, (1.0 - rise) * m.layer.x + rise * m.layer.y};
}

namespace {

constexpr double kLeastSquare = 1e-24;  // shaders/shared/phong.glsl

// Chiang, Li and Burley 2019: the light falls to zero as the facet turns away.
double smoothing_at(const ReferenceSurface& s, const glm::dvec3& to_light) {
  const double g = std::min(1.0, glm::dot(s.n_geometric, to_light) / (glm::dot(s.n_shading, to_light) *
                                                                      glm::dot(s.n_shading, s.n_geometric)));
  return -g * g * g + g * g + g;
}

// Mirrors about the shading normal, or about the geometric normal if the ray would enter the surface.
glm::dvec3 mirrored(const ReferenceSurface& s) {
  const auto about = [&s](const glm::dvec3& n) { return 2.0 * glm::dot(n, s.to_viewer) * n - s.to_viewer; };
  const glm::dvec3 direction = about(s.n_shading);
  return glm::dot(direction, s.n_geometric) > 0.0 ? direction : about(s.n_geometric);
}

// Refracts, also without entering the wrong side of the surface. Zero: total reflection.
glm::dvec3 refracted(const ReferenceSurface& s, double eta) {
  const auto through = [&](const glm::dvec3& n) {
    const double cos_in = glm::dot(n, s.to_viewer);
    const double cos2_out = 1.0 - (1.0 - square(cos_in)) / square(eta);
    if (cos2_out < 0.0) return glm::dvec3(0.0);
    return (cos_in * n - s.to_viewer) / eta - std::sqrt(cos2_out) * n;
  };
  const glm::dvec3 direction = through(s.n_shading);
  return glm::dot(direction, s.n_geometric) < 0.0 ? direction : through(s.n_geometric);
}

ReferenceBounce bounce(const ReferenceSurface& s, const glm::dvec3& direction, const glm::dvec3& weight) {
  if (direction == glm::dvec3(0.0)) return {};
  return {weight, {leave(s, direction), direction}};
}

}  // namespace

namespace {

// The light from a point of the lamp (null: infinitely far away) that arrives with `radiance`. Empty if the
// radiance is zero or the surface faces away.
void add_point(const ReferenceSurface& surface, const glm::dvec3& to_light, const glm::dvec3& radiance,
               const glm::dvec3* point, double density, Terminator terminator,
               std::vector<ReferenceLight>& out) {
  if (radiance == glm::dvec3(0.0) || glm::dot(surface.n_shading, to_light) <= 0.0) return;
  const bool turned_away = glm::dot(surface.n_geometric, to_light) <= 0.0;
  const bool can_lift = lifts(terminator) && surface.lift != glm::dvec3(0.0);
  if (turned_away && !(can_lift && glm::dot(surface.n_vertices, to_light) > 0.0)) return;
  const bool lifted = can_lift && (turned_away || terminator == Terminator::displaced);
  const glm::dvec3 origin = lifted ? leave_lifted(surface) : leave(surface, to_light);
  const double share = terminator == Terminator::smoothed ? smoothing_at(surface, to_light) : 1.0;
  out.push_back({to_light, share * radiance,
                 point ? ReferenceRay{origin, *point - origin, 1.0} : ReferenceRay{origin, to_light},
                 std::nullopt, density});
  if (!lifted || terminator != Terminator::turned_away) return;
  const glm::dvec3 from = leave(surface, surface.n_geometric);
  out.back().way_up = ReferenceRay{from, origin - from, 1.0};
}

}  // namespace

void reference_cells(int side, const glm::dvec3& place, const std::function<void(const glm::dvec2&)>& use) {
  std::seed_seq seed{std::hash<double>()(place.x), std::hash<double>()(place.y),
                     std::hash<double>()(place.z)};
  std::minstd_rand random(seed);
  std::uniform_real_distribution<double> within(0.0, 1.0);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double v = within(random), u = within(random);  // in this order on every machine
      use(glm::dvec2(x + u, y + v) / as_double(side));
    }
}

glm::dvec3 reference_beside(const glm::dvec3& axis, double cosine, double turn) {
  const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(axis, other)), u = glm::cross(axis, t);
  const double sine = std::sqrt(std::max(1.0 - square(cosine), 0.0)), phi = 2.0 * std::numbers::pi * turn;
  return sine * (std::cos(phi) * t + std::sin(phi) * u) + cosine * axis;
}

namespace {

// KHR_lights_punctual: light fades to nothing at its range.
double window(const Light& light, double distance) {
  return std::max(1.0 - std::pow(distance / light.range, 4.0), 0.0);
}

// Samples the solid angle of a sphere with constant radiance I / (pi r^2), or of a disc at infinity.
std::vector<ReferenceLight> round_light(const Light& light, const ReferenceSurface& surface,
                                        const glm::dvec3& strength, Terminator terminator) {
  constexpr double kShare = 1.0 / (kReferencePoints * kReferencePoints);
  std::vector<ReferenceLight> points;
  const bool directional = light.kind == Light::Kind::directional;
  const double r = light.radius;
  const glm::dvec3 offset =
      directional ? -glm::dvec3(light.direction) : glm::dvec3(light.position) - surface.p_world;
  const double distance = glm::length(offset);
  if (!directional && distance > light.range) return points;
  const bool inside = !directional && distance <= r;
  const double sine =
      directional ? std::sin(glm::radians(0.5 * light.angle_deg)) : (inside ? 1.0 : r / distance);
  const double least = inside ? -1.0 : std::sqrt(1.0 - square(sine));  // cosine at the rim
  const glm::dvec3 axis = distance > 0.0 ? offset / distance : glm::dvec3(0, 1, 0);
  // Radiance times solid angle. A light without falloff is treated as if at distance 1.
  double solid = 2.0 * std::numbers::pi * (1.0 - least) / (std::numbers::pi * square(sine));
  if (light.falloff == Light::Falloff::inverse_square && !directional)
    solid *= window(light, distance) / std::max(std::max(square(distance), square(r)), kLeastSquare);
  reference_cells(kReferencePoints, surface.p_world, [&](const glm::dvec2& cell) {
    const glm::dvec3 to_light = reference_beside(axis, 1.0 - cell.x * (1.0 - least), cell.y);
    const double along = glm::dot(to_light, offset);
    const double chord = std::sqrt(std::max(square(along) - square(distance) + square(r), 0.0));
    const double cone = light.kind == Light::Kind::spot ? reference_cone_share(light, to_light) : 1.0;
    const glm::dvec3 point = surface.p_world + (inside ? along + chord : along - chord) * to_light;
    add_point(surface, to_light, kShare * solid * cone * strength, directional ? nullptr : &point,
              1.0 / (2.0 * std::numbers::pi * (1.0 - least)), terminator, points);
  });
  return points;
}

std::vector<ReferenceLight> rectangle_light(const Light& light, const ReferenceSurface& surface,
                                            const glm::dvec3& strength, Terminator terminator) {
  constexpr double kShare = 1.0 / (kReferencePoints * kReferencePoints);
  std::vector<ReferenceLight> points;
  reference_cells(kReferencePoints, surface.p_world, [&](const glm::dvec2& cell) {
    const glm::dvec3 point = glm::dvec3(light.position) + (cell.x - 0.5) * glm::dvec3(light.edge_u) +
                             (cell.y - 0.5) * glm::dvec3(light.edge_v);
    const glm::dvec3 offset = point - surface.p_world;
    const double distance = glm::length(offset);
    if (distance == 0.0 || distance > light.range) return;
    const glm::dvec3 to_light = offset / distance;
    double share = kShare * std::max(-glm::dot(to_light, glm::dvec3(light.direction)), 0.0);
    if (light.falloff == Light::Falloff::inverse_square)
      share *= window(light, distance) / std::max(square(distance), kLeastSquare);
    const double facing = -glm::dot(to_light, glm::dvec3(light.direction));
    const double area = glm::length(glm::cross(glm::dvec3(light.edge_u), glm::dvec3(light.edge_v)));
    add_point(surface, to_light, share * strength, &point,
              facing > 0.0 ? square(distance) / (facing * area) : 0.0, terminator, points);
  });
  return points;
}

}  // namespace

std::vector<ReferenceLight> reference_lights(const Light& light, const ReferenceSurface& surface,
                                             Terminator terminator) {
  glm::dvec3 radiance = glm::dvec3(light.color) * as_double(light.intensity);
  if (light.kind == Light::Kind::rectangle) return rectangle_light(light, surface, radiance, terminator);
  if (light.has_size()) return round_light(light, surface, radiance, terminator);
  std::vector<ReferenceLight> point;
  if (light.kind == Light::Kind::directional) {
    add_point(surface, -glm::dvec3(light.direction), radiance, nullptr, 0.0, terminator, point);
    return point;
  }
  const glm::dvec3 position(light.position), offset = position - surface.p_world;
  const double distance = glm::length(offset);
  if (distance == 0.0 || distance > light.range) return point;
  const glm::dvec3 to_light = offset / distance;
  if (light.falloff == Light::Falloff::inverse_square)
    radiance *= window(light, distance) / std::max(square(distance), kLeastSquare);
  if (light.kind == Light::Kind::spot) radiance *= reference_cone_share(light, to_light);
  add_point(surface, to_light, radiance, &position, 0.0, terminator, point);
  return point;
}

std::optional<ReferenceMeeting> reference_meeting(const Light& light, const ReferenceSurface& s,
                                                  const glm::dvec3& direction) {
  const glm::dvec3 strength = glm::dvec3(light.color) * as_double(light.intensity);
  const glm::dvec3 origin = leave(s, direction);
  if (light.kind == Light::Kind::directional) {
    const double least = std::cos(glm::radians(0.5 * light.angle_deg));
    if (glm::dot(direction, -glm::dvec3(light.direction)) < least) return {};
    const double radiance = 1.0 / (std::numbers::pi * (1.0 - square(least)));
    return ReferenceMeeting{
        radiance * strength, 1.0 / (2.0 * std::numbers::pi * (1.0 - least)), {origin, direction}};
  }
  const glm::dvec3 offset = glm::dvec3(light.position) - s.p_world;
  const auto up_to = [&](double t) { return ReferenceRay{origin, s.p_world + t * direction - origin, 1.0}; };
  const bool falls = light.falloff == Light::Falloff::inverse_square;
  if (light.kind == Light::Kind::rectangle) {
    const glm::dvec3 u(light.edge_u), v(light.edge_v), n(light.direction);
    const double towards = -glm::dot(direction, n), t = -glm::dot(offset, n) / towards;
    if (towards <= 0.0 || t <= 0.0 || t > light.range) return {};
    const glm::dvec3 at = t * direction - offset, normal = glm::cross(u, v);
    const double area2 = glm::dot(normal, normal);
    if (std::abs(glm::dot(glm::cross(at, v), normal)) > 0.5 * area2 ||
        std::abs(glm::dot(glm::cross(u, at), normal)) > 0.5 * area2)
      return {};
    const double density = square(t) / (towards * std::sqrt(area2));
    const double share = towards * (falls ? window(light, t) / std::max(square(t), kLeastSquare) : 1.0);
    return ReferenceMeeting{share * density * strength, density, up_to(t)};
  }
  const double distance2 = glm::dot(offset, offset), r = light.radius, along = glm::dot(direction, offset);
  const double chord2 = square(along) - distance2 + square(r);
  const bool inside = distance2 <= square(r);
  if (chord2 <= 0.0 || (!inside && along <= 0.0) || std::sqrt(distance2) > light.range) return {};
  const double least = inside ? -1.0 : std::sqrt(1.0 - square(r) / distance2);
  // Radiance I / (pi r^2); a light without falloff is treated as if at distance 1.
  const double own_square = inside ? 1.0 : square(r) / distance2;
  double radiance = 1.0 / (std::numbers::pi * own_square);
  if (falls)
    radiance *= window(light, std::sqrt(distance2)) / std::max(std::max(distance2, square(r)), kLeastSquare);
  if (light.kind == Light::Kind::spot) radiance *= reference_cone_share(light, direction);
  return ReferenceMeeting{radiance * strength, 1.0 / (2.0 * std::numbers::pi * (1.0 - least)),
                          up_to(inside ? along + std::sqrt(chord2) : along - std::sqrt(chord2))};
}

std::vector<ReferenceLight> reference_sky(const ReferenceEnvironment& environment,
                                          const ReferenceSurface& surface, Terminator terminator) {
  const double share =
      (surface.material.brdf ? 1.0 : std::numbers::inv_pi) / (kReferencePoints * kReferencePoints);
  std::vector<ReferenceLight> points;
  reference_cells(kReferencePoints, surface.p_world, [&](const glm::dvec2& cell) {
    const ReferenceEnvironment::Sample from = environment.sample(cell);
    add_point(surface, from.direction, share * from.light, nullptr, from.density, terminator, points);
  });
  return points;
}

std::vector<ReferenceBounce> reference_lobe(const ReferenceSurface& s, const ReferenceBounce& mirrored,
                                            int side) {
  std::vector<ReferenceBounce> rays;
  const glm::dvec3 axis = glm::normalize(mirrored.ray.direction),
                   weight = mirrored.weight / as_double(side * side);
  reference_cells(side, s.p_world, [&](const glm::dvec2& cell) {
    // The integral of (n + 1) / (2 pi) cos^n up to an angle is 1 - cos^(n + 1).
    const glm::dvec3 direction =
        reference_beside(axis, std::pow(1.0 - cell.x, 1.0 / (s.material.gloss + 1.0)), cell.y);
    if (glm::dot(direction, s.n_geometric) > 0.0) rays.push_back(bounce(s, direction, weight));
  });
  return rays;
}

glm::dvec3 reference_reflected(const ReferenceSurface& s, const ReferenceLight& light, bool lobes) {
  const double n_dot_l = glm::dot(s.n_shading, light.to_light);
  if (s.material.ggx_alpha > 0.0) {
    const bool sized = light.density > 0.0;
    const auto mirrored = [&](ReferenceFacets facets) {
      facets.alpha = std::max(facets.alpha, sized ? 0.0005 : 0.007);
      const double all = reference_mirrored(s, facets, light.to_light);
      if (!sized || !lobes) return all;
      if (s.material.transmits()) return 0.0;
      return all * light.density / (light.density + reference_lobe_density(s, facets, light.to_light));
    };
    const double v_dot_h = glm::dot(s.to_viewer, glm::normalize(s.to_viewer + light.to_light));
    glm::dvec3 share =
        reference_below_layers(s) * (n_dot_l * reference_matt(s, light.to_light) +
                                     mirrored(reference_base(s)) * reference_schlick(s.material, v_dot_h)) +
        reference_sheen(s, light.to_light);
    if (s.material.layers.coat > 0.0) share += reference_coat_share(s) * mirrored(reference_coat(s));
    return light.radiance * share;
  }
  const double r_dot_v = glm::dot(2.0 * n_dot_l * s.n_shading - light.to_light, s.to_viewer);
  const double highlight = r_dot_v > 0.0 ? std::pow(r_dot_v, s.material.shininess) : 0.0;
  return light.radiance * (s.material.diffuse * n_dot_l + s.material.specular * highlight);
}

std::array<ReferenceBounce, 3> reference_bounces(const ReferenceSurface& s) {
  const ReferenceMaterial& m = s.material;
  const double cos_in = std::clamp(glm::dot(s.n_shading, s.to_viewer), 0.0, 1.0), own = m.alpha;
  const ReferenceBounce straight =
      own < 1.0 ? bounce(s, -s.to_viewer, glm::dvec3(1.0 - own)) : ReferenceBounce{};
  if (m.transmits()) {
    const double ior = m.ior, eta = s.leaving ? 1.0 / ior : ior;
    const glm::dvec3 through = refracted(s, eta);
    // If the two normals disagree, there may be no refracted ray although Fresnel's share is not zero.
    const ReferenceGlass glass =
        through == glm::dvec3(0.0) ? ReferenceGlass{glm::dvec3(1.0), 1.0} : reference_glass(m, cos_in, eta);
    return {bounce(s, mirrored(s), own * glass.mirrored),
            bounce(s, through, own * (1.0 - glass.kept) * m.transmittance), straight};
  }
  if (!m.reflects()) return {ReferenceBounce{}, ReferenceBounce{}, straight};
  // Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994.
  const double grazing = m.fresnel ? std::pow(1.0 - cos_in, 5.0) : 0.0;
  const glm::dvec3 share = m.reflectance + (1.0 - m.reflectance) * grazing;
  return {bounce(s, mirrored(s), own * share), ReferenceBounce{}, straight};
}

}  // namespace pinocchio
