#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace pinocchio {

// A ground that shows nothing but the light that the scene takes from it: a horizontal plane, seen
// from above where rays straight from the camera meet nothing else. A pixel's alpha there is the share of
// light, in luminance, that a white matt plane would lose to shadows. Light, mirrors and glass do not see it.
struct ShadowCatcher {
  enum class Kind {
    off,
    lowest,  // at the lowest point of the scene
    at,      // at `height`
  };
  Kind kind = Kind::off;
  float height = 0.0f;  // of Kind::at: world y, scene units

  friend bool operator==(const ShadowCatcher&, const ShadowCatcher&) = default;
};

inline constexpr float kMostCatcherHeight = 1e9f;
// The texts that parse_shadow_catcher reads, in words.
inline constexpr std::string_view kShadowCatcherTexts = "off, lowest or a height from -1e9 to 1e9";
// Nothing where the text is none of them.
[[nodiscard]] std::optional<ShadowCatcher> parse_shadow_catcher(std::string_view text);
// The text that parse_shadow_catcher reads as the same.
[[nodiscard]] std::string to_text(const ShadowCatcher& catcher);

}  // namespace pinocchio
