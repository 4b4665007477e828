// Numbers as text with a decimal point, in every locale; printf, strtod and streams follow the locale.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>

namespace pinocchio {

// As printf's %.*g in the C locale. Nine digits reproduce every float exactly.
inline std::string decimal(double value, int digits = 6) {
  std::array<char, 64> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, digits).ptr;
  return {text.data(), end};
}

// The shortest text that is read as the same number: 3, 0.5.
template <class T>
std::string shortest(T value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

// Whether a decimal number is nearer to zero than one is.
inline bool is_below_one(std::string_view number) {
  const std::size_t exponent_at = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, exponent_at);
  const std::size_t first = digits.find_first_of("123456789"),
                    point = std::min(digits.find('.'), digits.size());
  if (first == std::string_view::npos) return true;
  long long places = static_cast<long long>(point) - static_cast<long long>(first) + (first > point ? 1 : 0);
  std::string_view exponent = number.substr(std::min(exponent_at + 1, number.size()));
  const bool negative = exponent.starts_with('-');
  if (negative || exponent.starts_with('+')) exponent.remove_prefix(1);
  long long power = 0;
  const auto read = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (read.ec == std::errc::result_out_of_range) return negative;
  return places + (negative ? -power : power) <= 0;
}

// As std::from_chars, but a floating-point number that T cannot hold becomes zero or infinity, as with
// strtod.
template <class T>
std::from_chars_result read_decimal(std::string_view text, T& value) {
  std::from_chars_result result = std::from_chars(text.data(), text.data() + text.size(), value);
  if constexpr (std::is_floating_point_v<T>)
    if (result.ec == std::errc::result_out_of_range) {
      const std::string_view number = text.substr(0, result.ptr - text.data());
      value = is_below_one(number) ? T{0} : std::numeric_limits<T>::infinity();
      if (number.starts_with('-')) value = -value;
      result.ec = std::errc();
    }
  return result;
}

}  // namespace pinocchio
