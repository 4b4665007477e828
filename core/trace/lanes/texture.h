// Part of walk/kernel.h's files: shaders/shared/texture.glsl in lanes, operation by operation, so that the
// texels have the bits of one look-up at a time. Where the texels lie is computed for a packet at once, and
// for all textures that are read there. Texels are fetched a point at a time, the channels of two levels in
// one register: gathers would cost more than all arithmetic on them.
#pragma once

#include <cmath>
#include <iterator>

#include "core/shade/lane_maps.h"
#include "core/simd/texels.h"
#include "core/trace/lanes/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

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

// The levels that each lane reads. Lane by lane, as logarithms are the library's.
struct LaneLevels {
  alignas(64) std::uint32_t first[2][kMostLanes]{};
  alignas(64) float width[2][kMostLanes]{}, height[2][kMostLanes]{};
  alignas(64) float part[kMostLanes]{};  // of the second

  LaneLevels(const TexturePlace& place, unsigned lanes, unsigned filtered, const float* texels_apart) {
    for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const float most = as_float(place.levels - 1);
      float lod = 0.0f;
      if (filtered >> lane & 1) lod = ::log2f(texels_apart[lane] < 65536.0f ? texels_apart[lane] : 65536.0f);
      lod = lod < 0.0f ? 0.0f : (most < lod ? most : lod);
      const int fine = as_int(lod);
      part[lane] = lod - as_float(fine);
      for (int i = 0; i < 2; ++i) {
        const TextureLevel& level = place.level[fine + i < place.levels ? fine + i : fine];
        first[i][lane] = level.first;
        width[i][lane] = level.width;
        height[i][lane] = level.height;
      }
    }
  }
};

// The place of texels behind their level's first: TexelBlocks::place().
struct LanePlaces {
  static_assert(TexelBlocks::kSide == 4);
  Int row_of_blocks;  // texels

  explicit LanePlaces(Float width) : row_of_blocks(shift_left<4>(shift_right<2>(to_int(width) + Int(3u)))) {}

  [[nodiscard]] static Int along_row(Float x) {
    const Int column = to_int(x);
    return shift_left<2>(column & Int(~3u)) + (column & Int(3u));
  }
  [[nodiscard]] Int of_row(Float y) const {
    const Int row = to_int(y);
    return shift_right<2>(row) * row_of_blocks + shift_left<2>(row & Int(3u));
  }
};

// The four texels about a point, and its place among them.
struct LaneQuads {
  alignas(64) std::uint32_t texel[4][kMostLanes];  // above left and right, below left and right
  alignas(64) float x[kMostLanes], y[kMostLanes];

  [[gnu::always_inline]] inline void find(const TexturePlace& place, Float u, Float v, Int first, Float width,
                                          Float height) {
    const Float one(1.0f);
    const LanePlaces places(width);
    if (place.nearest) {
      const Int at = first + places.of_row(wrapped_texel(floor(v * height), height, place.wrap_v)) +
                     LanePlaces::along_row(wrapped_texel(floor(u * width), width, place.wrap_u));
      for (auto& column : texel) at.store(column);
      Float(0.0f).store(x);
      Float(0.0f).store(y);
      return;
    }
    const Float at_x = u * width - Float(0.5f), at_y = v * height - Float(0.5f);
    const Float base_x = floor(at_x), base_y = floor(at_y);
    const Int left = LanePlaces::along_row(wrapped_texel(base_x, width, place.wrap_u));
    const Int right = LanePlaces::along_row(wrapped_texel(base_x + one, width, place.wrap_u));
    const Int above = first + places.of_row(wrapped_texel(base_y, height, place.wrap_v));
    const Int below = first + places.of_row(wrapped_texel(base_y + one, height, place.wrap_v));
    (above + left).store(texel[0]);
    (above + right).store(texel[1]);
    (below + left).store(texel[2]);
    (below + right).store(texel[3]);
    (at_x - base_x).store(x);
    (at_y - base_y).store(y);
  }
};

