#pragma once

#include <array>
#include <string_view>

#include "pinocchio/names.h"

namespace pinocchio {

// What a shadow ray does where it meets a surface that transmits.
enum class GlassShadows {
  opaque,  // it ends: glass casts a full shadow
  tinted,  // it goes straight on, with the share of the light that the glass lets through
};
inline constexpr GlassShadows kUsualGlassShadows = GlassShadows::tinted;  // docs/glass.md has the chart
inline constexpr std::array<std::string_view, 2> kGlassShadowsNames{"opaque", "tinted"};
[[nodiscard]] constexpr std::string_view glass_shadows_name(GlassShadows shadows) {
  return name_of(kGlassShadowsNames, shadows);
}

}  // namespace pinocchio
