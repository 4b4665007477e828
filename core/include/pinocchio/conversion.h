#pragma once

#include <cstddef>
#include <cstdint>

namespace pinocchio {

// Casts between types of numbers; the caller knows that the value fits. Always inlined: a copy that
// is compiled for one instruction set must not be linked where code for others calls it.
template <class T>
[[nodiscard, gnu::always_inline]] constexpr std::size_t as_size(T value) {
  return static_cast<std::size_t>(value);
}
template <class T>
[[nodiscard, gnu::always_inline]] constexpr int as_int(T value) {
  return static_cast<int>(value);
}
template <class T>
[[nodiscard, gnu::always_inline]] constexpr std::uint32_t as_uint32(T value) {
  return static_cast<std::uint32_t>(value);
}
template <class T>
[[nodiscard, gnu::always_inline]] constexpr float as_float(T value) {
  return static_cast<float>(value);
}
template <class T>
[[nodiscard, gnu::always_inline]] constexpr double as_double(T value) {
  return static_cast<double>(value);
}

}  // namespace pinocchio
