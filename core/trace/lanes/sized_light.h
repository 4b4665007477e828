// Part of trace/kernel.h's files: shaders/shared/sized_light.glsl in lanes.
#pragma once

#include "core/trace/lanes/light.h"
#include "core/trace/lanes/sampling.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline LanePoint disc_of_square(const LanePoint& square) {
  const Float one(1.0f), zero(0.0f);
  const Float x = Float(2.0f) * square.x - one, y = Float(2.0f) * square.y - one;
  const Mask wide = abs(y) < abs(x);
  const Float radius = select(wide, x, y), other = select(wide, y, x);
  const Float a = select(radius == zero, zero, Float(shared::kPiByFour) * (other / radius));
  const Float a2 = a * a;
  const Float sine =
      a * (one + a2 * (Float(-1.0f / 6.0f) + a2 * (Float(1.0f / 120.0f) + a2 * Float(-1.0f / 5040.0f))));
  const Float cosine =
      one + a2 * (Float(-0.5f) +
                  a2 * (Float(1.0f / 24.0f) + a2 * (Float(-1.0f / 720.0f) + a2 * Float(1.0f / 40320.0f))));
  return {radius * select(wide, cosine, sine), radius * select(wide, sine, cosine)};
}

inline Vec around(const Vec& axis, const Vec& local) {
  const Float one(1.0f), side = select(axis.z < Float(0.0f), Float(-1.0f), one);
  const Float a = Float(-1.0f) / (side + axis.z), b = axis.x * axis.y * a;
  const Vec t(one + side * axis.x * axis.x * a, side * b, -side * axis.x);
  const Vec u(b, side + axis.y * axis.y * a, -axis.y);
  return t * local.x + u * local.y + axis * local.z;
}

inline Vec direction_in_cone(const Vec& axis, Float one_minus_cos, const LanePoint& disc) {
  const Float down = (disc.x * disc.x + disc.y * disc.y) * one_minus_cos;
  const Float across = sqrt(one_minus_cos * max(Float(2.0f) - down, Float(0.0f)));
  return around(axis, {disc.x * across, disc.y * across, Float(1.0f) - down});
}

inline LaneIncident ball_light(const shared::LightParams& light, const Vec& p_world, const LanePoint& disc) {
  const Float zero(0.0f), one(1.0f), two(2.0f);
  const Vec offset = Vec(light.position) - p_world;
  const Float square = dot(offset, offset), distance = sqrt(square);
  const Vec axis = select(zero < distance, offset / distance, Vec(zero, one, zero));
  const Float r2(light.size * light.size);
  const Mask inside = square <= r2;
  const Float sine2 = select(inside, one, r2 / square), cosine = sqrt(one - sine2);
  const Float one_minus_cos = select(inside, two, sine2 / (one + cosine));
  LaneIncident result;
  result.to_light = direction_in_cone(axis, one_minus_cos, disc);
  const Float along = dot(result.to_light, offset), rho2 = disc.x * disc.x + disc.y * disc.y;
  const Float from_inside = sqrt(max(along * along + (r2 - square), zero));
  const Float from_outside =
      Float(light.size) * sqrt(max(one - rho2 * (two - rho2 * one_minus_cos) / (one + cosine), zero));
  result.target = p_world + result.to_light * select(inside, along + from_inside, along - from_outside);
  result.radiance = Vec(light.radiance) * select(inside, Float(4.0f), two / (one + cosine));
  result.radiance = select(Float(light.range) < distance, Vec(zero), result.radiance);
  if (light.inverse_square) result.radiance = result.radiance / max(max(square, r2), Float(1e-12f));
  if (light.kind == shared::kLightSpot)
    result.radiance = result.radiance * cone_share(light, result.to_light);
  return result;
}

inline LaneIncident sampled_light(const shared::LightParams& light, const Vec& p_world,
                                  const LanePoint& square) {
  if (light.kind == shared::kLightRectangle)
    return incident_light(light,
                          Vec(light.position) + Vec(light.edge_u) * (square.x - Float(0.5f)) +
                              Vec(light.edge_v) * (square.y - Float(0.5f)),
                          p_world);
  const LanePoint disc = disc_of_square(square);
  if (light.kind != shared::kLightDirectional) return ball_light(light, p_world, disc);
  LaneIncident result;
  result.to_light = direction_in_cone(-Vec(light.direction), Float(light.size), disc);
  result.target = Vec(Float(0.0f));
  result.radiance = Vec(light.radiance) * Float(2.0f / (2.0f - light.size));
  return result;
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
