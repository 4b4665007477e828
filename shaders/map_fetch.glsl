// Materials' maps as texture buffers (hybrid/gpu/gpu_maps.cpp), for the shared sources. Expects scene_fetch.glsl
// before it.
#ifdef HAS_MAPS
#include "shared/metallic_roughness.glsl"

uniform samplerBuffer maps_buffer;  // kMapTexels a material with maps
uniform samplerBuffer texcoords;    // 2 texels a vertex, for each UV set
uniform samplerBuffer texels;       // RGBA of all textures, level after level, as stored
uniform int vertex_count;
#if defined(HAS_COLORS) || defined(HAS_TANGENTS)
uniform samplerBuffer vertex_quads;  // 1 texel a vertex: colours; then, likewise, tangents
#endif

struct TexelSource {
  int first;
};

vec4 texel_at(TexelSource source, int i, bool is_color) {
  vec4 texel = texelFetch(texels, source.first + i);
  return is_color ? vec4(linear_from_srgb(texel.rgb), texel.a) : texel;
}

#include "shared/texture.glsl"
#include "shared/maps.glsl"

// Texels of a material's maps: three for each use of a texture, then what goes with them.
const int kBaseColor = 0;
const int kMetallicRoughness = 3;
const int kNormal = 6;
const int kOcclusion = 9;
const int kEmissive = 12;
const int kAlpha = 15;
const int kParameters = 18;
#ifdef HAS_DIELECTRIC_MAPS
const int kSpecular = 24;
const int kSpecularColor = 27;
const int kTransmission = 30;
const int kLayers = 33;
#else
const int kLayers = 24;
#endif
#ifdef HAS_LAYER_MAPS
const int kClearcoat = kLayers + 2;
const int kClearcoatRoughness = kLayers + 5;
const int kSheenColor = kLayers + 8;
const int kSheenRoughness = kLayers + 11;
const int kMapTexels = kLayers + 14;
#else
const int kMapTexels = kLayers;
#endif

struct MapPoint {
  uvec3 corners;
  vec3 weights;
  vec3 ab;
  vec3 ac;
  vec3 moved_x;  // to the next pixel (moved_on_triangle)
  vec3 moved_y;
};

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

// Width 0: there is no texture.
TextureParams fetch_use(int maps, int use) {
  vec4 place = map_texel(maps, use);     // first texel (high, low 12 bits), width, height
  vec4 axes = map_texel(maps, use + 1);  // of the transform
  vec4 rest = map_texel(maps, use + 2);  // its offset, levels, and bits
  int bits = int(rest.w);                // 1: UV set, 2: nearest, 4 and 8: wrap of u, 16 and 32: of v
  TextureParams t;
  t.source = TexelSource(int(place.x) * 4096 + int(place.y));
  t.size = ivec2(place.zw);
  t.levels = int(rest.z);
  t.uv_set = bits & 1;
  t.uv_from_texcoord = mat3x2(axes.xy, axes.zw, rest.xy);
  t.wrap_u = bits >> 2 & 3;
  t.wrap_v = bits >> 4 & 3;
  t.nearest = (bits & 2) != 0;
  return t;
}

MapTexcoord texcoord_of(TextureParams t, MapPoint p) {
  vec2 a = t.uv_from_texcoord * vec3(fetch_texcoord(t.uv_set, p.corners.x), 1.0);
  vec2 b = t.uv_from_texcoord * vec3(fetch_texcoord(t.uv_set, p.corners.y), 1.0);
  vec2 c = t.uv_from_texcoord * vec3(fetch_texcoord(t.uv_set, p.corners.z), 1.0);
  return MapTexcoord(p.weights.x * a + p.weights.y * b + p.weights.z * c, b - a, c - a);
}

