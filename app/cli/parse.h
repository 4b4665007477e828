// Parsers of the command line's values. Each returns nothing where the text is not one.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/listed.h"
#include "core/parallel/tiles.h"
#include "pinocchio/conversion.h"
#include "pinocchio/light.h"

namespace pinocchio::app {

[[nodiscard]] std::vector<std::string> split(const std::string& text, char separator);
[[nodiscard]] std::optional<float> parse_float(const std::string& text);  // finite
// A parser of numbers from lo to hi.
[[nodiscard]] inline auto number_within(float lo, float hi) {
  return [=](const std::string& text) {
    const std::optional<float> value = parse_float(text);
    return value && *value >= lo && *value <= hi ? value : std::nullopt;
  };
}
[[nodiscard]] std::optional<double> parse_double(const std::string& text);        // finite
[[nodiscard]] std::optional<double> parse_milliseconds(const std::string& text);  // 16, 16ms or 0.5s; above 0
[[nodiscard]] std::optional<int> parse_int(const std::string& text);
[[nodiscard]] std::optional<glm::vec3> parse_vec3(const std::string& text);   // x,y,z
[[nodiscard]] std::optional<glm::ivec2> parse_size(const std::string& text);  // WxH
[[nodiscard]] std::optional<PixelBox> parse_box(const std::string& text);     // x0,y0,x1,y1
[[nodiscard]] std::optional<Light> parse_light(const std::string& text);  // x,y,z[,intensity[,cast|nocast]]

// A-B[xSTEP], or A alone.
struct FrameRange {
  int first = 0, last = 0, step = 1;

  [[nodiscard]] std::size_t count() const {
    return as_size((static_cast<long long>(last) - first) / step + 1);
  }
  [[nodiscard]] int number(std::size_t i) const { return as_int(first + static_cast<long long>(i) * step); }
  [[nodiscard]] bool contains(int number) const {
    return number >= first && number <= last && (static_cast<long long>(number) - first) % step == 0;
  }
};
[[nodiscard]] std::optional<FrameRange> parse_frames(const std::string& text);

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
