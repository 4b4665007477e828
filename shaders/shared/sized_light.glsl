// Source of GLSL and of C++ (core/shade/shared.h, core/trace/lanes/shared.h): lights with a size, of which each sample
// takes one point. Expects phong.glsl.
//   ball       (point, spot) even radiance, so that from anywhere it is an even disc; in all as bright as the
//              point that it replaces: radiance I / (pi r^2). Its directions are sampled evenly by solid angle:
//              I / d^2 times 2 / (1 + cos of its angular radius). From inside it shines from all around.
//   disc       (directional) likewise, at infinity
//   rectangle  even radiance on the side that it faces; points evenly by area, so each counts by its cosine

const float kPiByFour = 0.785398163397448309616f;
const float kOneByTwoPi = 0.159154943091895335769f;

// The square on the disc of radius 1, neighbours as neighbours, areas in proportion (Shirley and Chiu 1997). Sine and
// cosine are their series: the same on every machine.
SHARED vec2 disc_of_square(vec2 square) {
  vec2 p = 2.0f * square - 1.0f;
  boolean wide = abs(p.x) > abs(p.y);
  real radius = pick(wide, p.x, p.y);
  real other = pick(wide, p.y, p.x);
  real a = pick(radius == 0.0f, 0.0f, kPiByFour * (other / radius));
  real a2 = a * a;
  real sine = a * (1.0f + a2 * (-1.0f / 6.0f + a2 * (1.0f / 120.0f + a2 * (-1.0f / 5040.0f))));
  real cosine = 1.0f + a2 * (-0.5f + a2 * (1.0f / 24.0f + a2 * (-1.0f / 720.0f + a2 * (1.0f / 40320.0f))));
  return vec2(radius * pick(wide, cosine, sine), radius * pick(wide, sine, cosine));
}

// Two axes across a unit vector (Duff et al. 2017).
struct Across {
  vec3 t;
  vec3 u;
};

SHARED Across across(vec3 axis) {
  real side = pick(axis.z < 0.0f, -1.0f, 1.0f);
  real a = -1.0f / (side + axis.z);
  real b = axis.x * axis.y * a;
  Across result;
  result.t = vec3(1.0f + side * axis.x * axis.x * a, side * b, -side * axis.x);
  result.u = vec3(b, side + axis.y * axis.y * a, -axis.y);
  return result;
}

// A vector given along two axes across `axis` and along it.
SHARED vec3 around(vec3 axis, vec3 local) {
  Across axes = across(axis);
  return axes.t * local.x + axes.u * local.y + axis * local.z;
}

// Unit; even in solid angle over the cone as `disc` is over the disc.
SHARED vec3 direction_in_cone(vec3 axis, real one_minus_cos, vec2 disc) {
  real down = (disc.x * disc.x + disc.y * disc.y) * one_minus_cos;
  real across = sqrt(one_minus_cos * max(2.0f - down, 0.0f));  // rounded, the disc's edge may be beyond
  return around(axis, vec3(disc.x * across, disc.y * across, 1.0f - down));
}

SHARED Incident ball_light(LightParams light, vec3 p_world, vec2 disc) {
  vec3 offset = light.position - p_world;
  real square = dot(offset, offset);
  real distance = sqrt(square);
  vec3 axis = pick(distance > 0.0f, offset * (1.0f / distance), vec3(0.0f, 1.0f, 0.0f));
  real r2 = light.size * light.size;
  boolean inside = square <= r2;
  real sine2 = pick(inside, 1.0f, r2 / square);
  real cosine = sqrt(1.0f - sine2);  // of the angular radius
  real one_minus_cos = pick(inside, 2.0f, sine2 / (1.0f + cosine));
  Incident result;
  result.to_light = direction_in_cone(axis, one_minus_cos, disc);
  // How far the ball's surface is that way.
  real along = dot(result.to_light, offset);
  real rho2 = disc.x * disc.x + disc.y * disc.y;
  real from_inside = sqrt(max(along * along + (r2 - square), 0.0f));
  real from_outside = light.size * sqrt(max(1.0f - rho2 * (2.0f - rho2 * one_minus_cos) / (1.0f + cosine), 0.0f));
  result.target = p_world + result.to_light * pick(inside, along + from_inside, along - from_outside);
  result.density = kOneByTwoPi / one_minus_cos;
  result.radiance = light.radiance * pick(inside, 4.0f, 2.0f / (1.0f + cosine));
  result.radiance = within_range(light, distance, result.radiance);
  if (light.inverse_square) result.radiance /= max(max(square, r2), kLeastSquare);
  if (light.kind == kLightSpot) result.radiance *= cone_share(light, result.to_light);
  return result;
}

