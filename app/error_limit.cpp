#include "app/error_limit.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "app/parse.h"

namespace pinocchio::app {
namespace {

std::string list(std::span<const std::string_view> metrics) {
  std::string text;
  for (std::size_t i = 0; i < metrics.size(); ++i)
    text += (i == 0 ? "" : i + 1 == metrics.size() ? " or " : ", ") + std::string(metrics[i]);
  return text;
}

}  // namespace

ErrorLimit parse_error_limit(const std::string& text, std::span<const std::string_view> metrics) {
  const std::size_t equals = std::min(text.find('='), text.size());
  ErrorLimit limit{text.substr(0, equals), 0.0};
  std::transform(limit.metric.begin(), limit.metric.end(), limit.metric.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::optional<double> value = parse_double(text.substr(std::min(equals + 1, text.size())));
  if (!value || *value < 0.0 || std::find(metrics.begin(), metrics.end(), limit.metric) == metrics.end())
    throw CLI::ValidationError("--max-error: '" + text + "' is no METRIC=VALUE; METRIC is " + list(metrics) +
                               ", VALUE a number of 0 or more");
  limit.value = *value;
  return limit;
}

}  // namespace pinocchio::app
