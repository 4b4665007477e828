// Source of GLSL and of C++ (core/trace/lanes/environment_light.h): light from far away, all around. Each side defines
// EnvironmentTexels and environment_texel(texels, at) before it.

struct EnvironmentParams {
  EnvironmentTexels texels;
  ivec2 size;
  float turn;      // how far the picture is turned about +Y, revolutions
  float strength;  // multiplies the texels
};

// atan(x) for x in [0, 1], radians; off by 2e-8 at most (Abramowitz and Stegun 1964, 4.4.49). GLSL's own may be
// off by 4096 roundings.
SHARED float atan_below_one(float x) {
  float s = x * x;
  float p = ((((((((0.0028662257f * s - 0.0161657367f) * s + 0.0429096138f) * s - 0.0752896400f) * s + 0.1065626393f) *
                s - 0.1420889944f) * s + 0.1999355085f) * s - 0.3333314528f) * s + 1.0f);
  return p * x;
}

// The angle of (x, y) from (1, 0) towards (0, 1), in revolutions, in [0, 1].
SHARED float revolutions(float y, float x) {
  float ax = abs(x);
  float ay = abs(y);
  float larger = max(ax, ay);
  float turn = larger > 0.0f ? atan_below_one(min(ax, ay) / larger) * 0.15915494309f : 0.0f;
  if (ay > ax) turn = 0.25f - turn;
  if (x < 0.0f) turn = 0.5f - turn;
  return y < 0.0f ? 1.0f - turn : turn;
}

// A direction's place in the picture: the middle is +Z, a quarter of the width left of it +X, the top row +Y
// (OpenEXR's latitude-longitude maps). u in [0, 1).
SHARED vec2 environment_place(EnvironmentParams env, vec3 direction) {
  float u = revolutions(direction.x, -direction.z) + env.turn;
  float across = sqrt(direction.x * direction.x + direction.z * direction.z);
  return vec2(u - floor(u), 2.0f * revolutions(across, direction.y));
}

SHARED vec3 environment_at(EnvironmentParams env, vec2 place) {
  vec2 at = place * vec2(env.size) - 0.5f;
  vec2 base = floor(at);
  vec2 f = at - base;
  ivec2 b = ivec2(base);
  int left = b.x < 0 ? b.x + env.size.x : b.x;
  int right = b.x + 1 >= env.size.x ? 0 : b.x + 1;
  int above = max(b.y, 0);
  int below = min(b.y + 1, env.size.y - 1);
  vec3 top = mix(environment_texel(env.texels, ivec2(left, above)), environment_texel(env.texels, ivec2(right, above)), f.x);
  vec3 bottom = mix(environment_texel(env.texels, ivec2(left, below)), environment_texel(env.texels, ivec2(right, below)), f.x);
  return env.strength * mix(top, bottom, f.y);
}

// Light from there. The direction has any length but zero.
SHARED vec3 environment_light(EnvironmentParams env, vec3 direction) {
  return environment_at(env, environment_place(env, direction));
}