// Four texels, row(0) to row(3), mixed by the place among them.
template <class Row, class Share>
[[gnu::always_inline]] inline auto mixed_quad(const Share& x, const Share& y, Row row) {
  return mixed(mixed(row(0), row(1), x), mixed(row(2), row(3), x), y);
}

// A tap of each lane of `on`, added to the textures' sums.
struct Taps {
  LaneQuads quads[2];  // of the finer level, and of the coarser one

  [[gnu::always_inline]] inline void add(const TexturePlace& place, const LaneLevels& levels, unsigned on,
                                         unsigned between, unsigned maps, TexturePoints& p) const {
    for (; on != 0; on &= on - 1) {
      const int lane = __builtin_ctz(on);
      const bool both = (between >> lane & 1u) != 0;
      const LaneQuads &fine = quads[0], &coarse = quads[1];
      const float part = levels.part[lane], fine_x = fine.x[lane], fine_y = fine.y[lane];
      TexelWeights x, y;
      x.set(fine_x, coarse.x[lane]);
      y.set(fine_y, coarse.y[lane]);
      for (int i = 0; i < place.count; ++i) {
        const LaneTexture& t = place.textures[i];
        if ((t.maps & maps) == 0) continue;
        const float* const linear = t.linear_from_srgb8;
        const auto bits = [&](int k) { return texel_bits(t.texels, fine.texel[k][lane]); };
        const auto coarse_bits = [&](int k) { return texel_bits(t.texels, coarse.texel[k][lane]); };
        TexelRow sum = load_row(p.texel[i][lane]);
        if (both) {
          const TexelRows at =
              linear ? mixed_quad(x, y, [&](int k) { return color_rows(bits(k), coarse_bits(k), linear); })
                     : mixed_quad(x, y, [&](int k) { return texel_rows(bits(k), coarse_bits(k)); });
          sum = sum + (at.first() * (1.0f - part) + at.second() * part);
        } else {
          sum = sum + (linear ? mixed_quad(fine_x, fine_y, [&](int k) { return color_row(bits(k), linear); })
                              : mixed_quad(fine_x, fine_y, [&](int k) { return texel_row(bits(k)); }));
        }
        store_row(p.texel[i][lane], sum);
      }
    }
  }
};

// How much of a texture's largest level a pixel sees, at the points of some lanes.
struct LaneFootprints {
  Mask filtered;
  Float longer;            // texels
  Float taps;              // 1 where the texture is not filtered
  Float along_u, along_v;  // the longer side

  LaneFootprints(const TexturePlace& place, const vec2& x, const vec2& y, Mask lanes) {
    const Float one(1.0f), zero(0.0f), width(place.level[0].width), height(place.level[0].height);
    const Float x0 = x.x * width, x1 = x.y * height, y0 = y.x * width, y1 = y.y * height;
    const Float xx = x0 * x0 + x1 * x1, yy = y0 * y0 + y1 * y1;
    longer = sqrt(max(yy, xx));
    filtered = place.levels > 1 ? lanes & (one < longer) & (longer < Float(1.0e18f)) & (zero < xx + yy)
                                : Mask::from_bits(0);
    const Float shorter = max(abs(x0 * y1 - x1 * y0) / longer, one);
    const Float many = -floor(-(longer / shorter));
    taps = select(filtered, min(max(many, one), Float(8.0f)), one);
    along_u = select(filtered, select(yy < xx, x.x, y.x), zero);
    along_v = select(filtered, select(yy < xx, x.y, y.y), zero);
  }
};

