// Materials' maps as texture buffers (hybrid/gpu/gpu_maps.cpp), for the shared sources.
//   MAP_USES  what some material has, as bits. What none has is constant, so that no code is made of it: llvmpipe
//             computes both sides of every branch.
#include "scene_fetch.glsl"

#ifdef HAS_MAPS
#include "shared/metallic_roughness.glsl"

uniform samplerBuffer maps_buffer;  // kMapTexels a material with maps; then each texture's levels
uniform samplerBuffer texcoords;    // 2 texels a vertex, for each UV set
uniform samplerBuffer texels;       // RGBA of all textures, level after level, as stored
uniform int vertex_count;
#if defined(HAS_COLORS) || defined(HAS_TANGENTS)
uniform samplerBuffer vertex_quads;  // 1 texel a vertex: colours; then, likewise, tangents
#endif

bool some_has(int bit) { return (MAP_USES >> bit & 1) != 0; }

struct TexelSource {
  int levels;  // in maps_buffer
};

// The level's first texel, its width and its height.
ivec3 level_at(TexelSource source, ivec2 size, int level) {
  vec4 texel = texelFetch(maps_buffer, source.levels + level);  // the first texel is split: high, low 12 bits
  return ivec3(int(texel.x) * 4096 + int(texel.y), texel.zw);
}

int texel_place(int width, int x, int y) { return y * width + x; }

vec4 texel_at(TexelSource source, int i, bool is_color) {
  vec4 texel = texelFetch(texels, i);
  return is_color ? vec4(linear_from_srgb(texel.rgb), texel.a) : texel;
}
float texel_scale(bool is_color) { return 1.0; }

float level_of(float texels) { return log2(texels); }

struct MapPoint {
  uvec3 corners;
  mat3x2 texcoords[2];  // the corners', in each UV set
  vec3 weights;
  vec3 ab;
  vec3 ac;
  vec3 moved_x;  // to the next pixel (moved_on_triangle)
  vec3 moved_y;
};

// The texels of a material's maps at a point.
struct MapTexels {
  int maps;
  MapPoint point;
};

vec4 texel_of(MapTexels texels, int use, bool is_color);

#include "shared/texture_params.glsl"
#include "shared/texture.glsl"
#include "shared/maps.glsl"

// Bits of MAP_USES, after those of the textures.
const int kBlends = kUses;                 // some material blends
const int kSecondTexcoords = kUses + 1;    // some texture is read at the second UV set
const int kOcclusionIsShared = kUses + 2;  // occlusion is read where metallic and roughness are, from the same texture
const int kLayersVary = kUses + 3;  // textures change some material's coat or sheen, or where it has one

// Texels of a material's maps: three for each use of a texture, then what goes with them.
const int kParameters = 3 * kUses;
const int kLayers = kParameters + 6;
const int kMapTexels = kLayers + 2;

struct MapTexcoord {
  vec2 uv;
  vec2 uv_ab;
  vec2 uv_ac;
};

vec4 map_texel(int maps, int i) { return texelFetch(maps_buffer, kMapTexels * maps + i); }

vec2 fetch_texcoord(int set, uint vertex) {
  int first = 2 * (set * vertex_count + int(vertex));
  return vec2(texelFetch(texcoords, first).r, texelFetch(texcoords, first + 1).r);
}

mat3x2 fetch_texcoords(int set, uvec3 corners) {
  return mat3x2(fetch_texcoord(set, corners.x), fetch_texcoord(set, corners.y), fetch_texcoord(set, corners.z));
}

MapPoint map_point(uvec3 corners, vec3 weights, vec3 ab, vec3 ac, vec3 moved_x, vec3 moved_y) {
  mat3x2 first = fetch_texcoords(0, corners);
  mat3x2 second = first;
  if (some_has(kSecondTexcoords)) second = fetch_texcoords(1, corners);
  return MapPoint(corners, mat3x2[2](first, second), weights, ab, ac, moved_x, moved_y);
}

// Width 0: there is no texture.
TextureParams fetch_use(int maps, int use) {
  vec4 place = map_texel(maps, 3 * use);     // place of its levels, how many, width, height
  vec4 axes = map_texel(maps, 3 * use + 1);  // of the transform
  vec4 rest = map_texel(maps, 3 * use + 2);  // its offset, and bits
  int bits = int(rest.z);                    // 1: UV set, 2: nearest, 4 and 8: wrap of u, 16 and 32: of v
  TextureParams t;
  t.source = TexelSource(int(place.x));
  t.levels = int(place.y);
  t.size = ivec2(place.zw);
  t.uv_set = bits & 1;
  t.uv_from_texcoord = mat3x2(axes.xy, axes.zw, rest.xy);
  t.wrap_u = bits >> 2 & 3;
  t.wrap_v = bits >> 4 & 3;
  t.nearest = (bits & 2) != 0;
  return t;
}

MapTexcoord texcoord_of(TextureParams t, MapPoint p) {
  mat3x2 corners = t.uv_set == 0 ? p.texcoords[0] : p.texcoords[1];
  vec2 a = t.uv_from_texcoord * vec3(corners[0], 1.0);
  vec2 b = t.uv_from_texcoord * vec3(corners[1], 1.0);
  vec2 c = t.uv_from_texcoord * vec3(corners[2], 1.0);
  return MapTexcoord(p.weights.x * a + p.weights.y * b + p.weights.z * c, b - a, c - a);
}

