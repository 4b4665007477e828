#pragma once

#include <algorithm>

namespace pinocchio {

// 0 up to `from`, 1 beyond `to`, level at both ends (as GLSL's smoothstep).
inline float smooth(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace pinocchio
