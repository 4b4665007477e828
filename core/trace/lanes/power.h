// Part of walk/kernel.h's files: x^y.
#pragma once

namespace pinocchio::PINOCCHIO_LANES {
namespace {

// log2 of a positive number: its exponent, and the series of artanh for what is left, in [sqrt(1/2),
// sqrt(2)).
[[gnu::always_inline]] inline Double log2_of(Float x) {
  // A denormal number has no exponent of its own.
  const Mask tiny = x < Float(0x1p-126f);
  const Int bits = bits_of(select(tiny, x * Float(0x1p24f), x));
  const Int exponent = shift_right<23>(bits - Int(0x3f3504f3u));  // of sqrt(1/2)
  const Double m(from_bits(bits - shift_left<23>(exponent)));
  const Double s = (m - Double(1.0)) / (m + Double(1.0)), s2 = s * s;
  // 2 / ln 2 / (2 k + 1); what is left out is below 2^-39 of the sum.
  constexpr double k2ByLn2 = 2.8853900817779268;
  Double sum(k2ByLn2 / 13.0);
  for (const double odd : {11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) sum = sum * s2 + Double(k2ByLn2 / odd);
  const Float whole = to_float(exponent) - select(tiny, Float(24.0f), Float(0.0f));
  return Double(whole) + s * sum;
}

// 2^x; beyond what a float holds, zero or infinity.
[[gnu::always_inline]] inline Float exp2_of(const Double& x) {
  const Double t = clamp(x, -200.0, 200.0);
  // A number added to 1.5 * 2^52 loses its fraction, and the whole part is in the lowest bits: with 1023
  // added, they are an exponent of double.
  constexpr double kRound = 0x1.8p52 + 1023.0;
  const Double shifted = t + Double(kRound);
  const Double f = t - (shifted - Double(kRound));  // [-1/2, 1/2]
  // ln 2^k / k!; what is left out is below 2^-32.
  constexpr double kLn2 = 0.69314718055994531;
  double term = 1.0;
  double coefficient[9];
  for (int k = 0; k <= 8; ++k) {
    coefficient[k] = term;
    term *= kLn2 / (k + 1);
  }
  Double sum(coefficient[8]);
  for (int k = 7; k >= 0; --k) sum = sum * f + Double(coefficient[k]);
  return to_float(sum * low_bits_to_exponent(shifted));
}

// x^y for x > 0 and any y, within 0.51 units in the last place (tests/core/trace/trace_tiles_test.cpp holds
// it against libm): the same bits at every width and on every machine.
[[gnu::noinline]] Float power(Float x, Float y) {
  return exp2_of(Double(y) * log2_of(x));
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
