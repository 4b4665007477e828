// Source of GLSL and of C++ (bench/one_ray/shared_maps.h): texture look-ups. Each side defines TexelSource and
// level_at(source, size, level): the level's first texel, width and height; texel_place(width, x, y): a texel's place
// behind the first; texel_at(source, i, is_color): the i-th texel, colour (sRGB) made linear; texel_scale(is_color):
// texel_at's value for 1; and level_of(texels): their logarithm to base 2. Expects texture_params.glsl. The lanes have
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

// 0 where t is not finite. (Comparisons with NaN are false; what clamp and max make of it is not defined.)
SHARED float within_period(float t, int wrap) {
  if (wrap == kWrapClamp) return t > 0.0f ? min(t, 1.0f) : 0.0f;
  float period = wrap == kWrapMirror ? 2.0f : 1.0f;
  float within = t - period * floor(t / period);
  return within > 0.0f ? within : 0.0f;
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

SHARED float whole_share(float share) { return floor(share + 0.5f); }

// Texels times their shares, above and below their points.
struct TexelSums {
  vec4 above;
  vec4 below;
};

// Adds the four texels about a point of a level. uv: within its periods. all: what their shares add up to. (The level
// is found each time: where it is carried through the loop over taps, Mesa 22's llvmpipe compiles for minutes.)
SHARED TexelSums with_level(TexelSums sums, TextureParams use, vec2 uv, int level, float all, bool is_color) {
  ivec3 of_level = level_at(use.source, use.size, level);
  int first = of_level.x;
  ivec2 size = ivec2(of_level.y, of_level.z);
  vec2 at = use.nearest ? uv * vec2(size) : uv * vec2(size) - 0.5f;
  vec2 base = floor(at);
  ivec2 b = ivec2(base);
  int x = wrapped_texel(b.x, size.x, use.wrap_u);
  int y = wrapped_texel(b.y, size.y, use.wrap_v);
  if (use.nearest)
    return TexelSums(sums.above + texel_at(use.source, first + texel_place(size.x, x, y), is_color) * all, sums.below);
  int right = wrapped_texel(b.x + 1, size.x, use.wrap_u);
  int below = wrapped_texel(b.y + 1, size.y, use.wrap_v);
  vec2 f = at - base;
  float of_below = whole_share(all * f.y);
  float of_above = all - of_below;
  float of_right_above = whole_share(of_above * f.x);
  float of_right_below = whole_share(of_below * f.x);
  return TexelSums(
      sums.above +
          (texel_at(use.source, first + texel_place(size.x, x, y), is_color) * (of_above - of_right_above) +
           texel_at(use.source, first + texel_place(size.x, right, y), is_color) * of_right_above),
      sums.below +
          (texel_at(use.source, first + texel_place(size.x, x, below), is_color) * (of_below - of_right_below) +
           texel_at(use.source, first + texel_place(size.x, right, below), is_color) * of_right_below));
}

SHARED TexelSums no_texels() { return TexelSums(vec4(0.0f), vec4(0.0f)); }

SHARED vec4 mean_of(TexelSums sums, float taps, bool is_color) {
  return (sums.above + sums.below) / (kWholeShare * taps * texel_scale(is_color));
}

// From the largest level, not filtered.
SHARED vec4 sample_point(TextureParams use, vec2 uv, bool is_color) {
  return mean_of(with_level(no_texels(), use, within_periods(use, uv), 0, kWholeShare, is_color), 1.0f, is_color);
}

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
  float taps = clamp(ceil(longer / shorter), 1.0f, float(kMostTaps));
  float lod = clamp(level_of(min(longer / taps, 65536.0f)), 0.0f, float(use.levels - 1));
  int level = int(lod);
  float of_second = whole_share(kWholeShare * (lod - float(level)));
  vec2 along = xx > yy ? point.change_x : point.change_y;
  TexelSums sums = no_texels();
  for (float k = 0.5f; k < taps; k += 1.0f) {
    vec2 uv = within_periods(use, point.uv + along * (k / taps - 0.5f));
    sums = with_level(sums, use, uv, level, kWholeShare - of_second, is_color);
    if (of_second > 0.0f) sums = with_level(sums, use, uv, level + 1, of_second, is_color);
  }
  return mean_of(sums, taps, is_color);
}
