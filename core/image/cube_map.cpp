#include "core/image/cube_map.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/parallel/workers.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

constexpr int kPlaces = 3;  // in a texel of the result, along each side

// The directions of a face: to its centre, to the right of its picture and down. OpenGL's cube maps are seen
// from outside; the extension's faces are mirrored about the vertical axis.
struct FaceAxes {
  glm::vec3 ahead, right, down;
};
constexpr FaceAxes kFaces[] = {{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},  {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                               {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},  {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
                               {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}};

// A face and a place on it: -1 to 1 to the right and down.
struct Place {
  std::size_t face;
  glm::vec2 at;
};
Place place_of(const glm::vec3& direction) {
  const glm::vec3 size = glm::abs(direction);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto face = as_size(2 * axis + (direction[axis] < 0.0f ? 1 : 0));
  const FaceAxes& axes = kFaces[face];
  return {face, glm::vec2(glm::dot(direction, axes.right), glm::dot(direction, axes.down)) / size[axis]};
}

// The texel; beyond the face's edge, the nearest texel of the adjoining face.
const glm::vec3& texel_at(const CubeMap& cube, std::size_t face, glm::ivec2 at) {
  const int side = cube[face].width();
  const auto within = [side](int i) { return i >= 0 && i < side; };
  if (within(at.x) && within(at.y)) return cube[face].at(at.x, at.y);
  const FaceAxes& axes = kFaces[face];
  const glm::vec2 p = (2.0f * glm::vec2(at) + 1.0f) / as_float(side) - 1.0f;
  const Place there = place_of(axes.ahead + p.x * axes.right + p.y * axes.down);
  const glm::ivec2 texel(0.5f * (there.at + 1.0f) * as_float(side));
  return cube[there.face].at(std::clamp(texel.x, 0, side - 1), std::clamp(texel.y, 0, side - 1));
}

}  // namespace

glm::vec3 cube_light(const CubeMap& cube, const glm::vec3& direction) {
  const Place place = place_of(direction);
  const glm::vec2 at = 0.5f * (place.at + 1.0f) * as_float(cube[place.face].width()) - 0.5f;
  const glm::vec2 base = glm::floor(at), f = at - base;
  const glm::ivec2 b(base);
  const glm::vec3 top =
      glm::mix(texel_at(cube, place.face, b), texel_at(cube, place.face, b + glm::ivec2(1, 0)), f.x);
  const glm::vec3 bottom =
      glm::mix(texel_at(cube, place.face, b + glm::ivec2(0, 1)), texel_at(cube, place.face, b + 1), f.x);
  return glm::mix(top, bottom, f.y);
}

Image<glm::vec3> lat_long_of(int side, const std::function<glm::vec3(const glm::vec3&)>& light) {
  const glm::ivec2 size = glm::ivec2(4, 2) * side;
  Image<glm::vec3> image(size);
  Workers workers;
  workers.for_each(size.y, [&](std::size_t row) {
    const int y = row;
    for (int x = 0; x < size.x; ++x) {
      glm::vec3 sum(0.0f);
      for (int k = 0; k < kPlaces * kPlaces; ++k) {
        const glm::vec2 within = (glm::vec2(k % kPlaces, k / kPlaces) + 0.5f) / as_float(kPlaces);
        const glm::vec2 uv = (glm::vec2(x, y) + within) / glm::vec2(size);
        // The picture's middle is +Z, a quarter of the width to its left is +X, the top row is +Y.
        const float turn = glm::two_pi<float>() * (0.5f - uv.x), down = glm::pi<float>() * uv.y;
        const glm::vec3 direction(std::sin(down) * std::sin(turn), std::cos(down),
                                  std::sin(down) * std::cos(turn));
        sum += light(direction);
      }
      image.at(x, y) = sum / as_float(kPlaces * kPlaces);
    }
  });
  return image;
}

Image<glm::vec3> lat_long_of(const CubeMap& cube, const glm::quat& world_from_cube) {
  const glm::quat cube_from_world = glm::inverse(world_from_cube);
  return lat_long_of(cube[0].width(), [&](const glm::vec3& direction) {
    return cube_light(cube, cube_from_world * direction);
  });
}

}  // namespace pinocchio
