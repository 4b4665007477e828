// Part of trace/kernel.h's files: shaders/shared/phong.glsl in lanes.
#pragma once

#include "core/trace/lanes/material.h"
#include "core/trace/lanes/power.h"
#include "core/trace/lanes/surface.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct LaneIncident {
  Vec to_light;  // unit
  Vec radiance;  // zero: the light does not reach this far or this way
  Vec target;    // of shadow rays
};

inline Float cone_share(const shared::LightParams& light, const Vec& to_light) {
  const Float cos_angle = dot(-to_light, Vec(light.direction));
  const float width = light.cos_inner - light.cos_outer;
  const Float cone =
      clamp((cos_angle - Float(light.cos_outer)) / Float(width < 1e-6f ? 1e-6f : width), 0.0f, 1.0f);
  return cone * cone;
}

[[gnu::always_inline]] inline LaneIncident incident_light(const shared::LightParams& light,
                                                          const Vec& position, const Vec& p_world) {
  LaneIncident result;
  result.radiance = Vec(light.radiance);
  result.target = position;
  if (light.kind == shared::kLightDirectional) {
    result.to_light = -Vec(light.direction);
    return result;
  }
  const Float zero(0.0f);
  const Vec offset = position - p_world;
  const Float distance = sqrt(dot(offset, offset));
  result.to_light = select(zero < distance, offset / distance, Vec(zero, Float(1.0f), zero));
  result.radiance = select(Float(light.range) < distance, Vec(zero), result.radiance);
  if (light.inverse_square) result.radiance = result.radiance / max(Float(1e-12f), distance * distance);
  if (light.kind == shared::kLightSpot)
    result.radiance = result.radiance * cone_share(light, result.to_light);
  if (light.kind == shared::kLightRectangle)
    result.radiance = result.radiance * max(dot(-result.to_light, Vec(light.direction)), zero);
  return result;
}

// The light is on the side of the surface that the viewer sees.
inline Mask faces_light(const LaneSurface& s, const Vec& to_light) {
  const Float zero(0.0f);
  return (zero < dot(s.n_shading, to_light)) & (zero < dot(s.n_geometric, to_light));
}

inline Mask is_dark(const Vec& radiance) {
  const Float zero(0.0f);
  return (radiance.x == zero) & (radiance.y == zero) & (radiance.z == zero);
}

// Id + Is for `lanes`, which face the light.
[[gnu::always_inline]] inline Vec phong_light(const LaneMaterial& material, const LaneIncident& incident,
                                              const LaneSurface& s, Mask lanes) {
  const Float zero(0.0f);
  const Float n_dot_l = dot(s.n_shading, incident.to_light);
  Vec sum = material.diffuse * n_dot_l;
  if ((lanes & ~is_dark(material.specular)).bits() != 0) {
    const Vec mirrored = s.n_shading * (Float(2.0f) * n_dot_l) - incident.to_light;
    const Float r_dot_v = dot(mirrored, s.to_viewer);
    const Mask shines = zero < r_dot_v;
    const Float highlight =
        select(shines, power(select(shines, r_dot_v, Float(1.0f)), material.shininess), zero);
    sum = sum + material.specular * highlight;
  }
  return incident.radiance * sum;
}

// No less than what the light brings the point, in its brightest colour: Phong's terms with cosine and
// highlight at their greatest.
inline Float most_light(const LaneMaterial& material, const LaneIncident& incident, const LaneSurface& s) {
  const Float n_dot_l = max(dot(s.n_shading, incident.to_light), Float(0.0f));
  return largest(incident.radiance * (material.diffuse * n_dot_l + material.specular));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
