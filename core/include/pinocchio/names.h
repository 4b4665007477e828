#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "pinocchio/conversion.h"

namespace pinocchio {

// The value of an enumeration whose names are listed in its order; none if `name` is not one of them.
template <class Enum, std::size_t N>
[[nodiscard]] std::optional<Enum> parse_name(const std::array<std::string_view, N>& names,
                                             std::string_view name) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Enum>(found - names.begin());
}

template <class Enum, std::size_t N>
[[nodiscard]] constexpr std::string_view name_of(const std::array<std::string_view, N>& names, Enum value) {
  return names[as_size(value)];
}

}  // namespace pinocchio
