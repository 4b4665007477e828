#include "core/trace/map_lanes.h"

#include <bit>

#include "core/trace/mapped_material.h"

namespace pinocchio {
namespace {

glm::vec3 load(const MapLanes::Column (&columns)[3], unsigned lane) {
  return {columns[0][lane], columns[1][lane], columns[2][lane]};
}

void store(const glm::vec3& v, unsigned lane, MapLanes::Column (&columns)[3]) {
  for (int axis = 0; axis < 3; ++axis) columns[axis][lane] = v[axis];
}

bool any_component(const glm::vec3& v) {
  return v.x + v.y + v.z > 0.0f;
}

}  // namespace

void map_lanes(const Mesh& mesh, const Footprint& footprint, unsigned lanes, MapLanes& p) {
  p.fresnel = p.reflects = p.transmits = p.blends = 0;
  for (unsigned waiting = lanes; waiting != 0; waiting &= waiting - 1) {
    const auto lane = static_cast<unsigned>(std::countr_zero(waiting));
    const unsigned bit = 1u << lane;
    const MappedMaterial m = mapped_material(
        mesh,
        {p.triangle[lane], load(p.weights, lane), load(p.n_shading, lane), (p.leaving & bit) != 0,
         footprint.at(load(p.origin, lane), load(p.direction, lane), load(p.p_world, lane), p.width[lane])});
    store(m.n_shading, lane, p.n_shading);
    store(m.surface.phong.ambient, lane, p.ambient);
    store(m.surface.phong.diffuse, lane, p.diffuse);
    store(m.surface.phong.specular, lane, p.specular);
    store(m.surface.phong.emission, lane, p.emission);
    store(m.surface.reflectance, lane, p.reflectance);
    store(m.surface.transmittance, lane, p.transmittance);
    p.shininess[lane] = m.surface.phong.shininess;
    p.ior[lane] = m.surface.ior;
    p.alpha[lane] = m.alpha;
    if (m.surface.fresnel) p.fresnel |= bit;
    if (any_component(m.surface.reflectance)) p.reflects |= bit;
    if (any_component(m.surface.transmittance)) p.transmits |= bit;
    if (m.alpha < 1.0f) p.blends |= bit;
  }
}

}  // namespace pinocchio
