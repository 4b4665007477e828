#pragma once

#include <span>
#include <string>
#include <string_view>

namespace pinocchio::app {

// METRIC=VALUE of --max-error.
struct ErrorLimit {
  std::string metric;  // lower case
  double value = 0.0;
};

// Throws CLI::ValidationError where the text is not one of `metrics` (in any case), '=' and a number that is
// not negative.
[[nodiscard]] ErrorLimit parse_error_limit(const std::string& text,
                                           std::span<const std::string_view> metrics);

}  // namespace pinocchio::app
