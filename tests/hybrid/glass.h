// Glass that takes light by Fresnel and Beer, drawn by every schedule and the reference.
#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "core/reference/reference.h"
#include "tests/support/draw.h"

namespace pinocchio {

inline constexpr glm::ivec2 kGlassSize{32, 24}, kLarger{96, 72};
inline constexpr glm::vec3 kColor{0.8f, 0.5f, 0.2f};  // left after kDistance of it
inline constexpr float kDistance = 0.5f;

inline Material matt(float albedo = 0.5f) {
  Material m;
  m.ambient = glm::vec3(0.0f);
  m.diffuse = glm::vec3(albedo * std::numbers::inv_pi_v<float>);
  m.brdf = true;
  return m;
}

inline Material glass(float ior, bool colored) {
  Material m;
  m.ambient = m.diffuse = glm::vec3(0.0f);
  m.transmittance = glm::vec3(1.0f);
  m.ior = ior;
  if (colored) {
    m.attenuation_color = kColor;
    m.attenuation_distance = kDistance;
  }
  return m;
}

struct Way {
  std::string name;
  Settings settings;
};
// Every schedule.
inline std::vector<Way> ways() {
  std::vector<Way> all{{"raytrace", by({{"mode", "raytrace"}})},
                       {"design 1", by({{"design", "1"}})},
                       {"design 2", by({{"design", "2"}})},
                       {"design 1 by camera rays", by({{"design", "1"}})}};
  all.back().settings.visibility = Processor::cpu;
  for (Way& way : all) way.settings.glass_shadows = GlassShadows::tinted;
  return all;
}

inline FrameResult drawn(const Scene& scene, Settings settings, glm::ivec2 size = kGlassSize) {
  return draw_one(scene, {.settings = std::move(settings), .size = size});
}

inline ReferencePicture precise(const Scene& scene, glm::ivec2 size = kGlassSize,
                                GlassShadows shadows = GlassShadows::tinted) {
  Workers workers(2);
  return reference_render(scene, {first_camera(scene), size}, 8, workers, nullptr,
                          {.glass_shadows = shadows});
}

// The sum over the picture of light, red, green and blue.
inline glm::dvec3 sum_of(const Image<glm::vec4>& picture) {
  glm::dvec3 sum(0.0);
  for (const glm::vec4& c : picture.pixels()) sum += glm::dvec3(c);
  return sum;
}

inline glm::vec3 middle(const Image<glm::vec4>& picture) {
  return glm::vec3(picture.at(picture.width() / 2, picture.height() / 2));
}

inline void expect_near(const glm::vec3& a, const glm::vec3& b, float tolerance, const std::string& what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
}

inline glm::vec3 absorbed(float way) {
  return glm::pow(kColor, glm::vec3(way / kDistance));
}

}  // namespace pinocchio
