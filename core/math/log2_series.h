#pragma once

namespace pinocchio {

// log2 of m from sqrt(1/2) to sqrt(2), by the series of artanh; what is left out is below 2^-20. Number:
// float, or lanes of floats, with the same bits.
template <class Number>
[[nodiscard, gnu::always_inline]] inline Number log2_series(Number m) {
  const Number one(1.0f), s = (m - one) / (m + one), s2 = s * s;
  constexpr float k2ByLn2 = 2.8853901f;
  Number sum(k2ByLn2 / 7.0f);
  for (const float odd : {5.0f, 3.0f, 1.0f}) sum = sum * s2 + Number(k2ByLn2 / odd);
  return s * sum;
}

}  // namespace pinocchio
