#include "app/cli/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace pinocchio::app {
namespace {

template <class T>
std::optional<T> parse_number(const std::string& text) {
  T value{};
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || rest != end) return std::nullopt;
  return value;
}

template <class T, std::size_t N>
std::optional<std::array<T, N>> parse_list(const std::vector<std::string>& parts) {
  if (parts.size() != N) return std::nullopt;
  std::array<T, N> values{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::optional<T> value = parse_number<T>(parts[i]);
    if (!value) return std::nullopt;
    values[i] = *value;
  }
  return values;
}

}  // namespace

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::size_t start = 0;
  for (std::size_t at; (at = text.find(separator, start)) != std::string::npos; start = at + 1)
    parts.push_back(text.substr(start, at - start));
  parts.push_back(text.substr(start));
  return parts;
}

std::optional<float> parse_float(const std::string& text) {
  const std::optional<float> value = parse_number<float>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> parse_double(const std::string& text) {
  const std::optional<double> value = parse_number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> parse_milliseconds(const std::string& text) {
  const std::size_t unit_at = std::min(text.find_first_of("ms"), text.size());
  const std::string unit = text.substr(unit_at);
  const std::optional<double> value = parse_double(text.substr(0, unit_at));
  if (!value || *value <= 0.0 || (!unit.empty() && unit != "ms" && unit != "s")) return std::nullopt;
  return unit == "s" ? 1e3 * *value : *value;
}

std::optional<int> parse_int(const std::string& text) {
  return parse_number<int>(text);
}

std::optional<glm::vec3> parse_vec3(const std::string& text) {
  const auto v = parse_list<float, 3>(split(text, ','));
  if (!v || !std::isfinite((*v)[0]) || !std::isfinite((*v)[1]) || !std::isfinite((*v)[2]))
    return std::nullopt;
  return glm::vec3((*v)[0], (*v)[1], (*v)[2]);
}

std::optional<glm::ivec2> parse_size(const std::string& text) {
  const auto v = parse_list<int, 2>(split(text, 'x'));
  if (!v) return std::nullopt;
  return glm::ivec2((*v)[0], (*v)[1]);
}

std::optional<PixelBox> parse_box(const std::string& text) {
  const auto v = parse_list<int, 4>(split(text, ','));
  if (!v) return std::nullopt;
  return PixelBox{{(*v)[0], (*v)[1]}, {(*v)[2], (*v)[3]}};
}

std::optional<Light> parse_light(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() < 3 || parts.size() > 6) return std::nullopt;
  const std::optional<glm::vec3> position = parse_vec3(parts[0] + "," + parts[1] + "," + parts[2]);
  if (!position) return std::nullopt;
  Light light;
  light.name = "--light " + text;
  light.position = *position;
  if (parts.size() > 3) {
    const std::optional<float> intensity = parse_float(parts[3]);
    if (!intensity || *intensity < 0.0f) return std::nullopt;
    light.intensity = *intensity;
  }
  if (parts.size() > 4) {
    if (parts[4] != "cast" && parts[4] != "nocast") return std::nullopt;
    light.casts_shadow = parts[4] == "cast";
  }
  if (parts.size() > 5) {
    const std::optional<float> radius = parse_float(parts[5]);
    if (!radius || *radius < 0.0f) return std::nullopt;
    light.radius = *radius;
  }
  return light;
}

std::optional<FrameRange> parse_frames(const std::string& text) {
  std::string range = text;
  FrameRange frames;
  if (const std::size_t x = range.find('x'); x != std::string::npos) {
    const std::optional<int> step = parse_int(range.substr(x + 1));
    if (!step || *step < 1) return std::nullopt;
    frames.step = *step;
    range.resize(x);
  }
  const std::vector<std::string> parts = split(range, '-');
  if (parts.size() > 2) return std::nullopt;
  const std::optional<int> first = parse_int(parts.front()), last = parse_int(parts.back());
  if (!first || !last || *first < 0 || *last < *first) return std::nullopt;
  frames.first = *first;
  frames.last = *last;
  return frames;
}

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
