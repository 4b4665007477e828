// Part of walk/kernel.h's files: shaders/shared/texture.glsl in lanes, operation by operation, so that the
// texels have the bits of one look-up at a time. Where the texels lie is computed for a packet at once, and
// for all textures that are read there. Texels themselves are read a point at a time: gathers take longer.
#pragma once

#include <type_traits>

#include "core/base/prefetch.h"
#include "core/math/log2_series.h"
#include "core/shade/lane_maps.h"
#include "core/simd/texels.h"
#include "core/trace/lanes/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// 0 where t is not finite.
inline Float within_period(Float t, Wrap wrap) {
  if (wrap == Wrap::clamp) return min(max(t, Float(0.0f)), Float(1.0f));
  const float period = wrap == Wrap::mirror ? 2.0f : 1.0f;
  return max(t - Float(period) * floor(t * Float(1.0f / period)), Float(0.0f));
}

// Whole numbers, i from -1 to n, or to 2 n where it is mirrored.
inline Float wrapped_texel(Float i, Float n, Wrap wrap) {
  if (wrap == Wrap::repeat) return select(i < Float(0.0f), i + n, select(n <= i, i - n, i));
  if (wrap == Wrap::mirror) i = select(n <= i, n + n - Float(1.0f) - i, i);
  return min(max(i, Float(0.0f)), n - Float(1.0f));
}

// log2 of a finite positive number.
inline Float level_of(Float texels) {
  const Int bits = bits_of(texels), exponent = shift_right<23>(bits - Int(0x3f3504f3u));  // of sqrt(1/2)
  return to_float(exponent) + log2_series(from_bits(bits - shift_left<23>(exponent)));
}

// The two levels that each lane reads.
struct LaneLevels {
  Int first[2]{Int(0u), Int(0u)};
  Float width[2]{Float(1.0f), Float(1.0f)}, height[2]{Float(1.0f), Float(1.0f)};
  Float part;  // of the second

