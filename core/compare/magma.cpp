#include "core/compare/magma.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kKnots = 17;

// Every sixteenth of the map's 256 colours, and the last. Colours between them are interpolated.
const std::array<glm::vec3, kKnots> kColors{{
    {0, 0, 4},
    {10, 8, 34},
    {29, 17, 71},
    {54, 16, 107},
    {81, 18, 124},
    {106, 28, 129},
    {131, 38, 129},
    {156, 46, 127},
    {183, 55, 121},
    {208, 65, 111},
    {231, 82, 99},
    {245, 107, 92},
    {252, 137, 97},
    {254, 167, 114},
    {254, 196, 136},
    {253, 226, 163},
    {252, 253, 191},
}};

glm::u8vec3 color(float error) {
  const float at = 255.0f * std::clamp(error, 0.0f, 1.0f);  // in the map's steps
  const int knot = std::min(as_int(at / 16.0f), kKnots - 2);
  const float first = 16.0f * knot;
  const float length = knot == kKnots - 2 ? 15.0f : 16.0f;  // the last colour is the 255th, not the 256th
  const auto i = as_size(knot);
  return glm::u8vec3(glm::mix(kColors[i], kColors[i + 1], (at - first) / length) + 0.5f);
}

}  // namespace

Image<glm::u8vec3> magma(const Image<float>& errors) {
  Image<glm::u8vec3> colors(errors.size());
  std::transform(errors.pixels().begin(), errors.pixels().end(), colors.pixels().begin(), color);
  return colors;
}

}  // namespace pinocchio
