// Source of GLSL and of C++ (core/trace/shared.h): looking textures up. Each side says before what TexelSource
// is, and texel_at(source, i, is_color): the i-th texel, 0 to 1, colour (sRGB) made linear.

const int kWrapRepeat = 0;
const int kWrapMirror = 1;
const int kWrapClamp = 2;

struct TextureParams {
  TexelSource source;  // all levels, one after the other, row by row
  ivec2 size;          // of the first; 0: there is no texture
  int levels;
  int uv_set;
  mat3x2 uv_from_texcoord;
  int wrap_u;
  int wrap_v;
  bool nearest;
};

// A texture coordinate, and how it changes from a pixel to the next, across and down; zero: not filtered.
struct TexturePoint {
  vec2 uv;
  vec2 change_x;
  vec2 change_y;
};

SHARED float within_period(float t, int wrap) {
  if (wrap == kWrapClamp) return clamp(t, 0.0f, 1.0f);
  float period = wrap == kWrapMirror ? 2.0f : 1.0f;
  return t - period * floor(t / period);
}

// i: -1 to n, or to 2 n where it is mirrored.
SHARED int wrapped_texel(int i, int n, int wrap) {
  if (wrap == kWrapRepeat) return i < 0 ? i + n : (i >= n ? i - n : i);
  if (wrap == kWrapMirror && i >= n) i = 2 * n - 1 - i;
  return clamp(i, 0, n - 1);
}

SHARED vec4 texel_of_level(TextureParams use, int first, ivec2 size, ivec2 at, bool is_color) {
  int x = wrapped_texel(at.x, size.x, use.wrap_u);
  int y = wrapped_texel(at.y, size.y, use.wrap_v);
  return texel_at(use.source, first + y * size.x + x, is_color);
}

// Bilinear by hand: hardware filters with 8 bits of weight, and the two sides would differ.
SHARED vec4 sample_level(TextureParams use, vec2 uv, int level, bool is_color) {
  ivec2 size = use.size;
  int first = 0;
  for (int i = 0; i < level; ++i) {
    first += size.x * size.y;
    size = max(size / 2, ivec2(1));
  }
  vec2 within = vec2(within_period(uv.x, use.wrap_u), within_period(uv.y, use.wrap_v)) * vec2(size);
  if (use.nearest) return texel_of_level(use, first, size, ivec2(floor(within)), is_color);
  vec2 at = within - 0.5f;
  vec2 base = floor(at);
  vec2 f = at - base;
  ivec2 b = ivec2(base);
  return mix(mix(texel_of_level(use, first, size, b, is_color),
                 texel_of_level(use, first, size, b + ivec2(1, 0), is_color), f.x),
             mix(texel_of_level(use, first, size, b + ivec2(0, 1), is_color),
                 texel_of_level(use, first, size, b + ivec2(1, 1), is_color), f.x),
             f.y);
}

SHARED vec4 sample_trilinear(TextureParams use, vec2 uv, float lod, bool is_color) {
  float clamped = clamp(lod, 0.0f, float(use.levels - 1));
  int level = int(clamped);
  float part = clamped - float(level);
  vec4 fine = sample_level(use, uv, level, is_color);
  if (part == 0.0f) return fine;
  return mix(fine, sample_level(use, uv, level + 1, is_color), part);
}

const float kMostTaps = 8.0f;

// The mean over what a pixel sees: levels by the shorter side of its footprint, several taps along the longer
// one (as the hardware's anisotropic filter: McCormack et al. 1999).
SHARED vec4 sample_texture(TextureParams use, TexturePoint point, bool is_color) {
  vec2 x = point.change_x * vec2(use.size);
  vec2 y = point.change_y * vec2(use.size);
  float xx = dot(x, x);
  float yy = dot(y, y);
  float longer = sqrt(max(xx, yy));
  // Written so that NaN is not filtered either.
  if (use.levels <= 1 || !(longer > 1.0f)) return sample_level(use, point.uv, 0, is_color);
  float shorter = max(abs(x.x * y.y - x.y * y.x) / longer, 1.0f);  // the parallelogram's height
  float taps = clamp(ceil(longer / shorter), 1.0f, kMostTaps);
  float lod = log2(min(longer / taps, 65536.0f));
  vec2 along = xx > yy ? point.change_x : point.change_y;
  vec4 sum = vec4(0.0f);
  for (float k = 0.5f; k < taps; k += 1.0f)
    sum += sample_trilinear(use, point.uv + along * (k / taps - 0.5f), lod, is_color);
  return sum / taps;
}

// How the texture coordinate of triangle (a, a + ab, a + ac) changes where the ray's point moves by `spread`
// and then along `direction` back to the triangle's plane (ray differentials: Igehy 1999).
SHARED vec2 uv_change(vec3 spread, vec3 direction, vec3 ab, vec3 ac, vec2 uv_ab, vec2 uv_ac) {
  vec3 n = cross(ab, ac);
  float towards = dot(n, direction);
  float square = dot(n, n);
  if (towards == 0.0f || square == 0.0f) return vec2(0.0f);
  vec3 p = spread - direction * (dot(n, spread) / towards);
  return (dot(cross(p, ac), n) * uv_ab + dot(cross(ab, p), n) * uv_ac) / square;
}
