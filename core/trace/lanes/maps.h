// Part of walk/kernel.h's files: materials with maps, for the lanes that have one.
#pragma once

#include "core/shade/gltf_surface.h"
#include "core/trace/lanes/material.h"
#include "core/trace/lanes/surface.h"
#include "core/trace/lanes/texture.h"

namespace pinocchio::PINOCCHIO_LANES {
namespace {

static_assert(kMapUses.size() == kUses && kMapUses[kNormal].use == &MaterialMaps::normal &&
              kMapUses[kSheenRoughness].use == &MaterialMaps::sheen_roughness);
static_assert(as_int(AlphaMode::opaque) == kAlphaOpaque && as_int(AlphaMode::mask) == kAlphaMask &&
              as_int(AlphaMode::blend) == kAlphaBlend);

// Where rays with maps meet their triangles, and how far their neighbours are.
struct MapPoints {
  Vec ab, ac;
  bool filters;
  Vec moved_x{Float(0.0f)}, moved_y{Float(0.0f)};  // moved_on_triangle

  // `width`: the rays' cones' at their origins.
  MapPoints(const Footprint& footprint, const Corners& corners, const Vec& origin, const Vec& direction,
            const Vec& p_world, Float width)
      : ab(corners.position[1] - corners.position[0]),
        ac(corners.position[2] - corners.position[0]),
        filters(footprint.angle != 0.0f) {
    if (!filters) return;
    Vec x(footprint.step_x), y(footprint.step_y);
    if (!footprint.parallel && footprint.step_x != glm::vec3(0.0f)) {
      const Float t = dot(p_world - origin, direction) / dot(direction, direction);
      x = t * x;
      y = t * y;
    } else if (!footprint.parallel) {
      const Vec way = p_world - origin, size = abs(direction);
      const Float here = width + Float(footprint.angle) * length(way);
      const Mask by_x = (size.x <= size.y) & (size.x <= size.z), by_y = size.y <= size.z;
      const Vec axis = select(by_x, Vec(Float(1.0f), Float(0.0f), Float(0.0f)),
                              select(by_y, Vec(Float(0.0f), Float(1.0f), Float(0.0f)),
                                     Vec(Float(0.0f), Float(0.0f), Float(1.0f))));
      const Vec across = normalize(cross(direction, axis));
      x = here * across;
      y = here * normalize(cross(direction, across));
    }
    moved_x = moved_on_triangle(x, direction, ab, ac);
    moved_y = moved_on_triangle(y, direction, ab, ac);
  }
};

// A texture coordinate, and its change along the triangle's edges.
struct MapCoordinates {
  vec2 uv, ab, ac;

  MapCoordinates(const SceneArrays& scene, const TexturePlace& place, Int triangle, const Vec& weights,
                 Mask lanes) {
    const Float zero(0.0f);
    vec2 corner[3] = {{zero, zero}, {zero, zero}, {zero, zero}};
    for_each_distinct(triangle, lanes, [&](std::uint32_t id, Mask same) {
      const glm::uvec3& corners = scene.triangles[id];
      const std::uint32_t index[3] = {corners.x, corners.y, corners.z};
#pragma GCC unroll 3
      for (int i = 0; i < 3; ++i) {
        corner[i].x = select(same, Float(place.texcoords[index[i]].x), corner[i].x);
        corner[i].y = select(same, Float(place.texcoords[index[i]].y), corner[i].y);
      }
    });
    const auto& m = place.uv_from_texcoord;
    const auto placed = [&](const vec2& p) {
      return vec2(Float(m[0][0]) * p.x + Float(m[1][0]) * p.y + Float(m[2][0]),
                  Float(m[0][1]) * p.x + Float(m[1][1]) * p.y + Float(m[2][1]));
    };
    uv = placed(weights.x * corner[0] + weights.y * corner[1] + weights.z * corner[2]);
    const vec2 a = placed(corner[0]);
    ab = placed(corner[1]) - a;
    ac = placed(corner[2]) - a;
  }
};

// Zero where the texture is not filtered.
inline vec2 uv_to_neighbour(const MapPoints& points, const Vec& moved, const TexturePlace& place,
                            const MapCoordinates& at) {
  if (points.filters && place.levels > 1) return uv_change(moved, at.ab, at.ac);
  return {Float(0.0f), Float(0.0f)};
}

// A vertex's four numbers (colours, tangents) at the points.
struct VertexQuad {
  Vec xyz;
  Float w;
};
inline VertexQuad weighted_quad(const SceneArrays& scene, const glm::vec4* quads, Int triangle,
                                const Vec& weights, Mask lanes) {
  Float corner[3][4];
  for (auto& quad : corner)
    for (Float& number : quad) number = Float(0.0f);
  for_each_distinct(triangle, lanes, [&](std::uint32_t id, Mask same) {
    const glm::uvec3& corners = scene.triangles[id];
    const std::uint32_t index[3] = {corners.x, corners.y, corners.z};
    for (int i = 0; i < 3; ++i) {
      const glm::vec4& quad = quads[index[i]];
      const float numbers[4] = {quad.x, quad.y, quad.z, quad.w};
      for (int c = 0; c < 4; ++c) corner[i][c] = select(same, Float(numbers[c]), corner[i][c]);
    }
  });
  Float of[4];
  for (int c = 0; c < 4; ++c)
    of[c] = weights.x * corner[0][c] + weights.y * corner[1][c] + weights.z * corner[2][c];
  return {{of[0], of[1], of[2]}, of[3]};
}

inline vec4 texels_of(const TexturePoints::Column (&columns)[4]) {
  return {Float::load(columns[0]), Float::load(columns[1]), Float::load(columns[2]), Float::load(columns[3])};
}

// A material's texels at the points where some of them are; white until they are read.
struct MapTexelLanes : MapTexels {
  vec2 normal_ab, normal_ac;  // the normal map's coordinates along the edges
  bool has_normal = false;

