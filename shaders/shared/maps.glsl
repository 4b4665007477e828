// Source of GLSL and of C++ (bench/one_ray/shared_maps.h, core/trace/lanes/shared.h): a material with textures, vertex
// colours and alpha. Expects metallic_roughness.glsl.

// The textures of a material, in the order of kMapUses (pinocchio/material_maps.h): bits of MAP_USES and of the lanes'
// maps, and places in a material's texels.
const int kBaseColor = 0;
const int kMetallicRoughness = 1;
const int kNormal = 2;
const int kOcclusion = 3;
const int kEmissive = 4;
const int kAlpha = 5;
const int kSpecular = 6;
const int kSpecularColor = 7;
const int kTransmission = 8;
const int kClearcoat = 9;
const int kClearcoatRoughness = 10;
const int kSheenColor = 11;
const int kSheenRoughness = 12;
const int kUses = 13;

// The maps' values at the point; all ones where there is no texture.
struct MapValues {
  vec3 base_color;  // times the vertex colour
  real metallic;
  real roughness;
  real occlusion;  // strength applied
  vec3 emissive;
  real specular;
  vec3 specular_color;
  real transmission;
};

SHARED MaterialPoint mapped_phong(READ_ONLY(MaterialPoint) plain, READ_ONLY(MapValues) v) {
  MaterialPoint m = plain;
  m.shading.ambient *= v.base_color;
  m.shading.occlusion = v.occlusion;
  m.shading.diffuse *= v.base_color;
  m.shading.emission *= v.emissive;
  return m;
}

SHARED MaterialPoint mapped_metallic_roughness(READ_ONLY(MetallicRoughness) plain, READ_ONLY(MapValues) v,
                                               bool as_phong) {
  MetallicRoughness s = plain;
  s.base_color *= v.base_color;
  s.metallic *= v.metallic;
  s.roughness *= v.roughness;
  s.emissive *= v.emissive;
  s.specular *= v.specular;
  s.specular_color *= v.specular_color;
  s.transmission *= v.transmission;
  MaterialPoint m = from_metallic_roughness(s, as_phong);
  m.shading.occlusion = v.occlusion;
  return m;
}

// The layers times their textures. Each side defines MapTexels, and texel_of, which is white where there is no texture.
SHARED Layers mapped_layers(READ_ONLY(Layers) plain, READ_ONLY(MapTexels) texels) {
  Layers v;
  v.coat = texel_of(texels, kClearcoat, false).x;
  v.coat_roughness = texel_of(texels, kClearcoatRoughness, false).y;
  v.sheen = vec3(texel_of(texels, kSheenColor, true));
  v.sheen_roughness = texel_of(texels, kSheenRoughness, false).w;
  return layers_times(plain, v);
}

// The ray's point moves by `spread` and then along `direction` back to the plane of triangle (a, a + ab, a + ac):
// how far that is along ab and along ac, both to be multiplied by z (ray differentials: Igehy 1999).
SHARED vec3 moved_on_triangle(vec3 spread, vec3 direction, vec3 ab, vec3 ac) {
  vec3 n = cross(ab, ac);
  real towards = dot(n, direction);
  real square = dot(n, n);
  vec3 p = spread - direction * (dot(n, spread) * (1.0f / towards));
  return pick(towards == 0.0f || square == 0.0f, vec3(0.0f, 0.0f, 1.0f),
              vec3(dot(cross(p, ac), n), dot(cross(ab, p), n), 1.0f / square));
}

// The change of a texture coordinate by that move.
SHARED vec2 uv_change(vec3 moved, vec2 uv_ab, vec2 uv_ac) { return moved.z * (moved.x * uv_ab + moved.y * uv_ac); }

// n changed by a normal map's texel (0 to 1). All vectors lie on the side that the triangle's
// vertex normals show. `tangent` is the vertices', side_of_v the side of the bitangent; where that is 0, the tangent is
// the direction on the triangle in which u grows (v grows downwards, hence the bitangent's sign).
SHARED vec3 mapped_normal(vec3 n, vec3 tangent, real side_of_v, vec3 ab, vec3 ac, vec2 uv_ab, vec2 uv_ac, vec3 texel,
                          float scale) {
  boolean given = side_of_v != 0.0f;
  real det = uv_ab.x * uv_ac.y - uv_ac.x * uv_ab.y;
  real inverse = 1.0f / det;
  vec3 along_u = pick(given, tangent, (ab * uv_ac.y - ac * uv_ab.y) * inverse);
  vec3 against_v = (ab * uv_ac.x - ac * uv_ab.x) * inverse;
  real side = pick(pick(given, side_of_v, dot(cross(n, along_u), against_v)) < 0.0f, -1.0f, 1.0f);
  vec3 t = along_u - n * dot(n, along_u);
  real square = dot(t, t);
  t *= 1.0f / sqrt(square);
  vec3 bitangent = side * cross(n, t);
  vec3 local = (texel * 2.0f - vec3(1.0f)) * vec3(scale, scale, 1.0f);
  vec3 mapped = t * local.x + bitangent * local.y + n * local.z;
  real length2 = dot(mapped, mapped);
  return pick((given || det != 0.0f) && square > 0.0f && length2 > 1e-12f, mapped * (1.0f / sqrt(length2)), n);
}

const int kAlphaOpaque = 0;
const int kAlphaMask = 1;
const int kAlphaBlend = 2;

// Whether rays pass a surface, whose material is not opaque, as if nothing were there.
SHARED boolean is_hole(int mode, real alpha, float cutoff) {
  if (mode == kAlphaMask) return alpha < cutoff;
  return alpha <= 0.0f;
}
