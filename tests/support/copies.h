// A glTF in which nodes and EXT_mesh_gpu_instancing place a mesh again and again.
#pragma once

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "tests/support/moving_gltf.h"
#include "tests/support/scenes.h"

namespace pinocchio {

constexpr int kCopies = 30, kFlatCopies = 1;

// Copies of a jagged ball: turned, mirrored, stretched, small, far away, one flat. Every third is an instance
// of one node. A part of the balls is single-sided.
inline Scene load_copies(int copies = kCopies) {
  constexpr int kRings = 36, kAround = 72;
  Moving m;
  Random random(4);
  std::vector<float> positions, normals;
  std::vector<std::uint32_t> corners;
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s < kAround; ++s) {
      const float theta = 3.14159265f * static_cast<float>(r) / kRings,
                  phi = 6.2831853f * static_cast<float>(s) / kAround, size = random.between(0.9f, 1.0f);
      const glm::vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      for (int axis = 0; axis < 3; ++axis) {
        normals.push_back(n[axis]);
        positions.push_back(size * n[axis]);
      }
    }
  for (std::uint32_t r = 0; r < kRings; ++r)
    for (std::uint32_t s = 0; s < kAround; ++s) {
      const std::uint32_t a = r * kAround + s, b = r * kAround + (s + 1) % kAround;
      for (const std::uint32_t corner : {a, b, b + kAround, a, b + kAround, a + kAround})
        corners.push_back(corner);
    }
  m.json["materials"] = {{{"doubleSided", false},
                          {"pbrMetallicRoughness", {{"metallicFactor", 0.7}, {"roughnessFactor", 0.1}}}}};
  m.json["meshes"][0]["primitives"] = {
      {{"attributes", {{"POSITION", m.floats(positions, "VEC3")}, {"NORMAL", m.floats(normals, "VEC3")}}},
       {"indices", m.add(corners, "SCALAR", 5125, corners.size())},
       {"material", 0}}};
  Json nodes = Json::array(), roots = Json::array();
  std::vector<float> translations, rotations, scales;
  for (int i = 0; i < copies; ++i) {
    glm::vec3 place = random_point(random, 4.0f), scale(random.between(0.3f, 1.0f));
    const glm::vec4 turn = glm::normalize(glm::vec4(random_point(random, 1.0f), random.between(0.1f, 1.0f)));
    if (i % 4 == 1) scale.x = -scale.x;
    if (i % 5 == 2) scale *= glm::vec3(0.4f, 1.7f, 1.0f);
    if (i == 7) scale *= 1e-3f;
    if (i == 10) place += glm::vec3(3000.0f, -2000.0f, 500.0f);
    if (i == 13) scale.y = 0.0f;
    if (i == 16) scale = glm::vec3(1.0f), place = glm::vec3(0.0f);
    if (i % 3 == 0) {
      translations.insert(translations.end(), {place.x, place.y, place.z});
      rotations.insert(rotations.end(), {turn.x, turn.y, turn.z, turn.w});
      scales.insert(scales.end(), {scale.x, scale.y, scale.z});
      continue;
    }
    roots.push_back(nodes.size());
    nodes.push_back({{"mesh", 0},
                     {"translation", {place.x, place.y, place.z}},
                     {"rotation", {turn.x, turn.y, turn.z, turn.w}},
                     {"scale", {scale.x, scale.y, scale.z}}});
  }
  roots.push_back(nodes.size());
  nodes.push_back({{"mesh", 0}, {"scale", {1.0, 1.0, -1.5}}});
  nodes.back()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
      {"TRANSLATION", m.floats(translations, "VEC3")},
      {"ROTATION", m.floats(rotations, "VEC4")},
      {"SCALE", m.floats(scales, "VEC3")}};
  m.json["nodes"] = nodes;
  m.json["scenes"][0]["nodes"] = roots;
  return load_good(m.json);
}

}  // namespace pinocchio
