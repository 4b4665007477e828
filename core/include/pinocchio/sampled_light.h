// How environments and rough surfaces are lit: by samples, or by approximations without noise. Settings
// choose.
#pragma once

#include <array>
#include <string_view>

namespace pinocchio {

// How an environment lights surfaces.
enum class EnvironmentMethod {
  sampled,      // by one direction a sample, with its shadow: exact in the mean, with noise
  prefiltered,  // by means over the directions that a surface reflects: no noise, and no shadows of the sky
};
inline constexpr std::array<std::string_view, 2> kEnvironmentMethodNames{"sampled", "prefiltered"};

// What rough surfaces of glTF's model mirror.
enum class Glossy {
  sampled,  // one direction of the lobe a sample
  sharp,    // smooth surfaces a sharp image, which fades out with roughness; rough ones nothing
};
inline constexpr std::array<std::string_view, 2> kGlossyNames{"sampled", "sharp"};

}  // namespace pinocchio
