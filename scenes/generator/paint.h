#pragma once

#include <glm/glm.hpp>
#include <string>

#include "pinocchio/material.h"

namespace pinocchio {

// Materials by what they look like. Colours are linear.
inline Material matt(const std::string& name, const glm::vec3& color) {
  Material m;
  m.name = name;
  m.ambient = m.diffuse = color;
  return m;
}

inline Material glossy(const std::string& name, const glm::vec3& color, float highlight, float shininess) {
  Material m = matt(name, color);
  m.specular = glm::vec3(highlight);
  m.shininess = shininess;
  return m;
}

// Varnish over the colour: mirrors a little straight on and all at grazing angles.
inline Material lacquered(const std::string& name, const glm::vec3& color, float mirror) {
  Material m = glossy(name, color, 0.6f, 120.0f);
  m.reflectance = glm::vec3(mirror);
  m.fresnel = true;
  return m;
}

inline Material mirror(const std::string& name, const glm::vec3& color) {
  Material m = glossy(name, glm::vec3(0.02f), 0.4f, 200.0f);
  m.reflectance = color;
  return m;
}

inline Material glowing(const std::string& name, const glm::vec3& color) {
  Material m = matt(name, glm::vec3(0.0f));
  m.emission = color;
  return m;
}

inline Material glass(const std::string& name, const glm::vec3& color, float ior) {
  Material m = glossy(name, glm::vec3(0.0f), 0.8f, 400.0f);
  m.transmittance = color;
  m.ior = ior;
  return m;
}

}  // namespace pinocchio
