// Water, sky and hills around a boat.
#include "scenes/generator/lake.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "scenes/generator/paint.h"
#include "scenes/generator/smooth.h"

namespace pinocchio {
namespace {

constexpr float kSkyRadius = 300.0f;

// Gentle swell and a fan of finer ripples; small, so that the boat stays recognisable in its mirror.
float wave_height(float x, float z) {
  const float r = std::sqrt(x * x + z * z);
  const float calm = 1.0f / (1.0f + 0.0004f * r * r);
  return calm * (0.022f * std::sin(0.85f * x + 0.40f * z) + 0.014f * std::sin(-0.55f * x + 1.25f * z + 1.0f) +
                 0.008f * std::sin(2.1f * x - 1.3f * z + 2.0f) + 0.005f * std::sin(2.6f * z + 1.7f * x));
}

// Fine near the boat, coarse towards the horizon.
float spread(float t) {
  const float x = 2.0f * t - 1.0f;
  return 24.0f * x + (kSkyRadius - 24.0f) * std::pow(x, 7.0f);
}

void add_water(MeshBuilder& mesh, float scale) {
  Material water = glossy("water", {0.010f, 0.040f, 0.050f}, 0.5f, 300.0f);
  water.reflectance = glm::vec3(0.03f);
  water.fresnel = true;
  mesh.use(water);
  const int side = cells(48, scale);
  mesh.surface(side, side, false, [](float u, float v) {
    const float x = spread(u), z = spread(1.0f - v);
    return glm::vec3(x, wave_height(x, z), z);
  });
}

void add_sky(MeshBuilder& mesh, float scale) {
  constexpr int kBands = 28;
  const int around = cells(28, scale);
  const glm::vec3 horizon(0.92f, 0.70f, 0.50f), low(0.62f, 0.68f, 0.74f), high(0.13f, 0.29f, 0.56f);
  for (int band = 0; band < kBands; ++band) {
    // Narrow bands near the horizon, where the colour changes fast.
    const auto elevation = [](int i) { return 1.5707963f * std::pow(static_cast<float>(i) / kBands, 1.7f); };
    const float e0 = elevation(band) - (band == 0 ? 0.06f : 0.0f), e1 = elevation(band + 1);
    const float t = std::sin(0.5f * (std::max(e0, 0.0f) + e1));
    const glm::vec3 color =
        glm::mix(glm::mix(horizon, low, smooth(0.0f, 0.18f, t)), high, smooth(0.08f, 0.85f, t));
    mesh.use(glowing("sky " + std::to_string(band), color));
    mesh.surface(around, 1, true, [=](float u, float v) {  // seen from within
      const float e = glm::mix(e0, e1, v), phi = 6.2831853f * u;
      const float ring = e1 > 1.57f && v == 1.0f ? 0.0f : std::cos(e);
      return kSkyRadius * glm::vec3(ring * std::cos(phi), std::sin(e), ring * std::sin(phi));
    });
  }
}

// Two ranges of hills, the further one paler.
void add_hills(MeshBuilder& mesh, float scale) {
  const int around = cells(200, scale);
  for (int range = 0; range < 2; ++range) {
    mesh.use(range == 0 ? glowing("far hills", {0.33f, 0.37f, 0.43f})
                        : glowing("near hills", {0.10f, 0.15f, 0.16f}));
    const float radius = 285.0f - 15.0f * static_cast<float>(range), phase = 2.0f * static_cast<float>(range);
    mesh.surface(around, 1, true, [=](float u, float v) {
      const float phi = 6.2831853f * u;
      const float ridge = 9.0f + 4.5f * std::sin(3.0f * phi + phase) +
                          3.0f * std::sin(7.0f * phi + 2.0f * phase) + 1.6f * std::sin(17.0f * phi + phase) +
                          0.8f * std::sin(41.0f * phi);
      const float height = (range == 0 ? 1.5f : 0.75f) * ridge;
      return glm::vec3(radius * std::cos(phi), v == 0.0f ? -2.0f : height, radius * std::sin(phi));
    });
  }
}

}  // namespace

void add_lake(MeshBuilder& mesh, float scale) {
  add_water(mesh, scale);
  add_sky(mesh, scale);
  add_hills(mesh, scale);
}

}  // namespace pinocchio
