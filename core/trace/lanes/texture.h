// Part of walk/kernel.h's files: shaders/shared/texture.glsl in lanes, operation by operation, so that the
// texels have the bits of one look-up at a time. It is written for lanes, as their levels and taps differ
// from lane to lane and a packet's texels are gathered.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/shade/lane_texture.h"
#include "core/trace/lanes/shared.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

struct Texel {
  Float c[4];
};
inline Texel mix(const Texel& a, const Texel& b, Float share) {
  Texel mixed;
  for (int i = 0; i < 4; ++i) mixed.c[i] = a.c[i] * (Float(1.0f) - share) + b.c[i] * share;
  return mixed;
}

struct TextureLevel {
  Int first;
  Float width, height;
};

inline Float within_period(Float t, Wrap wrap) {
  if (wrap == Wrap::clamp) return min(max(t, Float(0.0f)), Float(1.0f));
  const float period = wrap == Wrap::mirror ? 2.0f : 1.0f;
  return t - Float(period) * floor(t * Float(1.0f / period));
}

// Whole numbers.
inline Float wrapped_texel(Float i, Float n, Wrap wrap) {
  if (wrap == Wrap::repeat) i = select(i < Float(0.0f), i + n, select(n <= i, i - n, i));
  if (wrap == Wrap::mirror) i = select(n <= i, n + n - Float(1.0f) - i, i);
  return min(max(i, Float(0.0f)), n - Float(1.0f));
}

inline Texel texel_at(const LaneTexture& t, Int i, Mask lanes) {
  const Int count(static_cast<std::uint32_t>(t.width * t.height));
  const Mask first = lanes & (i < count), other = lanes & ~first;
  Int bits(0);
  if (any(first)) bits = gather(t.first_level, i, first);
  if (any(other)) bits = bits | gather(t.others, i - count, other);
  const Int bytes[4] = {bits & Int(255), shift_in_zeros<8>(bits) & Int(255),
                        shift_in_zeros<16>(bits) & Int(255), shift_in_zeros<24>(bits)};
  Texel texel;
  for (int c = 0; c < 4; ++c)
    texel.c[c] = t.is_color && c < 3 ? from_bits(gather(t.linear_from_srgb8, bytes[c], lanes))
                                     : to_float(bytes[c]) / Float(255.0f);
  return texel;
}

inline Texel sample_level(const LaneTexture& t, Float u, Float v, const TextureLevel& level, Mask lanes) {
  const Float half(t.nearest ? 0.0f : 0.5f), one(1.0f);
  const Float x = u * level.width - half, y = v * level.height - half;
  const Float base_x = floor(x), base_y = floor(y);
  const Int width = to_int(level.width);
  const auto column = [&](Float i) { return to_int(wrapped_texel(i, level.width, t.wrap_u)); };
  const auto row = [&](Float i) {
    return level.first + to_int(wrapped_texel(i, level.height, t.wrap_v)) * width;
  };
  const Int left = column(base_x), above = row(base_y);
  if (t.nearest) return texel_at(t, above + left, lanes);
  const Int right = column(base_x + one), below = row(base_y + one);
  return mix(mix(texel_at(t, above + left, lanes), texel_at(t, above + right, lanes), x - base_x),
             mix(texel_at(t, below + left, lanes), texel_at(t, below + right, lanes), x - base_x),
             y - base_y);
}

// The two levels that each lane reads. Lane by lane, as logarithms are the library's.
struct LaneLevels {
  alignas(64) std::uint32_t first[2][kMostLanes];
  alignas(64) float width[2][kMostLanes], height[2][kMostLanes];
  alignas(64) float part[kMostLanes];  // of the second

  LaneLevels(const LaneTexture& t, unsigned lanes, unsigned filtered, const float* texels_apart) {
    for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const float most = static_cast<float>(t.levels - 1);
      float lod = 0.0f;
      if (filtered >> lane & 1) lod = ::log2f(texels_apart[lane] < 65536.0f ? texels_apart[lane] : 65536.0f);
      lod = lod < 0.0f ? 0.0f : (most < lod ? most : lod);
      int w = t.width, h = t.height, at = 0;
      for (int level = static_cast<int>(lod); level >= 0; --level) {
        first[0][lane] = static_cast<std::uint32_t>(at);
        width[0][lane] = static_cast<float>(w);
        height[0][lane] = static_cast<float>(h);
        at += w * h;
        w = w > 1 ? w / 2 : 1;
        h = h > 1 ? h / 2 : 1;
      }
      first[1][lane] = static_cast<std::uint32_t>(at);
      width[1][lane] = static_cast<float>(w);
      height[1][lane] = static_cast<float>(h);
      part[lane] = lod - static_cast<float>(static_cast<int>(lod));
    }
  }
  [[nodiscard]] TextureLevel level(int i) const {
    return {Int::load(first[i]), Float::load(width[i]), Float::load(height[i])};
  }
};

[[gnu::noinline]] void sample_texture(const LaneTexture& t, unsigned wanted, TexturePoints& p) {
  const Mask lanes = Mask::from_bits(wanted);
  const Float one(1.0f), zero(0.0f), width(static_cast<float>(t.width)), height(static_cast<float>(t.height));
  const Float xu = Float::load(p.change_x[0]), xv = Float::load(p.change_x[1]);
  const Float yu = Float::load(p.change_y[0]), yv = Float::load(p.change_y[1]);
  const Float x0 = xu * width, x1 = xv * height, y0 = yu * width, y1 = yv * height;
  const Float xx = x0 * x0 + x1 * x1, yy = y0 * y0 + y1 * y1;
  const Float longer = sqrt(max(yy, xx));
  const Mask filtered = t.levels > 1 ? lanes & (one < longer) & (longer < Float(1.0e18f)) & (zero < xx + yy)
                                     : Mask::from_bits(0);
  const Float shorter = max(abs(x0 * y1 - x1 * y0) / longer, one);
  const Float many = -floor(-(longer / shorter));
  const Float taps = select(filtered, min(max(many, one), Float(8.0f)), one);
  const Float along_u = select(filtered, select(yy < xx, xu, yu), zero);
  const Float along_v = select(filtered, select(yy < xx, xv, yv), zero);

  alignas(64) float texels_apart[kMostLanes];
  (longer / taps).store(texels_apart);
  const LaneLevels levels(t, wanted, filtered.bits(), texels_apart);
  const TextureLevel fine = levels.level(0), coarse = levels.level(1);
  const Float part = Float::load(levels.part);
  const Mask between = lanes & (zero < part);

  Texel sum{{zero, zero, zero, zero}};
  const Float u = Float::load(p.uv[0]), v = Float::load(p.uv[1]);
  for (float k = 0.5f;; k += 1.0f) {
    const Mask on = lanes & (Float(k) < taps);
    if (!any(on)) break;
    const Float share = Float(k) / taps - Float(0.5f);
    const Float at_u = within_period(u + along_u * share, t.wrap_u);
    const Float at_v = within_period(v + along_v * share, t.wrap_v);
    Texel texel = sample_level(t, at_u, at_v, fine, on);
    if (const Mask both = on & between; any(both)) {
      const Texel mixed = mix(texel, sample_level(t, at_u, at_v, coarse, both), part);
      for (int c = 0; c < 4; ++c) texel.c[c] = select(both, mixed.c[c], texel.c[c]);
    }
    for (int c = 0; c < 4; ++c) sum.c[c] = select(on, sum.c[c] + texel.c[c], sum.c[c]);
  }
  for (int c = 0; c < 4; ++c) (sum.c[c] / taps).store(p.texel[c]);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