// The lanes whose texels, of all that are read there, surely have at least this green, 0 to 1. The texture
// has `least_green`.
inline Mask all_green(const TexturePlace& place, const LaneTexture& texture, const vec2& uv,
                      const LaneFootprints& footprints, float least, Mask lanes) {
  const Float width(place.level[0].width), height(place.level[0].height);
  const Float x = wrapped_texel(floor(within_period(uv.x, place.wrap_u) * width), width, place.wrap_u);
  const Float y = wrapped_texel(floor(within_period(uv.y, place.wrap_v) * height), height, place.wrap_v);
  // Half of the longer side, and one and a half texels of the coarser of the levels. Sides that are no powers
  // of two make a level's texels up to 1.13 times as large.
  const Float apart = max(footprints.longer / footprints.taps, Float(1.0f));
  const Float side_of_texel = from_bits((bits_of(apart) + Int(0x007fffffu)) & Int(0x7f800000u));  // 2^n
  const Float reach =                                                                             // texels
      select(footprints.filtered, Float(0.5f) * footprints.longer + Float(1.7f) * side_of_texel + Float(1.0f),
             Float(2.0f));
  // Further away, the rounding of a tap's coordinate is above a quarter of a texel.
  const Float far(0x1p22f);
  lanes = lanes & (abs(uv.x) * width < far) & (abs(uv.y) * height < far);
  constexpr int kSide = Texture::kGreenSide;
  static_assert(Texture::kGreenReaches == 4);
  lanes = lanes & (reach <= Float(8.0f * kSide));
  if (lanes.bits() == 0) return lanes;
  const auto square_of = [](Float texel) { return to_int(floor(texel * Float(1.0f / kSide))); };
  const auto squares = (as_uint32(place.level[0].width) + kSide - 1) / kSide;
  const Int found = gather(texture.least_green, square_of(y) * Int(squares) + square_of(x), lanes);
  Int green = select(Float(1.0f * kSide) < reach, shift_right<8>(found), found);
  green = select(Float(2.0f * kSide) < reach, shift_right<16>(found), green);
  green = select(Float(4.0f * kSide) < reach, shift_right<24>(found), green);
  return lanes & (Float(least) <= to_float(green & Int(0xffu)) / Float(255.0f));
}

[[gnu::noinline]] void sample_textures(const TexturePlace& place, unsigned wanted, unsigned maps,
                                       TexturePoints& p) {
  const Mask lanes = Mask::from_bits(wanted);
  const LaneFootprints footprints(place, vec2(Float::load(p.change_x[0]), Float::load(p.change_x[1])),
                                  vec2(Float::load(p.change_y[0]), Float::load(p.change_y[1])), lanes);
  const auto& [filtered, longer, taps, along_u, along_v] = footprints;
  const Float zero(0.0f);

  alignas(64) float texels_apart[kMostLanes];
  (longer / taps).store(texels_apart);
  const LaneLevels levels(place, wanted, filtered.bits(), texels_apart);
  const unsigned between = (lanes & (zero < Float::load(levels.part))).bits();

  for (int i = 0; i < place.count; ++i)
    for (unsigned lane = 0; lane < kWidth; ++lane) store_row(p.texel[i][lane], TexelRow{});
  const Float u = Float::load(p.uv[0]), v = Float::load(p.uv[1]);
  Taps tap;
  for (float k = 0.5f;; k += 1.0f) {
    const unsigned on = (lanes & (Float(k) < taps)).bits();
    if (on == 0) break;
    const Float share = Float(k) / taps - Float(0.5f);
    const Float at_u = within_period(u + along_u * share, place.wrap_u);
    const Float at_v = within_period(v + along_v * share, place.wrap_v);
    for (int i = 0; i < 2; ++i)
      if (i == 0 || (on & between) != 0)
        tap.quads[i].find(place, at_u, at_v, Int::load(levels.first[i]), Float::load(levels.width[i]),
                          Float::load(levels.height[i]));
    tap.add(place, levels, on, between, maps, p);
  }
  alignas(64) float count[kMostLanes];
  taps.store(count);
  for (unsigned waiting = wanted; waiting != 0; waiting &= waiting - 1) {
    const int lane = __builtin_ctz(waiting);
    if (count[lane] == 1.0f) continue;
    for (int i = 0; i < place.count; ++i)
      store_row(p.texel[i][lane], load_row(p.texel[i][lane]) / count[lane]);
  }
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
