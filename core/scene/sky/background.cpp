#include "pinocchio/background.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/base/decimal.h"
#include "core/image/tonemap.h"
#include "core/scene/sky/blurred.h"
#include "pinocchio/scene.h"
#include "pinocchio/shadow_catcher.h"
#include "pinocchio/studio.h"

namespace pinocchio {
namespace {

constexpr std::array<std::pair<Background::Kind, std::string_view>, 3> kKinds{
    {{Background::Kind::environment, "environment"},
     {Background::Kind::studio, "studio"},
     {Background::Kind::transparent, "transparent"}}};

// The sixteen names of CSS 1, and those of later versions that pictures are often drawn on.
struct NamedColor {
  std::string_view name;
  std::uint32_t rgb;  // sRGB
};
constexpr std::array kNamedColors{
    NamedColor{"aqua", 0x00ffff},     NamedColor{"black", 0x000000},   NamedColor{"blue", 0x0000ff},
    NamedColor{"darkgray", 0xa9a9a9}, NamedColor{"fuchsia", 0xff00ff}, NamedColor{"gray", 0x808080},
    NamedColor{"green", 0x008000},    NamedColor{"grey", 0x808080},    NamedColor{"lightgray", 0xd3d3d3},
    NamedColor{"lime", 0x00ff00},     NamedColor{"maroon", 0x800000},  NamedColor{"navy", 0x000080},
    NamedColor{"olive", 0x808000},    NamedColor{"orange", 0xffa500},  NamedColor{"purple", 0x800080},
    NamedColor{"red", 0xff0000},      NamedColor{"silver", 0xc0c0c0},  NamedColor{"skyblue", 0x87ceeb},
    NamedColor{"teal", 0x008080},     NamedColor{"white", 0xffffff},   NamedColor{"yellow", 0xffff00}};

Background color_of(const glm::vec3& linear) {
  return {Background::Kind::color, linear};
}

Background color_of(std::uint32_t rgb) {
  const auto channel = [rgb](int shift) {
    return srgb8_to_linear(static_cast<std::uint8_t>(rgb >> shift & 0xffu));
  };
  return color_of(glm::vec3(channel(16), channel(8), channel(0)));
}

template <class T>
std::optional<T> number_of(std::string_view text, T lo, T hi) {
  T value{};
  const auto [end, error] = read_decimal(text, value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value >= lo && value <= hi ? std::optional(value) : std::nullopt;
}

std::optional<Background> hex_color(std::string_view digits) {
  std::uint32_t rgb = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rgb, 16);
  const bool is_whole = error == std::errc() && end == digits.data() + digits.size() && digits.size() == 6;
  return is_whole ? std::optional(color_of(rgb)) : std::nullopt;
}

// r,g,b
std::optional<Background> linear_color(std::string_view text) {
  constexpr float kMost = 65504.0f;  // of a half
  glm::vec3 color;
  for (int c = 0; c < 3; ++c) {
    const std::size_t end = c < 2 ? text.find(',') : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const std::optional<float> value = number_of(text.substr(0, end), 0.0f, kMost);
    if (!value) return std::nullopt;
    color[c] = *value;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return color_of(color);
}

}  // namespace

std::optional<Background> parse_background(std::string_view text) {
  for (const auto& [kind, name] : kKinds)
    if (text == name) return Background{kind};
  for (const NamedColor& named : kNamedColors)
    if (text == named.name) return color_of(named.rgb);
  return text.starts_with('#') ? hex_color(text.substr(1)) : linear_color(text);
}

std::string to_text(const Background& background) {
  for (const auto& [kind, name] : kKinds)
    if (background.kind == kind) return std::string(name);
  const glm::vec3& c = background.color;
  return shortest(c.r) + "," + shortest(c.g) + "," + shortest(c.b);
}

Backdrop backdrop_of(const Scene& scene, const Background& background, float blur) {
  const auto shown = [blur](const std::shared_ptr<const Environment>& picture) {
    return blurred(picture, kWidestBlur_deg * blur);
  };
  if (background.kind == Background::Kind::studio) return {shown(studio_sky())};
  if (background.kind != Background::Kind::environment) return {};
  return {shown(scene.environment), scene.environment_rotation_deg, scene.environment_strength};
}

std::optional<ShadowCatcher> parse_shadow_catcher(std::string_view text) {
  if (text == "off") return ShadowCatcher{};
  if (text == "lowest") return ShadowCatcher{ShadowCatcher::Kind::lowest};
  const std::optional<float> height = number_of(text, -kMostCatcherHeight, kMostCatcherHeight);
  return height ? std::optional(ShadowCatcher{ShadowCatcher::Kind::at, *height}) : std::nullopt;
}

std::string to_text(const ShadowCatcher& catcher) {
  if (catcher.kind == ShadowCatcher::Kind::off) return "off";
  return catcher.kind == ShadowCatcher::Kind::lowest ? "lowest" : shortest(catcher.height);
}

}  // namespace pinocchio
