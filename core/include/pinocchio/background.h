#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "pinocchio/glm_layout.h"

namespace pinocchio {

class Environment;
struct Scene;

// What is behind the scene: the light along rays that come straight from the camera, also through surfaces
// that blend, and meet nothing else. Light, mirrors and glass keep the environment.
struct Background {
  enum class Kind {
    environment,  // the scene's; black where it has none
    studio,       // the neutral sky of pinocchio/studio.h, whatever lights the scene
    transparent,  // nothing: black, with alpha 0
    color,
  };
  Kind kind = Kind::environment;
  glm::vec3 color{0.0f};  // of Kind::color, linear

  [[nodiscard]] bool is_transparent() const { return kind == Kind::transparent; }
  friend bool operator==(const Background&, const Background&) = default;
};

// The texts that parse_background reads, in words.
inline constexpr std::string_view kBackgroundTexts =
    "environment, studio, transparent, or a colour: #rrggbb (sRGB), r,g,b (linear) or one of 21 names of CSS "
    "(white, skyblue)";
// Nothing where the text is none of them.
[[nodiscard]] std::optional<Background> parse_background(std::string_view text);
// The text that parse_background reads as the same.
[[nodiscard]] std::string to_text(const Background& background);

// A background that is a picture. Null: it is none.
struct Backdrop {
  std::shared_ptr<const Environment> picture;
  float rotation_deg = 0.0f, strength = 1.0f;
};
// blur: how far its light is spread, from 0 to 1, which is a standard deviation of kWidestBlur_deg.
[[nodiscard]] Backdrop backdrop_of(const Scene& scene, const Background& background, float blur = 0.0f);
inline constexpr float kWidestBlur_deg = 30.0f;

}  // namespace pinocchio