SHARED Incident rectangle_light(LightParams light, vec3 p_world, vec2 square) {
  vec3 position = light.position + light.edge_u * (square.x - 0.5f) + light.edge_v * (square.y - 0.5f);
  Incident result = incident_light(light, position, p_world);
  vec3 offset = position - p_world;
  real area = area_of_sides(light) * max(dot(-result.to_light, light.direction), 0.0f);
  result.density = pick(area > 0.0f, dot(offset, offset) / area, 0.0f);
  return result;
}

// What comes from the light's point `square`, in [0, 1)^2, standing for the whole light.
SHARED Incident sampled_light(LightParams light, vec3 p_world, vec2 square) {
  if (has_sides(light)) return rectangle_light(light, p_world, square);
  if (!(light.size > 0.0f)) return incident_light(light, light.position, p_world);
  vec2 disc = disc_of_square(square);
  if (light.kind != kLightDirectional) return ball_light(light, p_world, disc);
  Incident result;
  result.to_light = direction_in_cone(-vec3(light.direction), light.size, disc);
  result.target = vec3(0.0f);
  result.density = kOneByTwoPi / light.size;
  result.radiance = light.radiance * (2.0f / (2.0f - light.size));
  return result;
}

// How a direction meets a light with a size: as if that light had been sampled there.
struct Meeting {
  boolean met;
  Incident incident;
};

SHARED Meeting meet_ball(LightParams light, vec3 p_world, vec3 direction) {
  vec3 offset = light.position - p_world;
  real square = dot(offset, offset);
  real r2 = light.size * light.size;
  real along = dot(direction, offset);
  vec3 off = offset - direction * along;
  real rest = r2 - dot(off, off);
  boolean inside = square <= r2;
  Meeting m;
  m.met = rest > 0.0f && (inside || along > 0.0f) && !(sqrt(square) > light.range);
  real sine2 = pick(inside, 1.0f, r2 / square);
  real cosine = sqrt(1.0f - sine2);
  real one_minus_cos = pick(inside, 2.0f, sine2 / (1.0f + cosine));
  real chord = sqrt(max(rest, 0.0f));
  m.incident.to_light = direction;
  m.incident.target = p_world + direction * pick(inside, along + chord, along - chord);
  m.incident.density = kOneByTwoPi / one_minus_cos;
  m.incident.radiance = within_range(light, sqrt(square), light.radiance) * pick(inside, 4.0f, 2.0f / (1.0f + cosine));
  if (light.inverse_square) m.incident.radiance /= max(max(square, r2), kLeastSquare);
  if (light.kind == kLightSpot) m.incident.radiance *= cone_share(light, direction);
  return m;
}

SHARED Meeting meet_rectangle(LightParams light, vec3 p_world, vec3 direction) {
  vec3 across = cross(light.edge_u, light.edge_v);
  real square = dot(across, across);
  real towards = -dot(direction, light.direction);
  vec3 offset = p_world - light.position;
  real distance = dot(offset, light.direction) / towards;
  vec3 at = offset + direction * distance;
  // Along the sides, -1/2 to 1/2 on the light.
  real u = dot(at, cross(light.edge_v, across) / square);
  real v = dot(at, cross(across, light.edge_u) / square);
  Meeting m;
  m.met = towards > 0.0f && distance > 0.0f && abs(u) <= 0.5f && abs(v) <= 0.5f && !(distance > light.range);
  m.incident.to_light = direction;
  m.incident.target = p_world + direction * distance;
  m.incident.density = distance * distance / (towards * sqrt(square));
  m.incident.radiance = within_range(light, distance, light.radiance) * towards;
  if (light.inverse_square) m.incident.radiance /= max(distance * distance, kLeastSquare);
  return m;
}

// The target is set for lights that are not directional.
SHARED Meeting meet_light(LightParams light, vec3 p_world, vec3 direction) {
  if (has_sides(light)) return meet_rectangle(light, p_world, direction);
  if (light.kind != kLightDirectional) return meet_ball(light, p_world, direction);
  vec3 off = direction + light.direction;  // its square is 2 - 2 cos
  Meeting m;
  m.met = dot(off, off) * 0.5f <= light.size;
  m.incident.to_light = direction;
  m.incident.target = vec3(0.0f);
  m.incident.density = kOneByTwoPi / light.size;
  m.incident.radiance = light.radiance * (2.0f / (2.0f - light.size));
  return m;
}
