#include "app/run/error_limit.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "app/cli/parse.h"

namespace pinocchio::app {
ErrorLimit parse_error_limit(const std::string& text, std::span<const std::string_view> metrics) {
  const std::size_t equals = std::min(text.find('='), text.size());
  ErrorLimit limit{text.substr(0, equals), 0.0};
  std::transform(limit.metric.begin(), limit.metric.end(), limit.metric.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  const std::optional<double> value = parse_double(text.substr(std::min(equals + 1, text.size())));
  if (!value || *value < 0.0 || std::find(metrics.begin(), metrics.end(), limit.metric) == metrics.end())
    throw CLI::ValidationError("--max-error: '" + text + "' is not METRIC=VALUE; METRIC is " +
                               listed(metrics, ", ", " or ") + ", VALUE a number of 0 or more");
  limit.value = *value;
  return limit;
}

}  // namespace pinocchio::app
