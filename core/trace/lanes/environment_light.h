// Part of walk/kernel.h's files: the environment's light along directions, and directions that find it.
#pragma once

#include "core/trace/lanes/environment_params.h"
#include "core/trace/lanes/shared.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

inline EnvironmentParams params_of(const EnvironmentLight& e, Mask lanes) {
  return {{e.pixels, static_cast<std::uint32_t>(e.size.x), lanes}, e.size, e.turn, e.strength};
}

// Where numbers fall among ends that grow to 1: index and place within, 0 to 1. Each lane's ends begin at
// `first`.
struct Found {
  Int index;
  Float within;
};
inline Found found_at(const float* ends, const std::uint32_t* guides, Int first, std::uint32_t count,
                      Float number, Mask lanes) {
  const Int zero(0), one(1), last(count - 1);
  const auto least = [](Int a, Int b) { return select(a < b, a, b); };
  const auto end_of = [&](Int i, Mask m) { return from_bits(gather(ends, first + i, m)); };
  Int index = gather(guides, first + least(to_int(number * Float(static_cast<float>(count))), last), lanes);
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
  const Float begin = end_of(index - one, lanes & (zero < index));
  return {index, clamp((number - begin) / (end_of(index, lanes) - begin), 0.0f, 0x1.fffffep-1f)};
}

// A texel's share of the light among those whose ends begin at `first`.
inline Float share_of(const float* ends, Int first, Int i, Mask lanes) {
  const Float begin = from_bits(gather(ends, first + i - Int(1), lanes & (Int(0) < i)));
  return from_bits(gather(ends, first + i, lanes)) - begin;
}

// The density of a place among those that sampled_place finds, per unit of u times v.
inline Float density_of_place(const EnvironmentLight& e, const vec2& place, Mask lanes) {
  const Float width(static_cast<float>(e.size.x)), height(static_cast<float>(e.size.y)), one(1.0f);
  const Int x = to_int(min(floor(place.x * width), width - one));
  const Int y = to_int(min(floor(place.y * height), height - one));
  const Float row = share_of(e.shares.rows, Int(0), y, lanes);
  return row * height * share_of(e.shares.columns, y * Int(static_cast<std::uint32_t>(e.size.x)), x, lanes) *
         width;
}

// A place in the picture by two numbers in [0, 1). The picture is not black.
inline vec2 sampled_place(const EnvironmentLight& e, const vec2& number, Mask lanes) {
  const auto width = static_cast<std::uint32_t>(e.size.x), height = static_cast<std::uint32_t>(e.size.y);
  const Found row = found_at(e.shares.rows, e.shares.row_guides, Int(0), height, number.y, lanes);
  const Found column =
      found_at(e.shares.columns, e.shares.column_guides, row.index * Int(width), width, number.x, lanes);
  return {(to_float(column.index) + column.within) / Float(static_cast<float>(e.size.x)),
          (to_float(row.index) + row.within) / Float(static_cast<float>(e.size.y))};
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
inline Float density_of_light(const EnvironmentLight& e, const Vec& direction, Mask lanes) {
  if (!e.shines) return Float(0.0f);
  const Vec d = normalize(direction);
  const Float sine = sqrt(d.x * d.x + d.z * d.z);
  return density_of_place(e, environment_place(params_of(e, lanes), d), lanes) /
         (Float(kPicturesArea) * max(sine, Float(1e-6f)));
}

struct EnvironmentSample {
  Vec direction;  // unit
  Vec light;      // from there, divided by the direction's density
  Float density;  // per steradian
};

// Directions that more light comes from are likelier.
[[gnu::noinline]] EnvironmentSample sampled_environment(const EnvironmentLight& e, const vec2& number,
                                                        Mask lanes) {
  const vec2 place = sampled_place(e, number, lanes);
  const Angle around = angle_of(place.x - Float(e.turn)), down = angle_of(Float(0.5f) * place.y);
  const Float share = Float(kPicturesArea) * down.sine / density_of_place(e, place, lanes);
  return {{down.sine * around.sine, down.cosine, -down.sine * around.cosine},
          environment_at(params_of(e, lanes), place) * share,
          Float(1.0f) / share};
}

[[gnu::noinline]] Vec light_from_environment(const EnvironmentLight& e, const Vec& direction, Mask lanes) {
  return environment_light(params_of(e, lanes), direction);
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
