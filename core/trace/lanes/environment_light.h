// Part of walk/kernel.h's files: the environment's light along directions, and directions that find it.
#pragma once

#include "core/base/prefetch.h"
#include "core/scene/sky/brightness.h"
#include "core/trace/lanes/environment_params.h"
#include "core/trace/lanes/shared.h"
#include "pinocchio/conversion.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline EnvironmentParams params_of(const EnvironmentLight& e, Mask lanes) {
  return {{e.pixels, as_uint32(e.size.x), lanes}, e.size, e.turn, e.strength};
}

// Inverts a cumulative distribution: the entry that a number falls into, the place within it, 0 to 1, and its
// probability. Each lane's entries begin at `first`.
struct Found {
  Int index;
  Float within, share;
};
// `index`: where the search begins, that number's guide.
inline Found found_at(const float* ends, Int index, Int first, std::uint32_t count, Float number,
                      Mask lanes) {
  const Int zero(0), one(1), last(count - 1);
  const auto end_of = [&](Int i, Mask m) { return from_bits(gather(ends, first + i, m)); };
  for (;;) {  // the product was rounded
    const Mask inner = lanes & (zero < index), back = inner & (number < end_of(index - one, inner));
    if (!any(back)) break;
    index = select(back, index - one, index);
  }
  for (;;) {
    const Mask inner = lanes & (index < last), on = inner & (end_of(index, inner) <= number);
    if (!any(on)) break;
    index = select(on, index + one, index);
  }
  const Float begin = end_of(index - one, lanes & (zero < index)), share = end_of(index, lanes) - begin;
  return {index, clamp((number - begin) / share, 0.0f, 0x1.fffffep-1f), share};
}

// The place of a number's guide.
inline Int guide_of(Int first, std::uint32_t count, Float number) {
  const Int last(count - 1), i = to_int(number * Float(as_float(count)));
  return first + select(i < last, i, last);
}

// A texel's share of the light among those whose ends begin at `first`.
inline Float share_of(const float* ends, Int first, Int i, Mask lanes) {
  const Float begin = from_bits(gather(ends, first + i - Int(1), lanes & (Int(0) < i)));
  return from_bits(gather(ends, first + i, lanes)) - begin;
}

// The density of a place among those that find_places finds, per unit of u times v.
inline Float density_of_place(const EnvironmentLight& e, const vec2& place, Mask lanes) {
  const Float width(as_float(e.size.x)), height(as_float(e.size.y)), one(1.0f);
  const Int x = to_int(min(floor(place.x * width), width - one));
  const Int y = to_int(min(floor(place.y * height), height - one));
  const Float row = share_of(e.shares.rows, Int(0), y, lanes);
  return row * height * share_of(e.shares.columns, y * Int(as_uint32(e.size.x)), x, lanes) * width;
}

// Requests the lanes' cache lines at from[index].
template <class T>
inline void fetch(const T* from, Int index, Mask lanes) {
  alignas(64) std::uint32_t at[kWidth];
  index.store(at);
  for (unsigned waiting = lanes.bits(); waiting != 0; waiting &= waiting - 1)
    prefetch(from + at[__builtin_ctz(waiting)]);
}

// A place in the picture, and its density per unit of u times v.
struct SampledPlace {
  vec2 at;
  Float density;
};

// Places, each by two numbers in [0, 1). The picture is not black. Each step waits for memory once, for all
// places: the pictures are larger than the caches.
template <std::size_t kPlaces>
inline void find_places(const EnvironmentLight& e, const vec2 (&number)[kPlaces], Mask lanes,
                        SampledPlace (&places)[kPlaces]) {
  const auto width = as_uint32(e.size.x), height = as_uint32(e.size.y);
  const Float across(as_float(width)), down(as_float(height));
  const Int none(0);
  Found row[kPlaces];
  Int first[kPlaces], column[kPlaces];
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const Int guide = gather(e.shares.row_guides, guide_of(none, height, number[k].y), lanes);
    row[k] = found_at(e.shares.rows, guide, none, height, number[k].y, lanes);
    first[k] = row[k].index * Int(width);
    fetch(e.shares.column_guides, guide_of(first[k], width, number[k].x), lanes);
  }
  for (std::size_t k = 0; k < kPlaces; ++k) {
    column[k] = gather(e.shares.column_guides, guide_of(first[k], width, number[k].x), lanes);
    fetch(e.shares.columns, first[k] + column[k], lanes);
    const Int lower = select(row[k].within < Float(0.5f), Int(0), Int(width));
    fetch(e.brightness, first[k] + lower + column[k], lanes);
  }
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const Found found = found_at(e.shares.columns, column[k], first[k], width, number[k].x, lanes);
    places[k] = {
        {(to_float(found.index) + found.within) / across, (to_float(row[k].index) + row[k].within) / down},
        row[k].share * down * found.share * across};
  }
}