vec4 look_up(TextureParams t, MapPoint p, bool is_color) {
  if (t.size.x == 0) return vec4(1.0);
  MapTexcoord at = texcoord_of(t, p);
  TexturePoint where = TexturePoint(at.uv, uv_change(p.moved_x, at.uv_ab, at.uv_ac),
                                    uv_change(p.moved_y, at.uv_ab, at.uv_ac));
  return sample_texture(t, where, is_color);
}

vec4 map_value(int maps, int use, MapPoint p, bool is_color) {
  return some_has(use) ? look_up(fetch_use(maps, use), p, is_color) : vec4(1.0);
}

vec4 texel_of(MapTexels texels, int use, bool is_color) {
  return map_value(texels.maps, use, texels.point, is_color);
}

#if defined(HAS_COLORS) || defined(HAS_TANGENTS)
vec4 weighted_quad(MapPoint p, int first) {
  ivec3 at = first + ivec3(p.corners);
  return p.weights.x * texelFetch(vertex_quads, at.x) + p.weights.y * texelFetch(vertex_quads, at.y) +
         p.weights.z * texelFetch(vertex_quads, at.z);
}
#endif

vec4 vertex_color(MapPoint p) {
#ifdef HAS_COLORS
  return weighted_quad(p, 0);
#else
  return vec4(1.0);
#endif
}

vec3 mapped_normal_at(int maps, MapPoint p, vec3 n) {
  if (!some_has(kNormal)) return n;
  TextureParams t = fetch_use(maps, kNormal);
  if (t.size.x == 0) return n;
  vec4 tangent = vec4(0.0);
#ifdef HAS_TANGENTS
#ifdef HAS_COLORS
  tangent = weighted_quad(p, vertex_count);
#else
  tangent = weighted_quad(p, 0);
#endif
#endif
  MapTexcoord at = texcoord_of(t, p);
  return mapped_normal(n, tangent.xyz, tangent.w, p.ab, p.ac, at.uv_ab, at.uv_ac, look_up(t, p, false).rgb,
                       map_texel(maps, kParameters + 4).x);
}

// Whether the normal map is the clear coat's too.
bool coat_is_mapped(int maps) { return map_texel(maps, kParameters + 4).z > 1.0; }

ShadingParams mapped_material_at(int maps, MapPoint p, ShadingParams plain, inout bool transmits) {
  vec4 base_metallic = map_texel(maps, kParameters);
  vec4 emissive_roughness = map_texel(maps, kParameters + 1);
  vec4 specular = map_texel(maps, kParameters + 2);  // its colour, and factor
  vec4 more = map_texel(maps, kParameters + 3);      // ior, transmission, volume, unlit
  vec4 strengths = map_texel(maps, kParameters + 4); // of normal and occlusion; from_gltf (2: coat_is_mapped), alpha's channel
  vec4 alpha = map_texel(maps, kParameters + 5);     // mode, factor, cut-off; vertex colours
  MapValues v;
  v.base_color = map_value(maps, kBaseColor, p, true).rgb;
  if (alpha.w > 0.0) v.base_color *= vertex_color(p).rgb;
  v.emissive = map_value(maps, kEmissive, p, true).rgb;
  vec4 texel = map_value(maps, kMetallicRoughness, p, false);
  float reached = some_has(kOcclusionIsShared) ? texel.r : map_value(maps, kOcclusion, p, false).r;
  v.occlusion = 1.0 + strengths.y * (reached - 1.0);
  v.roughness = 1.0;
  v.metallic = 1.0;
  v.specular = 1.0;
  v.specular_color = vec3(1.0);
  v.transmission = 1.0;
  if (strengths.z == 0.0) return mapped_phong(material_point(plain), v).shading;
  v.roughness = texel.g;
  v.metallic = texel.b;
  v.specular = map_value(maps, kSpecular, p, false).a;
  v.specular_color = map_value(maps, kSpecularColor, p, true).rgb;
  v.transmission = map_value(maps, kTransmission, p, false).r;
  MetallicRoughness s =
      MetallicRoughness(base_metallic.rgb, base_metallic.a, emissive_roughness.a, emissive_roughness.rgb, more.x,
                        specular.a, specular.rgb, more.y, more.z > 0.0, more.w > 0.0);
  MaterialPoint m = mapped_metallic_roughness(s, v, plain.ggx_alpha == 0.0);
  transmits = m.transmittance != vec3(0.0);
  if (some_has(kLayersVary))
    m = with_layers(m, mapped_layers(fetch_layers(maps_buffer, kMapTexels * maps + kLayers), MapTexels(maps, p)));
  else if (!transmits)
    m.shading.layers = plain.layers;
  return m.shading;
}

float alpha_at(int maps, MapPoint p, vec4 alpha) {
  float result = alpha.y;
  if (some_has(kAlpha)) {
    TextureParams t = fetch_use(maps, kAlpha);
    if (t.size.x > 0)
      result *= sample_point(t, texcoord_of(t, p).uv, false)[int(map_texel(maps, kParameters + 4).w)];
  }
  if (alpha.w > 0.0) result *= vertex_color(p).a;
  return result;
}

// The surface's share of its pixel.
float coverage_at(int maps, MapPoint p) {
  if (!some_has(kBlends)) return 1.0;
  vec4 alpha = map_texel(maps, kParameters + 5);
  return int(alpha.x) == kAlphaBlend ? clamp(alpha_at(maps, p, alpha), 0.0, 1.0) : 1.0;
}

bool hole_at(int maps, MapPoint p) {
  vec4 alpha = map_texel(maps, kParameters + 5);
  return int(alpha.x) != kAlphaOpaque && is_hole(int(alpha.x), alpha_at(maps, p, alpha), alpha.z);
}
#endif