  MapTexelLanes() {
    for (vec4& texel : of) texel = vec4(Float(1.0f));
  }

  [[gnu::noinline]] void read(const SceneArrays& scene, const LaneMaps& maps, const MapPoints& points,
                              Int triangle, const Vec& weights, Mask lanes, unsigned wanted) {
    for (int i = 0; i < maps.count; ++i) {
      const TexturePlace& place = maps.places[i];
      if ((place.maps & wanted) == 0) continue;
      const MapCoordinates at(scene, place, triangle, weights, lanes);
      const vec2 x = uv_to_neighbour(points, points.moved_x, place, at),
                 y = uv_to_neighbour(points, points.moved_y, place, at);
      TexturePoints p;
      at.uv.x.store(p.uv[0]);
      at.uv.y.store(p.uv[1]);
      x.x.store(p.change_x[0]);
      x.y.store(p.change_x[1]);
      y.x.store(p.change_y[0]);
      y.y.store(p.change_y[1]);
      sample_textures(place, lanes.bits(), wanted, p);
      if ((place.maps & wanted & 1u << kNormal) != 0) {
        normal_ab = at.ab;
        normal_ac = at.ac;
        has_normal = true;
      }
      for (int k = 0; k < place.count; ++k)
        if (const unsigned read = place.textures[k].maps & wanted; read != 0)
          set(texels_of(p.texel[k]), read, lanes);
    }
  }

  [[nodiscard]] MapValues values() const {
    MapValues v;
    v.base_color = vec3(of[kBaseColor]);
    v.roughness = of[kMetallicRoughness].y;
    v.metallic = of[kMetallicRoughness].z;
    v.occlusion = of[kOcclusion].x;
    v.emissive = vec3(of[kEmissive]);
    v.specular = of[kSpecular].w;
    v.specular_color = vec3(of[kSpecularColor]);
    v.transmission = of[kTransmission].x;
    return v;
  }

