// Source of GLSL and of C++ (bench/one_ray/shared_maps.h): texture look-ups. Each side defines TexelSource and
// level_at(source, size, level): the level's first texel, width and height; texel_place(width, x, y): a texel's place
// behind the first; and texel_at(source, i, is_color): the i-th texel, 0 to 1, colour (sRGB) made linear. The lanes have
// code of their own (core/trace/lanes/texture.h).

const int kWrapRepeat = 0;
const int kWrapMirror = 1;
const int kWrapClamp = 2;

struct TextureParams {
  TexelSource source;  // all levels, one after the other
  ivec2 size;          // the first level's; 0: there is no texture
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

SHARED vec2 within_periods(TextureParams use, vec2 uv) {
  return vec2(within_period(uv.x, use.wrap_u), within_period(uv.y, use.wrap_v));
}

// uv: within its periods. Bilinear by hand: hardware filters with 8 bits of weight, and the two sides would
// differ. (The level is found each time: where it is carried through the loop over taps, Mesa 22's llvmpipe
// compiles for minutes.)
SHARED vec4 sample_level(TextureParams use, vec2 uv, int level, bool is_color) {
  ivec3 of_level = level_at(use.source, use.size, level);
  int first = of_level.x;
  ivec2 size = ivec2(of_level.y, of_level.z);
  vec2 at = use.nearest ? uv * vec2(size) : uv * vec2(size) - 0.5f;
  vec2 base = floor(at);
  ivec2 b = ivec2(base);
  int x = wrapped_texel(b.x, size.x, use.wrap_u);
  int y = wrapped_texel(b.y, size.y, use.wrap_v);
  if (use.nearest) return texel_at(use.source, first + texel_place(size.x, x, y), is_color);
  int right = wrapped_texel(b.x + 1, size.x, use.wrap_u);
  int below = wrapped_texel(b.y + 1, size.y, use.wrap_v);
  vec2 f = at - base;
  return mix(mix(texel_at(use.source, first + texel_place(size.x, x, y), is_color),
                 texel_at(use.source, first + texel_place(size.x, right, y), is_color), f.x),
             mix(texel_at(use.source, first + texel_place(size.x, x, below), is_color),
                 texel_at(use.source, first + texel_place(size.x, right, below), is_color), f.x),
             f.y);
}

// From the largest level, not filtered.
SHARED vec4 sample_point(TextureParams use, vec2 uv, bool is_color) {
  return sample_level(use, within_periods(use, uv), 0, is_color);
}

const float kMostTaps = 8.0f;
const float kLongestFootprint = 1.0e18f;  // In texels. Beyond it, its square is not a finite number.

// The mean over a pixel's footprint: several taps along its longer side, of levels by the distance between taps
// (as the hardware's anisotropic filter: McCormack et al. 1999).
SHARED vec4 sample_texture(TextureParams use, TexturePoint point, bool is_color) {
  vec2 x = point.change_x * vec2(use.size);
  vec2 y = point.change_y * vec2(use.size);
  float xx = dot(x, x);
  float yy = dot(y, y);
  float longer = sqrt(max(xx, yy));
  // Written so that NaN and infinity are not filtered either.
  if (use.levels <= 1 || !(longer > 1.0f && longer < kLongestFootprint && xx + yy > 0.0f))
    return sample_point(use, point.uv, is_color);
  float shorter = max(abs(x.x * y.y - x.y * y.x) / longer, 1.0f);  // the parallelogram's height
  float taps = clamp(ceil(longer / shorter), 1.0f, kMostTaps);
  float lod = clamp(log2(min(longer / taps, 65536.0f)), 0.0f, float(use.levels - 1));
  int level = int(lod);
  float part = lod - float(level);
  vec2 along = xx > yy ? point.change_x : point.change_y;
  vec4 sum = vec4(0.0f);
  for (float k = 0.5f; k < taps; k += 1.0f) {
    vec2 uv = within_periods(use, point.uv + along * (k / taps - 0.5f));
    vec4 texel = sample_level(use, uv, level, is_color);
    if (part > 0.0f) texel = mix(texel, sample_level(use, uv, level + 1, is_color), part);
    sum += texel;
  }
  return sum / taps;
}
