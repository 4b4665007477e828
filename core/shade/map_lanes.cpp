#include "core/shade/map_lanes.h"

#include <array>
#include <bit>
#include <optional>

#include "core/shade/map_lookup.h"

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

template <class Do>
void for_lanes_of(unsigned lanes, Do act) {
  for (; lanes != 0; lanes &= lanes - 1) act(static_cast<unsigned>(std::countr_zero(lanes)));
}

// A packet's look-ups and their texels.
struct LaneLookups {
  std::array<std::optional<Lookup>, kMostLanes> lookups;
  std::array<MapTexels, kMostLanes> texels;

  // All of `lanes` have these maps.
  void read_texels(const Mesh& mesh, const MaterialMaps& maps, SampleTexture sample, unsigned lanes) {
    for (const MapTexel& map : kMapTexels) {
      const TextureUse& use = maps.*map.use;
      const Lookup& first = *lookups[static_cast<std::size_t>(std::countr_zero(lanes))];
      if (!first.readable(use)) continue;
      if (&use == &maps.occlusion && use == maps.metallic_roughness) {  // channels of one texture, often
        for_lanes_of(lanes, [&](unsigned lane) { texels[lane].occlusion = texels[lane].metallic_roughness; });
        continue;
      }
      TexturePoints points;
      for_lanes_of(lanes, [&](unsigned lane) {
        const shared::texels::TexturePoint point = lookups[lane]->point_on(use);
        for (int axis = 0; axis < 2; ++axis) {
          points.uv[axis][lane] = point.uv[axis];
          points.change_x[axis][lane] = point.change_x[axis];
          points.change_y[axis][lane] = point.change_y[axis];
        }
      });
      sample(lane_texture(mesh, use, map.is_color), lanes, points);
      for_lanes_of(lanes, [&](unsigned lane) {
        for (int c = 0; c < 4; ++c) (texels[lane].*map.texel)[c] = points.texel[c][lane];
      });
    }
  }
};

}  // namespace

void map_lanes(const Mesh& mesh, const Footprint& footprint, SampleTexture sample, unsigned lanes,
               MapLanes& p) {
  p.fresnel = p.reflects = p.transmits = p.blends = p.coat_is_mapped = 0;
  std::array<MapPoint, kMostLanes> points;
  LaneLookups packet;
  for_lanes_of(lanes, [&](unsigned lane) {
    points[lane] = {
        p.triangle[lane], load(p.weights, lane), load(p.n_shading, lane), (p.leaving >> lane & 1) != 0,
        footprint.at(load(p.origin, lane), load(p.direction, lane), load(p.p_world, lane), p.width[lane])};
    packet.lookups[lane].emplace(mesh, points[lane]);
  });
  for (unsigned waiting = lanes; waiting != 0;) {
    const MaterialMaps* const maps =
        mesh.maps_of(p.triangle[static_cast<std::size_t>(std::countr_zero(waiting))]);
    unsigned same = 0;
    for_lanes_of(waiting, [&](unsigned lane) {
      if (mesh.maps_of(p.triangle[lane]) == maps) same |= 1u << lane;
    });
    packet.read_texels(mesh, *maps, sample, same);
    waiting &= ~same;
  }
  for_lanes_of(lanes, [&](unsigned lane) {
    const unsigned bit = 1u << lane;
    const MappedMaterial m = mapped_material(mesh, points[lane], *packet.lookups[lane], packet.texels[lane]);
    store(m.n_shading, lane, p.n_shading);
    store(m.surface.shading.ambient, lane, p.ambient);
    store(m.surface.shading.diffuse, lane, p.diffuse);
    store(m.surface.shading.specular, lane, p.specular);
    store(m.surface.shading.emission, lane, p.emission);
    store(m.surface.reflectance, lane, p.reflectance);
    store(m.surface.transmittance, lane, p.transmittance);
    p.shininess[lane] = m.surface.shading.shininess;
    p.occlusion[lane] = m.surface.shading.occlusion;
    p.ggx_alpha[lane] = m.surface.shading.ggx_alpha;
    p.grazing[lane] = m.surface.shading.grazing;
    p.layer[0][lane] = m.surface.shading.layer.x;
    p.layer[1][lane] = m.surface.shading.layer.y;
    p.ior[lane] = m.surface.ior;
    p.alpha[lane] = m.alpha;
    if (m.surface.fresnel) p.fresnel |= bit;
    if (any_component(m.surface.reflectance)) p.reflects |= bit;
    if (any_component(m.surface.transmittance)) p.transmits |= bit;
    if (m.alpha < 1.0f) p.blends |= bit;
    if ((p.layered & bit) == 0) return;
    store(m.surface.shading.sheen, lane, p.sheen);
    p.sheen_alpha[lane] = m.surface.shading.sheen_alpha;
    p.coat[lane] = m.surface.shading.coat;
    p.coat_alpha[lane] = m.surface.shading.coat_alpha;
    if (mesh.maps_of(p.triangle[lane])->coat_is_mapped) p.coat_is_mapped |= bit;
  });
}

}  // namespace pinocchio