 private:
  void set(const vec4& texel, unsigned maps, Mask lanes) {
    for (; maps != 0; maps &= maps - 1) {
      vec4& to = of[std::countr_zero(maps)];
      to.x = select(lanes, texel.x, to.x);
      to.y = select(lanes, texel.y, to.y);
      to.z = select(lanes, texel.z, to.z);
      to.w = select(lanes, texel.w, to.w);
    }
  }
};

// Not filtered.
[[gnu::noinline]] Float alpha_at(const SceneArrays& scene, const LaneMaps& maps, Int triangle,
                                 const Vec& weights, Mask lanes) {
  Float texel(1.0f);
  if (maps.alpha) {
    const MapCoordinates at(scene, *maps.alpha, triangle, weights, lanes);
    texel = channel_at(*maps.alpha, at.uv, maps.maps->alpha_channel, lanes);
  }
  Float alpha = Float(maps.maps->alpha_factor) * texel;
  if (maps.maps->vertex_colors && scene.colors)
    alpha = alpha * weighted_quad(scene, scene.colors, triangle, weights, lanes).w;
  return alpha;
}

// The reflection model of a material of glTF's at the points.
inline MaterialPoint gltf_material(const MaterialMaps& maps, const Material& plain, const MapValues& v,
                                   const MapTexels& texels) {
  const auto surface = metallic_roughness<MetallicRoughness>(maps.surface);
  const MaterialPoint point = mapped_metallic_roughness(surface, v, !plain.is_microfacet());
  if (!has_layers(maps)) return point;
  return with_layers(point, mapped_layers(layers_of(maps.surface.layers), texels));
}

// Sets what the maps of one material change, for its lanes.
inline void set_material(const MaterialMaps& maps, const Material& plain, const MapValues& v,
                         const MapTexels& texels, Mask same, LaneMaterial& m) {
  const unsigned bits = same.bits();
  if (!maps.from_gltf) {
    m.ambient = select(same, m.ambient * v.base_color, m.ambient);
    m.occlusion = select(same, v.occlusion, m.occlusion);
    m.diffuse = select(same, m.diffuse * v.base_color, m.diffuse);
    m.emission = select(same, m.emission * v.emissive, m.emission);
    return;
  }
  const MaterialPoint point = gltf_material(maps, plain, v, texels);
  const ShadingParams& shading = point.shading;
  m.set_model(shading, plain.is_microfacet(), has_layers(maps), same);
  m.occlusion = select(same, shading.occlusion, m.occlusion);
  m.reflectance = select(same, point.reflectance, m.reflectance);
  m.transmittance = select(same, point.transmittance, m.transmittance);
  m.ior = select(same, point.ior, m.ior);
  m.fresnel = (m.fresnel & ~bits) | (point.fresnel.bits() & bits);
  const auto any_component = [&](const Vec& c) { return (same & (Float(0.0f) < c.x + c.y + c.z)).bits(); };
  m.reflects = (m.reflects & ~bits) | any_component(point.reflectance);
  m.transmits = (m.transmits & ~bits) | any_component(point.transmittance);
}

// The maps that a step reads (bit i: row i of kMapUses): at all points, at those that mirror or transmit, and
// at those where colours change what is mirrored or transmitted.
struct MapsWanted {
  unsigned everywhere = 0, where_mirrored = 0, where_colored = 0;

  MapsWanted() = default;
  // colors: the step returns light of the points themselves. mirrored: it follows what they mirror. facing:
  // it asks which of them face lights.
  MapsWanted(bool colors, bool mirrored, bool facing, bool adds_ambient, bool ambient_light) {
    constexpr unsigned kOfAmbient = 1u << kEmissive, kOfAmbientLight = 1u << kOcclusion;
    constexpr unsigned kColors = 1u << kBaseColor | 1u << kSpecular | 1u << kSpecularColor;
    everywhere = colors || mirrored || facing ? 1u << kNormal : 0u;
    if (facing) everywhere |= 1u << kMetallicRoughness;  // rough surfaces turn their normal to the viewer
    if (colors || mirrored) everywhere |= ~(kOfAmbient | kOfAmbientLight);
    if (adds_ambient) everywhere |= kOfAmbient;
    if (ambient_light) everywhere |= kOfAmbientLight;
    if (colors) return;
    where_colored = everywhere & kColors;
    if (!facing) where_mirrored = everywhere & 1u << kNormal;
    everywhere &= ~(where_colored | where_mirrored);
  }

  [[nodiscard]] static MapsWanted normals() {
    MapsWanted wanted;
    wanted.everywhere = 1u << kNormal;
    return wanted;
  }

  [[nodiscard]] bool any() const { return (everywhere | where_mirrored) != 0; }
  [[nodiscard]] unsigned of_material() const { return (everywhere | where_colored) & ~(1u << kNormal); }
};

// The points that mirror or transmit, and of them those whose colours change it.
struct MirroringPoints {
  Mask all, colored;