vec4 look_up(TextureParams t, MapPoint p, bool is_color) {
  if (t.size.x == 0) return vec4(1.0);
  MapTexcoord at = texcoord_of(t, p);
  TexturePoint where = TexturePoint(at.uv, uv_change(p.moved_x, at.uv_ab, at.uv_ac),
                                    uv_change(p.moved_y, at.uv_ab, at.uv_ac));
  return sample_texture(t, where, is_color);
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
  v.base_color = look_up(fetch_use(maps, kBaseColor), p, true).rgb;
  if (alpha.w > 0.0) v.base_color *= vertex_color(p).rgb;
  v.emissive = look_up(fetch_use(maps, kEmissive), p, true).rgb;
  v.occlusion = 1.0 + strengths.y * (look_up(fetch_use(maps, kOcclusion), p, false).r - 1.0);
  v.roughness = 1.0;
  v.metallic = 1.0;
  v.specular = 1.0;
  v.specular_color = vec3(1.0);
  v.transmission = 1.0;
  v.layers = GltfLayers(1.0, 1.0, vec3(1.0), 1.0);
  if (strengths.z == 0.0) return mapped_phong(material_point(plain), v).shading;
  vec4 texel = look_up(fetch_use(maps, kMetallicRoughness), p, false);
  v.roughness = texel.g;
  v.metallic = texel.b;
#ifdef HAS_DIELECTRIC_MAPS
  v.specular = look_up(fetch_use(maps, kSpecular), p, false).a;
  v.specular_color = look_up(fetch_use(maps, kSpecularColor), p, true).rgb;
  v.transmission = look_up(fetch_use(maps, kTransmission), p, false).r;
#endif
  MetallicRoughness s =
      MetallicRoughness(base_metallic.rgb, base_metallic.a, emissive_roughness.a, emissive_roughness.rgb, more.x,
                        specular.a, specular.rgb, more.y, more.z > 0.0, more.w > 0.0);
  MaterialPoint m = mapped_metallic_roughness(s, v, plain.ggx_alpha == 0.0);
  transmits = m.transmittance != vec3(0.0);
#ifdef HAS_LAYER_MAPS
  vec4 coat = map_texel(maps, kLayers);  // factor, roughness; sheen's roughness
  GltfLayers layers;
  layers.coat = coat.x * look_up(fetch_use(maps, kClearcoat), p, false).r;
  layers.coat_roughness = coat.y * look_up(fetch_use(maps, kClearcoatRoughness), p, false).g;
  layers.sheen = map_texel(maps, kLayers + 1).rgb * look_up(fetch_use(maps, kSheenColor), p, true).rgb;
  layers.sheen_roughness = coat.z * look_up(fetch_use(maps, kSheenRoughness), p, false).a;
  m = with_layers(m, layers);
#else
  if (!transmits) {
    m.shading.sheen = plain.sheen;
    m.shading.sheen_alpha = plain.sheen_alpha;
    m.shading.coat = plain.coat;
    m.shading.coat_alpha = plain.coat_alpha;
  }
#endif
  return m.shading;
}

float alpha_at(int maps, MapPoint p, vec4 alpha) {
  float result = alpha.y;
  TextureParams t = fetch_use(maps, kAlpha);
  if (t.size.x > 0)
    result *= sample_point(t, texcoord_of(t, p).uv, false)[int(map_texel(maps, kParameters + 4).w)];
  if (alpha.w > 0.0) result *= vertex_color(p).a;
  return result;
}

// The surface's share of its pixel.
float coverage_at(int maps, MapPoint p) {
  vec4 alpha = map_texel(maps, kParameters + 5);
  return int(alpha.x) == kAlphaBlend ? clamp(alpha_at(maps, p, alpha), 0.0, 1.0) : 1.0;
}

bool hole_at(int maps, MapPoint p) {
  vec4 alpha = map_texel(maps, kParameters + 5);
  return int(alpha.x) != kAlphaOpaque && is_hole(int(alpha.x), alpha_at(maps, p, alpha), alpha.z);
}
#endif
