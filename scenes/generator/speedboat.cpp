// A mahogany runabout lying on reflecting water. The bow points along +x; metres; y = 0 is the waterline.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/generator/lake.h"
#include "scenes/generator/mesh_builder.h"
#include "scenes/generator/paint.h"
#include "scenes/generator/scenes.h"
#include "scenes/generator/smooth.h"

namespace pinocchio {
namespace {

constexpr float kLength = 7.0f;
constexpr float kStern = -0.5f * kLength;

// The lines of the hull: u from stern (0) to bow (1).
float sheer_half_beam(float u) {
  const float forward = std::max(0.0f, (u - 0.35f) / 0.65f);
  return (0.98f + 0.14f * smooth(0.0f, 0.4f, u)) * (1.0f - std::pow(forward, 2.4f));
}
float sheer_height(float u) {
  return 0.62f + 0.10f * (1.0f - u) * (1.0f - u) + 0.42f * u * u;
}
float chine_half_beam(float u) {
  return sheer_half_beam(u) * (0.90f - 0.42f * u * u);
}
float chine_height(float u) {
  return 0.02f + 0.42f * u * u * u;
}
float keel_height(float u) {
  return -0.38f + 0.95f * std::pow(std::max(0.0f, (u - 0.62f) / 0.38f), 2.2f);
}

// The stem rakes forward: high points of the bow stand further out.
glm::vec3 station(float u, float y, float z) {
  const float rake = 0.75f * std::pow(u, 4.0f) * (y - keel_height(u));
  return {kStern + kLength * u + rake, y, z};
}

// Topsides from the chine (v = 0) to the sheer (v = 1), with flare; side is +1 (starboard) or -1.
glm::vec3 topside(float u, float v, float side) {
  const float flare = v - 0.35f * u * u * v * (1.0f - v) * 4.0f * 0.5f;
  const float z = glm::mix(chine_half_beam(u), sheer_half_beam(u), flare);
  return station(u, glm::mix(chine_height(u), sheer_height(u), v), side * z);
}

glm::vec3 bottom(float u, float v, float side) {
  return station(u, glm::mix(keel_height(u), chine_height(u), std::pow(v, 1.15f)),
                 side * v * chine_half_beam(u));
}

// The deck, crowned: v across from -1 to 1.
glm::vec3 deck(float u, float v) {
  const float half = sheer_half_beam(u);
  return station(u, sheer_height(u) + 0.13f * half * (1.0f - v * v), v * half);
}

constexpr float kCockpitAft = 0.14f, kCockpitFore = 0.56f;
constexpr float kCoaming = 0.80f;  // of the half beam: where deck ends and cockpit begins
constexpr float kFloorHeight = 0.16f;

struct Paints {
  Material white = lacquered("white topsides", {0.78f, 0.76f, 0.72f}, 0.04f);
  Material red = lacquered("red stripe", {0.50f, 0.02f, 0.015f}, 0.04f);
  Material bottom = glossy("bottom", {0.05f, 0.10f, 0.13f}, 0.2f, 30.0f);
  Material mahogany = lacquered("mahogany", {0.30f, 0.095f, 0.030f}, 0.05f);
  Material plank = lacquered("plank", {0.40f, 0.15f, 0.05f}, 0.05f);
  Material cream = glossy("cream leather", {0.66f, 0.58f, 0.44f}, 0.2f, 15.0f);
  Material floor = matt("floor", {0.18f, 0.14f, 0.10f});
  Material chrome = mirror("chrome", glm::vec3(0.75f));
  Material screen = glass("windscreen", {0.80f, 0.88f, 0.90f}, 1.0f);
  Material black = glossy("black", glm::vec3(0.02f), 0.5f, 60.0f);
};

void add_hull(MeshBuilder& mesh, const Paints& paint, float scale) {
  const int along = cells(44, scale);
  struct Strake {
    float v0, v1;
    int rows;
    const Material& material;
  };
  const std::array<Strake, 3> strakes{{{0.0f, 0.70f, cells(8, scale), paint.white},
                                       {0.70f, 0.84f, cells(2, scale), paint.red},
                                       {0.84f, 1.0f, cells(2, scale), paint.mahogany}}};
  for (const float side : {1.0f, -1.0f}) {
    // u runs so that du x dv points outwards on either side.
    const auto outward = [side](float u) { return side > 0.0f ? u : 1.0f - u; };
    mesh.use(paint.bottom);
    mesh.surface(along, cells(5, scale), false,
                 [&](float u, float v) { return bottom(outward(u), v, side); });
    for (const Strake& strake : strakes) {
      mesh.use(strake.material);
      mesh.surface(along, strake.rows, false, [&](float u, float v) {
        return topside(outward(u), glm::mix(strake.v0, strake.v1, v), side);
      });
    }
  }
  mesh.use(paint.mahogany);  // transom
  mesh.surface(cells(10, scale), cells(6, scale), false, [](float u, float v) {
    const float z = 2.0f * u - 1.0f;
    const glm::vec3 below = bottom(0.0f, std::abs(z), z < 0 ? -1.0f : 1.0f);
    return glm::mix(below, deck(0.0f, z), v);
  });
}

// One piece of deck between two stations and two fractions of the half beam.
void add_deck_piece(MeshBuilder& mesh, float u0, float u1, float v0, float v1, int along, int across) {
  mesh.surface(along, across, false,
               [=](float u, float v) { return deck(glm::mix(u0, u1, u), glm::mix(v1, v0, v)); });
}

void add_decks(MeshBuilder& mesh, const Paints& paint, float scale) {
  // Planks in two shades run from stern to bow.
  constexpr int kPlanks = 12;
  for (const bool light : {false, true}) {
    mesh.use(light ? paint.plank : paint.mahogany);
    for (int i = 0; i < kPlanks; ++i) {
      if ((i % 2 == 1) != light) continue;
      const float v0 = -1.0f + 2.0f * static_cast<float>(i) / kPlanks, v1 = v0 + 2.0f / kPlanks;
      add_deck_piece(mesh, kCockpitFore, 1.0f, v0, v1, cells(18, scale), 1);
      add_deck_piece(mesh, 0.0f, kCockpitAft, v0, v1, cells(4, scale), 1);
    }
  }
  mesh.use(paint.mahogany);
  for (const float side : {1.0f, -1.0f})
    add_deck_piece(mesh, kCockpitAft, kCockpitFore, side > 0 ? kCoaming : -1.0f, side > 0 ? 1.0f : -kCoaming,
                   cells(16, scale), cells(2, scale));
}

glm::vec3 cockpit_rim(float u, float side) {
  return deck(u, side * kCoaming);
}

void add_cockpit(MeshBuilder& mesh, const Paints& paint, float scale) {
  const auto floor_at = [](const glm::vec3& rim) { return glm::vec3(rim.x, kFloorHeight, 0.93f * rim.z); };
  mesh.use(paint.mahogany);
  for (const float side : {1.0f, -1.0f})  // walls, seen from within
    mesh.surface(cells(12, scale), 2, false, [&](float u, float v) {
      const float along = glm::mix(kCockpitAft, kCockpitFore, side > 0 ? 1.0f - u : u);
      const glm::vec3 rim = cockpit_rim(along, side);
      return glm::mix(floor_at(rim), rim, v);
    });
  for (const float u : {kCockpitAft, kCockpitFore})
    mesh.surface(cells(8, scale), 2, false, [&](float t, float v) {
      const float across = (u == kCockpitFore ? 1.0f : -1.0f) * (2.0f * t - 1.0f) * kCoaming;
      const glm::vec3 rim = deck(u, across);
      return glm::mix(floor_at(rim), rim, v);
    });
  mesh.use(paint.floor);
  mesh.surface(cells(8, scale), 2, false, [&](float u, float v) {
    return floor_at(deck(glm::mix(kCockpitAft, kCockpitFore, u), glm::mix(kCoaming, -kCoaming, v)));
  });
}

// A box with round edges: a superellipsoid.
void add_cushion(MeshBuilder& mesh, const glm::vec3& center, const glm::vec3& half, float scale) {
  const auto power = [](float x) { return std::copysign(std::pow(std::abs(x), 0.35f), x); };
  mesh.surface(cells(20, scale), cells(12, scale), true, [&](float u, float v) {
    const float phi = -6.2831853f * u, theta = 3.1415927f * (v - 0.5f);
    const bool pole = v == 0.0f || v == 1.0f;
    const float ring = pole ? 0.0f : power(std::cos(theta));
    return center + half * glm::vec3(ring * power(std::cos(phi)),
                                     pole ? (v > 0.5f ? 1.0f : -1.0f) : power(std::sin(theta)),
                                     ring * power(std::sin(phi)));
  });
}

void add_seats(MeshBuilder& mesh, const Paints& paint, float scale) {
  mesh.use(paint.cream);
  for (const float x : {-1.65f, -0.30f}) {
    add_cushion(mesh, {x, 0.40f, 0.0f}, {0.30f, 0.13f, 0.72f}, scale);
    add_cushion(mesh, {x - 0.32f, 0.66f, 0.0f}, {0.09f, 0.26f, 0.74f}, scale);
  }
}

void add_windscreen(MeshBuilder& mesh, const Paints& paint, float scale) {
  // Swept back: v up, u from port to starboard.
  const auto screen = [](float u, float v) {
    const float across = 2.0f * u - 1.0f;
    const float along = kCockpitFore + 0.055f - 0.075f * across * across;
    const glm::vec3 foot = deck(along, across * 0.84f);
    const float height = 0.40f * (1.0f - 0.35f * across * across * across * across);
    return foot + v * height * glm::vec3(-0.55f, 0.83f, 0.0f) + glm::vec3(0, 0.005f, 0);
  };
  const int across = cells(24, scale);
  mesh.use(paint.screen);
  mesh.surface(across, cells(3, scale), false, [&](float u, float v) { return screen(1.0f - u, v); });
  mesh.use(paint.chrome);
  for (const float v : {0.0f, 1.0f}) {
    std::vector<glm::vec3> path;
    for (int i = 0; i <= across; ++i)
      path.push_back(screen(static_cast<float>(i) / static_cast<float>(across), v));
    mesh.tube(path, 0.016f, cells(7, std::sqrt(scale)));
  }
  for (const float u : {0.0f, 0.5f, 1.0f})
    mesh.tube({screen(u, 0.0f), screen(u, 0.5f), screen(u, 1.0f)}, 0.013f, 6);
}

void add_fittings(MeshBuilder& mesh, const Paints& paint, float scale) {
  const int around = cells(7, std::sqrt(scale));
  mesh.use(paint.chrome);
  for (const float side : {1.0f, -1.0f}) {  // rub rail along the sheer, grab rail on the foredeck
    std::vector<glm::vec3> rub, rail;
    const int steps = cells(36, scale);
    for (int i = 0; i <= steps; ++i) {
      const float t = static_cast<float>(i) / static_cast<float>(steps);
      rub.push_back(topside(0.995f * t, 0.985f, side) + glm::vec3(0, 0, side * 0.012f));
      const float u = glm::mix(0.70f, 0.955f, t);
      const float lift = 0.17f * smooth(0.0f, 0.12f, t) * smooth(1.0f, 0.88f, t);
      rail.push_back(deck(u, side * 0.80f) + glm::vec3(0, lift, 0));
    }
    mesh.tube(rub, 0.022f, around);
    mesh.tube(rail, 0.016f, around);
    for (const float u : {0.755f, 0.83f, 0.905f}) {
      const glm::vec3 foot = deck(u, side * 0.80f);
      mesh.tube({foot, foot + glm::vec3(0, 0.09f, 0), foot + glm::vec3(0, 0.168f, 0)}, 0.011f, 6);
    }
  }
  // Bow light, cleat and flagstaff.
  mesh.sphere(deck(0.93f, 0.0f) + glm::vec3(0, 0.03f, 0), 0.05f, 12);
  const glm::vec3 staff = deck(0.03f, 0.0f);
  mesh.tube({staff, staff + glm::vec3(-0.10f, 0.45f, 0), staff + glm::vec3(-0.20f, 0.9f, 0)}, 0.012f, 6);
  mesh.sphere(staff + glm::vec3(-0.203f, 0.915f, 0), 0.025f, 10);
  mesh.use(paint.black);  // steering wheel
  mesh.place(
      glm::rotate(glm::translate(glm::mat4(1.0f), {0.27f, 0.74f, -0.42f}), glm::radians(62.0f), {0, 0, 1}));
  mesh.torus(glm::vec3(0.0f), 0.17f, 0.016f, cells(24, scale), 8);
  mesh.place(glm::mat4(1.0f));
  mesh.use(paint.red);  // pennant
  const glm::vec3 top = staff + glm::vec3(-0.19f, 0.86f, 0), low = staff + glm::vec3(-0.14f, 0.62f, 0);
  for (const float side : {1.0f, -1.0f})
    mesh.surface(8, 1, false, [&](float u, float v) {
      const float t = side > 0 ? u : 1.0f - u;
      const glm::vec3 edge = glm::mix(glm::mix(low, top, v), glm::mix(low, top, 0.5f), t);
      return edge + glm::vec3(-0.5f * t, 0.0f, 0.05f * std::sin(7.0f * t) + side * 0.001f);
    });
}

// `scale` multiplies the cells along each side of the tessellated surfaces.
MeshData meshes_of(float scale, int about, Progress* progress) {
  begin_phase(progress, "generate", about);
  MeshData data;
  MeshBuilder mesh(data, progress);
  const Paints paint;
  add_hull(mesh, paint, scale);
  add_decks(mesh, paint, scale);
  add_cockpit(mesh, paint, scale);
  add_seats(mesh, paint, scale);
  add_windscreen(mesh, paint, scale);
  add_fittings(mesh, paint, scale);
  add_lake(mesh, scale);
  return data;
}

// Pipes and posts grow less than in proportion to the cells, so the scale is corrected by what came out.
MeshData meshes_of_about(int triangles, Progress* progress) {
  const auto wanted = static_cast<float>(triangles);
  float scale = std::sqrt(wanted / 16000.0f);
  MeshData data = meshes_of(scale, triangles, progress);
  for (int round = 0; round < 3; ++round) {
    const float ratio = wanted / static_cast<float>(data.triangles.size());
    if (ratio > 0.95f && ratio < 1.05f) break;
    scale *= std::sqrt(ratio);
    data = meshes_of(scale, triangles, progress);
  }
  return data;
}

}  // namespace

Scene make_speedboat(int triangles, Progress* progress) {
  Scene scene(meshes_of_about(triangles, progress));
  scene.ambient_light = {0.26f, 0.29f, 0.34f};
  Light sun;
  sun.name = "sun";
  sun.position = {120.0f, 130.0f, 190.0f};  // inside the sky, which would hide it
  sun.color = {1.0f, 0.88f, 0.70f};
  sun.intensity = 0.95f;
  Light sky;
  sky.name = "sky";
  sky.position = {-60.0f, 90.0f, 40.0f};
  sky.color = {0.55f, 0.75f, 1.0f};
  sky.intensity = 0.18f;
  sky.casts_shadow = false;
  scene.lights = {sun, sky};
  scene.cameras = {{"bow", {8.6f, 2.5f, 7.2f}, {0.45f, 0.42f, 0.0f}, {0, 1, 0}, 31.0f},
                   {"stern", {-9.0f, 3.0f, 5.5f}, {-0.3f, 0.4f, 0.0f}, {0, 1, 0}, 32.0f}};
  return scene;
}

}  // namespace pinocchio
