#pragma once

#include <array>
#include <string_view>

namespace pinocchio {

// The curve that maps light of any strength to a screen's range.
enum class ToneMap { clip, reinhard, aces, neutral };
inline constexpr std::array<std::string_view, 4> kToneMapNames{"clip", "reinhard", "aces", "neutral"};

}  // namespace pinocchio