  // texels_apart: the distance of taps where the texture is filtered.
  LaneLevels(const TexturePlace& place, Mask lanes, Mask filtered, Float texels_apart) {
    const Float most(as_float(place.levels - 1)), zero(0.0f);
    const Float lod =
        select(filtered, min(max(level_of(min(texels_apart, Float(65536.0f))), zero), most), zero);
    const Float fine = floor(lod);
    part = lod - fine;
    for_each_distinct(to_int(fine), lanes, [&](std::uint32_t level, Mask same) {
      for (int i = 0; i < 2; ++i) {
        const TextureLevel& of =
            place.level[as_int(level) + i < place.levels ? as_int(level) + i : as_int(level)];
        first[i] = select(same, Int(of.first), first[i]);
        width[i] = select(same, Float(of.width), width[i]);
        height[i] = select(same, Float(of.height), height[i]);
      }
    });
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

constexpr int kMostTextures = std::extent_v<decltype(TexturePoints::texel)>;

// Those textures of a place that a step reads.
struct ReadTextures {
  int count = 0;
  const char* texels[kMostTextures];
  const float* linear[kMostTextures];  // from sRGB; null: no colour
  int place[kMostTextures];            // index in TexturePlace::textures

  ReadTextures(const TexturePlace& from, unsigned maps) {
    for (int i = 0; i < from.count; ++i) {
      const LaneTexture& t = from.textures[i];
      if ((t.maps & maps) == 0) continue;
      texels[count] = static_cast<const char*>(t.texels);
      linear[count] = t.linear_from_srgb8;
      place[count++] = i;
    }
  }
};

// The four texels about a point, and their shares, as add_texels wants them.
struct LaneQuads {
  unsigned lanes;
  alignas(64) std::uint32_t texel[4][kMostLanes];
  alignas(64) std::uint32_t left_right[2][kMostLanes];

  // first, width, height: the level's. all: what the shares add up to.
  [[gnu::always_inline]] inline void find(const TexturePlace& place, Float u, Float v, Int first, Float width,
                                          Float height, Float all) {
    const Float one(1.0f), zero(0.0f);
    const LanePlaces places(width);
    if (place.nearest) {
      const Int at = first + places.of_row(wrapped_texel(floor(v * height), height, place.wrap_v)) +
                     LanePlaces::along_row(wrapped_texel(floor(u * width), width, place.wrap_u));
      for (auto& column : texel) at.store(column);
      return set_shares(all, zero, zero);
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
    set_shares(all, at_x - base_x, at_y - base_y);
  }

  // Fetches two texels of each quad: in most quads, the others are in the same blocks.
  [[gnu::always_inline]] inline void fetch(const ReadTextures& textures) const {
    for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const std::size_t first = 4 * std::size_t{texel[0][lane]}, last = 4 * std::size_t{texel[3][lane]};
      for (int t = 0; t < textures.count; ++t) {
        prefetch(textures.texels[t] + first);
        prefetch(textures.texels[t] + last);
      }
    }
  }

  // The sums of one channel. texels: where it is in the first texel.
  [[gnu::always_inline]] inline Int sums_of_channel(const char* texels) const {
    alignas(64) std::uint32_t sums[kWidth]{};
    for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const auto times = [&](int k, std::uint32_t share) {
        return share * static_cast<unsigned char>(texels[4 * std::size_t{texel[k][lane]}]);
      };
      const std::uint32_t above = left_right[0][lane], below = left_right[1][lane];
      sums[lane] = times(0, above & 0xffffu) + times(1, above >> 16) + times(2, below & 0xffffu) +
                   times(3, below >> 16);
    }
    return Int::load(sums);
  }

  [[gnu::always_inline]] inline void add(const ReadTextures& textures, TexelSum (*sums)[kWidth]) const {
    for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
      const int lane = __builtin_ctz(waiting);
      const auto at = [&](int k) { return 4 * std::size_t{texel[k][lane]}; };
      const std::size_t at0 = at(0), at1 = at(1), at2 = at(2), at3 = at(3);
      const TexelShares shares(left_right[0][lane], left_right[1][lane]);
      for (int t = 0; t < textures.count; ++t) {
        const char* const texels = textures.texels[t];
        const TexelQuad quad{texels + at0, texels + at1, texels + at2, texels + at3};
        const float* const linear = textures.linear[t];
        linear ? add_colors(quad, shares, linear, sums[t][lane]) : add_texels(quad, shares, sums[t][lane]);
      }
    }
  }

 private:
  [[gnu::always_inline]] inline void set_shares(Float all, Float x, Float y) {
    const Float half(0.5f);
    const Float below = floor(all * y + half);
    for (int row = 0; row < 2; ++row) {
      const Float both = row == 0 ? all - below : below, right = floor(both * x + half);
      (to_int(both - right) | shift_left<16>(to_int(right))).store(left_right[row]);
    }
  }
};

// How much of a texture's largest level a pixel sees, at the points of some lanes.
struct LaneFootprints {
  Mask filtered;
  Float longer, shorter;   // sides, texels
  Float along_u, along_v;  // the longer side

  LaneFootprints(const TexturePlace& place, const vec2& x, const vec2& y, Mask lanes) {
    const Float one(1.0f), zero(0.0f), width(place.level[0].width), height(place.level[0].height);
    const Float x0 = x.x * width, x1 = x.y * height, y0 = y.x * width, y1 = y.y * height;
    const Float xx = x0 * x0 + x1 * x1, yy = y0 * y0 + y1 * y1;
    longer = sqrt(max(yy, xx));
    filtered = place.levels > 1
                   ? lanes & (one < longer) & (longer < Float(shared::kLongestFootprint)) & (zero < xx + yy)
                   : Mask::from_bits(0);
    shorter = max(abs(x0 * y1 - x1 * y0) / longer, one);
    along_u = select(filtered, select(yy < xx, x.x, y.x), zero);
    along_v = select(filtered, select(yy < xx, x.y, y.y), zero);
  }

