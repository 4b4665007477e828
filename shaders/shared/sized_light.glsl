// Source of GLSL and of C++ (core/trace/shared.h): lights with a size, of which each sample takes one point. Expects
// phong.glsl; core/trace/lanes/sized_light.h is the same in lanes.
//   ball       (point, spot) even radiance, so that from anywhere it is an even disc; as bright in all as the
//              point it replaces: radiance I / (pi r^2). Its directions are sampled evenly by solid angle:
//              I / d^2 times 2 / (1 + cos of its angular radius). From inside it shines all around.
//   disc       (directional) likewise, at infinity
//   rectangle  even radiance on the side that it faces; points evenly by area, so each counts by its cosine

const float kPiByFour = 0.785398163397448309616f;

SHARED bool has_size(LightParams light) { return light.size > 0.0f || light.kind == kLightRectangle; }

// The square on the disc of radius 1, neighbours as neighbours, areas in proportion (Shirley and Chiu 1997). Sine and
// cosine are their series: the same on every machine.
SHARED vec2 disc_of_square(vec2 square) {
  vec2 p = 2.0f * square - 1.0f;
  bool wide = abs(p.x) > abs(p.y);
  float radius = wide ? p.x : p.y;
  float other = wide ? p.y : p.x;
  float a = radius == 0.0f ? 0.0f : kPiByFour * (other / radius);
  float a2 = a * a;
  float sine = a * (1.0f + a2 * (-1.0f / 6.0f + a2 * (1.0f / 120.0f + a2 * (-1.0f / 5040.0f))));
  float cosine = 1.0f + a2 * (-0.5f + a2 * (1.0f / 24.0f + a2 * (-1.0f / 720.0f + a2 * (1.0f / 40320.0f))));
  return wide ? vec2(radius * cosine, radius * sine) : vec2(radius * sine, radius * cosine);
}

// A vector given along two axes across `axis` and along it (Duff et al. 2017).
SHARED vec3 around(vec3 axis, vec3 local) {
  float side = axis.z < 0.0f ? -1.0f : 1.0f;
  float a = -1.0f / (side + axis.z);
  float b = axis.x * axis.y * a;
  vec3 t = vec3(1.0f + side * axis.x * axis.x * a, side * b, -side * axis.x);
  vec3 u = vec3(b, side + axis.y * axis.y * a, -axis.y);
  return t * local.x + u * local.y + axis * local.z;
}

// Unit; even in solid angle over the cone as `disc` is over the disc.
SHARED vec3 direction_in_cone(vec3 axis, float one_minus_cos, vec2 disc) {
  float down = (disc.x * disc.x + disc.y * disc.y) * one_minus_cos;
  float across = sqrt(one_minus_cos * max(2.0f - down, 0.0f));  // rounded, the disc's edge may be beyond
  return around(axis, vec3(disc.x * across, disc.y * across, 1.0f - down));
}

SHARED Incident ball_light(LightParams light, vec3 p_world, vec2 disc) {
  vec3 offset = light.position - p_world;
  float square = dot(offset, offset);
  float distance = sqrt(square);
  vec3 axis = distance > 0.0f ? offset / distance : vec3(0.0f, 1.0f, 0.0f);
  float r2 = light.size * light.size;
  bool inside = square <= r2;
  float sine2 = inside ? 1.0f : r2 / square;
  float cosine = sqrt(1.0f - sine2);  // of the angular radius
  float one_minus_cos = inside ? 2.0f : sine2 / (1.0f + cosine);
  Incident result;
  result.to_light = direction_in_cone(axis, one_minus_cos, disc);
  // How far the ball's surface is that way.
  float along = dot(result.to_light, offset);
  float rho2 = disc.x * disc.x + disc.y * disc.y;
  float half_chord = inside ? sqrt(max(along * along + (r2 - square), 0.0f))
                            : light.size * sqrt(max(1.0f - rho2 * (2.0f - rho2 * one_minus_cos) / (1.0f + cosine), 0.0f));
  result.target = p_world + result.to_light * (inside ? along + half_chord : along - half_chord);
  result.radiance = light.radiance * (inside ? 4.0f : 2.0f / (1.0f + cosine));
  if (distance > light.range) result.radiance = vec3(0.0f);
  if (light.inverse_square) result.radiance /= max(max(square, r2), 1e-12f);
  if (light.kind == kLightSpot) result.radiance *= cone_share(light, result.to_light);
  return result;
}

// The light's part at point `square` of [0, 1)^2; of a light without a size, all of it.
SHARED Incident sampled_light(LightParams light, vec3 p_world, vec2 square) {
  if (light.kind == kLightRectangle) {
    LightParams point = light;
    point.position = light.position + light.edge_u * (square.x - 0.5f) + light.edge_v * (square.y - 0.5f);
    return incident_light(point, p_world);
  }
  if (!(light.size > 0.0f)) return incident_light(light, p_world);
  vec2 disc = disc_of_square(square);
  if (light.kind != kLightDirectional) return ball_light(light, p_world, disc);
  Incident result;
  result.to_light = direction_in_cone(-light.direction, light.size, disc);
  result.target = vec3(0.0f);
  result.radiance = light.radiance * (2.0f / (2.0f - light.size));
  return result;
}