  MirroringPoints(const MaterialMaps& maps, const Material& plain, const MapTexelLanes& texels, Mask lanes) {
    if (!maps.from_gltf) {
      all =
          any_component(plain.reflectance) || any_component(plain.transmittance) ? lanes : Mask::from_bits(0);
      colored = Mask::from_bits(0);
      return;
    }
    const MapValues v = texels.values();
    const MaterialPoint whitest = gltf_material(maps, plain, v, texels);
    const Vec& passed = whitest.transmittance;
    const Mask transmits = lanes & (Float(0.0f) < passed.x + passed.y + passed.z);
    all = transmits | (lanes & whitest.fresnel);
    const bool dielectrics = maps.specular.used() || maps.specular_color.used();
    colored =
        dielectrics ? all : transmits | (all & (Float(0.0f) < Float(maps.surface.metallic) * v.metallic));
  }
};

// Points around which all texels are too rough to mirror; it may miss some.
inline Mask surely_rough(const SceneArrays& scene, const LaneMaps& lane_maps, const MapPoints& points,
                         Int triangle, const Vec& weights, Mask lanes) {
  const MaterialMaps& maps = *lane_maps.maps;
  const float roughness = maps.surface.roughness;
  if (!roughness_decides(maps)) return Mask::from_bits(0);
  for (int i = 0; i < lane_maps.count; ++i) {
    const TexturePlace& place = lane_maps.places[i];
    for (int k = 0; k < place.count; ++k) {
      const LaneTexture& texture = place.textures[k];
      if ((texture.maps >> kMetallicRoughness & 1u) == 0 || !texture.least_green) continue;
      const MapCoordinates at(scene, place, triangle, weights, lanes);
      const LaneFootprints footprints(place, uv_to_neighbour(points, points.moved_x, place, at),
                                      uv_to_neighbour(points, points.moved_y, place, at), lanes);
      return all_green(place, texture, at.uv, footprints, kRoughestMirror / roughness, lanes);
    }
  }
  return Mask::from_bits(0);
}

// The lanes whose material mirrors, transmits or blends somewhere.
inline Mask may_show_beyond(const SceneArrays& scene, Int materials, Mask lanes) {
  unsigned found = 0;
  for_each_distinct(materials, lanes, [&](std::uint32_t index, Mask same) {
    const Material& m = scene.materials[index];
    if (pinocchio::may_show_beyond(m, scene.maps[m.maps].maps)) found |= same.bits();
  });
  return Mask::from_bits(found);
}

// Not inlined: it is large, and most packets have no maps.
[[gnu::noinline]] void apply_maps(const Bounce& bounce, const Corners& corners, Int triangle,
                                  const Vec& origin, const Vec& direction, Float width,
                                  const MapsWanted& wanted, LaneSurface& s, LaneMaterial& m) {
  const SceneArrays& scene = bounce.scene;
  Mask mapped = Mask::from_bits(m.mapped);
  if (wanted.where_mirrored != 0) mapped = may_show_beyond(scene, corners.material, mapped);
  if (mapped.bits() == 0) return;
  const MapPoints points(*bounce.footprint, corners, origin, direction, s.p_world, width);
  const Float side = select(s.leaving, Float(-1.0f), Float(1.0f));
  const Vec n_vertices = s.n_shading;
  for_each_distinct(corners.material, mapped, [&](std::uint32_t index, Mask same) {
    const Material& plain = scene.materials[index];
    const LaneMaps& lane_maps = scene.maps[plain.maps];
    const MaterialMaps& maps = *lane_maps.maps;
    const Mask rough = wanted.where_mirrored != 0
                           ? surely_rough(scene, lane_maps, points, triangle, s.weights, same)
                           : Mask::from_bits(0);
    if ((same & ~rough).bits() == 0 && !maps.blends()) return m.show_nothing_beyond(same);
    MapTexelLanes texels;
    const auto read = [&](Mask lanes, unsigned of) {
      if (lanes.bits() != 0) texels.read(scene, lane_maps, points, triangle, s.weights, lanes, of);
      if ((of & 1u << kNormal) == 0 || !texels.has_normal) return;
      VertexQuad tangent{Vec(Float(0.0f)), Float(0.0f)};
      if (scene.tangents) tangent = weighted_quad(scene, scene.tangents, triangle, s.weights, lanes);
      const Vec n = side * mapped_normal(side * n_vertices, tangent.xyz, tangent.w, points.ab, points.ac,
                                         texels.normal_ab, texels.normal_ac, vec3(texels.of[kNormal]),
                                         maps.normal_scale);
      s.n_shading = select(lanes, n, s.n_shading);
      if (maps.coat_is_mapped && has_layers(maps)) m.coat_normal = select(lanes, n, m.coat_normal);
    };
    read(same & ~rough, wanted.everywhere);
    if (maps.blends()) {
      const Float alpha = clamp(alpha_at(scene, lane_maps, triangle, s.weights, same), 0.0f, 1.0f);
      const Mask blends = same & (alpha < Float(1.0f));
      m.alpha = select(blends, alpha, m.alpha);
      m.blends |= blends.bits();
    }
    if (wanted.of_material() == 0) return;
    if (wanted.where_colored != 0) {
      const MirroringPoints mirroring(maps, plain, texels, same);
      if (wanted.where_mirrored != 0 && mirroring.all.bits() == 0 && !maps.blends())
        return m.show_nothing_beyond(same);
      read(mirroring.all, wanted.where_mirrored);
      read(mirroring.colored, wanted.where_colored);
    }
    MapValues v = texels.values();
    v.occlusion = Float(1.0f) + Float(maps.occlusion_strength) * (v.occlusion - Float(1.0f));
    if (maps.vertex_colors && scene.colors)
      v.base_color = v.base_color * weighted_quad(scene, scene.colors, triangle, s.weights, same).xyz;
    set_material(maps, plain, v, texels, same, m);
  });
}

}  // namespace
}  // namespace pinocchio::PINOCCHIO_LANES