  // 1 where the texture is not filtered.
  [[nodiscard]] Float taps() const {
    const Float one(1.0f), many = -floor(-(longer / shorter));
    return select(filtered, min(max(many, one), Float(as_float(shared::kMostTaps))), one);
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
  const Float apart =  // of taps, or more
      max(footprints.shorter, footprints.longer * Float(1.0f / as_float(shared::kMostTaps)));
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
  return lanes & (Float(least * 255.0f * 1.000001f) <= to_float(green & Int(0xffu)));
}

[[gnu::noinline]] void sample_textures(const TexturePlace& place, unsigned wanted, unsigned maps,
                                       TexturePoints& p) {
  const Mask lanes = Mask::from_bits(wanted);
  const LaneFootprints footprints(place, vec2(Float::load(p.change_x[0]), Float::load(p.change_x[1])),
                                  vec2(Float::load(p.change_y[0]), Float::load(p.change_y[1])), lanes);
  const auto& [filtered, longer, shorter, along_u, along_v] = footprints;
  const Float taps = footprints.taps();
  const LaneLevels levels(place, lanes, filtered, longer / taps);
  const Float zero(0.0f), whole(shared::kWholeShare), u = Float::load(p.uv[0]), v = Float::load(p.uv[1]);
  const Float of_second = floor(whole * levels.part + Float(0.5f));
  const unsigned between = (zero < of_second).bits();

  // All quads are found, and their texels fetched, before the first is read: memory is what takes the time.
  const ReadTextures textures(place, maps);
  LaneQuads list[2 * shared::kMostTaps];
  int count = 0;
  for (float k = 0.5f;; k += 1.0f) {
    const unsigned on = (lanes & (Float(k) < taps)).bits();
    if (on == 0) break;
    const Float share = Float(k) / taps - Float(0.5f);
    const Float at_u = within_period(u + along_u * share, place.wrap_u);
    const Float at_v = within_period(v + along_v * share, place.wrap_v);
    for (int i = 0; i < 2; ++i) {
      LaneQuads& quads = list[count];
      quads.lanes = i == 0 ? on : on & between;
      if (quads.lanes == 0) continue;
      quads.find(place, at_u, at_v, levels.first[i], levels.width[i], levels.height[i],
                 i == 0 ? whole - of_second : of_second);
      quads.fetch(textures);
      ++count;
    }
  }

  TexelSum sums[kMostTextures][kWidth];
  for (int t = 0; t < textures.count; ++t)
    for (TexelSum& sum : sums[t]) sum.clear();
  for (int i = 0; i < count; ++i) list[i].add(textures, sums);
  for (int t = 0; t < textures.count; ++t) {
    const float* rows[2][kWidth];
    for (unsigned lane = 0; lane < kWidth; ++lane) {
      rows[0][lane] = sums[t][lane].above;
      rows[1][lane] = sums[t][lane].below;
    }
    Float above[4], below[4];
    load_columns(rows[0], above);
    load_columns(rows[1], below);
    const bool is_color = textures.linear[t] != nullptr;
    for (int c = 0; c < 4; ++c) {
      const Float sum = is_color ? above[c] + below[c] : to_float(bits_of(above[c]) + bits_of(below[c]));
      (sum / (whole * taps * Float(is_color ? 1.0f : 255.0f))).store(p.texel[textures.place[t]][c]);
    }
  }
}

// A channel of the place's only texture, not filtered: the bits of sample_textures.
[[gnu::noinline]] Float channel_at(const TexturePlace& place, const vec2& uv, int channel, Mask lanes) {
  const TextureLevel& level = place.level[0];
  const Float whole(shared::kWholeShare);
  LaneQuads quads;
  quads.lanes = lanes.bits();
  quads.find(place, within_period(uv.x, place.wrap_u), within_period(uv.y, place.wrap_v), Int(level.first),
             Float(level.width), Float(level.height), whole);
  const Int sums = quads.sums_of_channel(static_cast<const char*>(place.textures[0].texels) + channel);
  return to_float(sums) / (whole * Float(255.0f));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