// The light's luminance there, in units of the brightest texel's, within an eighth; not zero.
inline Float brightness_at(const EnvironmentLight& e, const vec2& place, Mask lanes) {
  const Float width(as_float(e.size.x)), zero(0.0f), half(0.5f);
  const Float x = place.x * width - half, y = place.y * Float(as_float(e.size.y)) + half;
  const Float column = floor(x), row = floor(y);
  const Int word = gather(
      e.brightness,
      to_int(row) * Int(as_uint32(e.size.x)) + to_int(select(column < zero, column + width, column)), lanes);
  const auto number = [](Int bits) { return from_bits(bits + Int(kLeastBrightness)); };
  constexpr int kUp = kBrightnessShift;
  const Int byte(0xffu << kUp);
  const Float right = x - column;
  const Float above =
      mix(number(shift_left<kUp>(word) & byte), number(shift_left<kUp - 8>(word) & byte), right);
  const Float below =
      mix(number(shift_left<kUp - 16>(word) & byte), number(shift_in_zeros<24 - kUp>(word) & byte), right);
  return mix(above, below, y - row);
}

// Sine and cosine of an angle in revolutions, from -2 to 2: by their series in double, within half a unit in
// the last place and a millionth.
struct Angle {
  Float cosine, sine;
};
inline Angle angle_of(Float revolutions) {
  const Float turn = revolutions - floor(revolutions), quarters = floor(turn * Float(4.0f) + Float(0.5f));
  const Double angle = Double(turn - quarters * Float(0.25f)) * Double(6.283185307179586);  // within pi / 4
  const Double square = angle * angle;
  // What is left out is below 2^-53.
  Double sine(-1.0 / 1307674368000.0), cosine(1.0 / 20922789888000.0);
  for (const double by :
       {1.0 / 6227020800.0, -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0})
    sine = sine * square + Double(by);
  for (const double by : {-1.0 / 87178291200.0, 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0,
                          -1.0 / 720.0, 1.0 / 24.0, -1.0 / 2.0, 1.0})
    cosine = cosine * square + Double(by);
  const Float s = to_float(sine * angle), c = to_float(cosine);
  const Mask first = quarters == Float(1.0f), second = quarters == Float(2.0f),
             third = quarters == Float(3.0f);
  return {select(first, -s, select(second, -c, select(third, s, c))),
          select(first, c, select(second, -s, select(third, -c, s)))};
}

// The area on the sphere of a unit of u times v is this, times the sine of the angle from +Y.
constexpr float kPicturesArea = 2.0f * 3.14159265f * 3.14159265f;

// The density of sampled directions at this one, per steradian.
inline Float density_of_light(const EnvironmentLight& e, const Vec& direction, const vec2& place,
                              Mask lanes) {
  if (!e.shines) return Float(0.0f);
  const Float across = direction.x * direction.x + direction.z * direction.z;
  const Float sine = sqrt(across / (across + direction.y * direction.y));
  return density_of_place(e, place, lanes) / (Float(kPicturesArea) * max(sine, Float(1e-6f)));
}
inline Float density_of_light(const EnvironmentLight& e, const Vec& direction, Mask lanes) {
  return density_of_light(e, direction, environment_place(params_of(e, lanes), direction), lanes);
}

struct EnvironmentSample {
  Vec direction;  // unit
  Float density;  // per steradian
  vec2 place;     // in the picture
};

// Directions that more light comes from are likelier.
template <std::size_t kSamples>
[[gnu::noinline]] void sample_directions(const EnvironmentLight& e, const vec2 (&number)[kSamples],
                                         Mask lanes, EnvironmentSample (&samples)[kSamples]) {
  SampledPlace places[kSamples];
  find_places(e, number, lanes, places);
  for (std::size_t k = 0; k < kSamples; ++k) {
    const vec2& at = places[k].at;
    const Angle around = angle_of(at.x - Float(e.turn)), down = angle_of(Float(0.5f) * at.y);
    samples[k] = {{down.sine * around.sine, down.cosine, -down.sine * around.cosine},
                  places[k].density / (Float(kPicturesArea) * down.sine),
                  at};
  }
}

// The light from there, divided by the direction's density.
inline Vec light_of_sample(const EnvironmentLight& e, const vec2& place, Float density, Mask lanes) {
  return environment_at(params_of(e, lanes), place) / density;
}

[[gnu::noinline]] Vec light_from_environment(const EnvironmentLight& e, const Vec& direction, Mask lanes) {
  return environment_light(params_of(e, lanes), direction);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
