#include "core/trace/jitter.h"

namespace pinocchio {

// The R2 sequence (Roberts 2018), even at any length.
glm::vec2 jitter_of(int k) {
  const glm::dvec2 step(0.75487766624669276, 0.56984029099805327);
  return glm::vec2(glm::fract(0.5 + static_cast<double>(k) * step) - 0.5);
}

View at_sample(View view, int k) {
  view.jitter = jitter_of(k);
  view.sample = k;
  return view;
}

}  // namespace pinocchio
