// Source of GLSL and of lanes (core/trace/lanes/environment_light.h): light from far away, all around. Each side defines
// EnvironmentTexels and environment_texel(texels, column, row) before it; columns and rows are whole numbers.

struct EnvironmentParams {
  EnvironmentTexels texels;
  ivec2 size;
  float turn;      // how far the picture is turned about +Y, revolutions
  float strength;  // multiplies the texels
};

// atan(x) for x in [0, 1], radians; off by 2e-8 at most (Abramowitz and Stegun 1964, 4.4.49). GLSL's own may be
// off by 4096 roundings.
SHARED real atan_below_one(real x) {
  real s = x * x;
  real p = ((((((((0.0028662257f * s - 0.0161657367f) * s + 0.0429096138f) * s - 0.0752896400f) * s + 0.1065626393f) *
               s - 0.1420889944f) * s + 0.1999355085f) * s - 0.3333314528f) * s + 1.0f);
  return p * x;
}

// The angle of (x, y) from (1, 0) towards (0, 1), in revolutions, in [0, 1].
SHARED real revolutions(real y, real x) {
  real ax = abs(x);
  real ay = abs(y);
  real larger = max(ax, ay);
  real turn = pick(larger > 0.0f, atan_below_one(min(ax, ay) / larger) * 0.15915494309f, real(0.0f));
  turn = pick(ay > ax, 0.25f - turn, turn);
  turn = pick(x < 0.0f, 0.5f - turn, turn);
  return pick(y < 0.0f, 1.0f - turn, turn);
}

// A direction's place in the picture: the middle is +Z, a quarter of the width left of it +X, the top row +Y
// (OpenEXR's latitude-longitude maps). u in [0, 1).
SHARED vec2 environment_place(EnvironmentParams env, vec3 direction) {
  real u = revolutions(direction.x, -direction.z) + env.turn;
  real across = sqrt(direction.x * direction.x + direction.z * direction.z);
  return vec2(u - floor(u), 2.0f * revolutions(across, direction.y));
}

SHARED vec3 environment_at(EnvironmentParams env, vec2 place) {
  float width = float(env.size.x);
  float height = float(env.size.y);
  real x = place.x * width - 0.5f;
  real y = place.y * height - 0.5f;
  real column = floor(x);
  real row = floor(y);
  real left = pick(column < 0.0f, column + width, column);
  real right = pick(width <= column + 1.0f, real(0.0f), column + 1.0f);
  real above = max(row, real(0.0f));
  real below = min(row + 1.0f, real(height - 1.0f));
  vec3 top = mix(environment_texel(env.texels, left, above), environment_texel(env.texels, right, above), x - column);
  vec3 bottom = mix(environment_texel(env.texels, left, below), environment_texel(env.texels, right, below), x - column);
  return env.strength * mix(top, bottom, y - row);
}

// Light from there. The direction has any length but zero.
SHARED vec3 environment_light(EnvironmentParams env, vec3 direction) {
  return environment_at(env, environment_place(env, direction));
}
