// Source of GLSL and of C++ (core/shade/shared_maps.h): a material with textures, vertex colours and alpha.
// Expects metallic_roughness.glsl.

// The maps' values at the point; all ones where there is no texture.
struct MapValues {
  vec3 base_color;  // times the vertex colour
  float metallic;
  float roughness;
  float occlusion;  // strength applied
  vec3 emissive;
  float specular;
  vec3 specular_color;
  float transmission;
  GltfLayers layers;
};

SHARED MaterialPoint mapped_phong(MaterialPoint plain, MapValues v) {
  MaterialPoint m = plain;
  m.shading.ambient *= v.base_color;
  m.shading.occlusion = v.occlusion;
  m.shading.diffuse *= v.base_color;
  m.shading.emission *= v.emissive;
  return m;
}

SHARED MaterialPoint mapped_metallic_roughness(MetallicRoughness s, GltfLayers l, MapValues v, bool as_phong) {
  s.base_color *= v.base_color;
  s.metallic *= v.metallic;
  s.roughness *= v.roughness;
  s.emissive *= v.emissive;
  s.specular *= v.specular;
  s.specular_color *= v.specular_color;
  s.transmission *= v.transmission;
  MaterialPoint m = from_metallic_roughness(s, as_phong);
  m.shading.occlusion = v.occlusion;
  l.coat *= v.layers.coat;
  l.coat_roughness *= v.layers.coat_roughness;
  l.sheen *= v.layers.sheen;
  l.sheen_roughness *= v.layers.sheen_roughness;
  return with_layers(m, l);
}

// n changed by a normal map's texel (0 to 1). All vectors lie on the side that the triangle's
// vertex normals show. `tangent` is the vertices', its w the side of the bitangent; with w = 0 the tangent is
// the direction on the triangle in which u grows (v grows downwards, hence the bitangent's sign).
SHARED vec3 mapped_normal(vec3 n, vec4 tangent, vec3 ab, vec3 ac, vec2 uv_ab, vec2 uv_ac, vec3 texel,
                          float scale) {
  vec3 along_u = vec3(tangent);
  float side = tangent.w < 0.0f ? -1.0f : 1.0f;
  if (tangent.w == 0.0f) {
    float det = uv_ab.x * uv_ac.y - uv_ac.x * uv_ab.y;
    if (det == 0.0f) return n;
    along_u = (ab * uv_ac.y - ac * uv_ab.y) / det;
    vec3 against_v = (ab * uv_ac.x - ac * uv_ab.x) / det;
    side = dot(cross(n, along_u), against_v) < 0.0f ? -1.0f : 1.0f;
  }
  vec3 t = along_u - n * dot(n, along_u);
  float square = dot(t, t);
  if (!(square > 0.0f)) return n;
  t /= sqrt(square);
  vec3 bitangent = side * cross(n, t);
  vec3 local = (texel * 2.0f - 1.0f) * vec3(scale, scale, 1.0f);
  vec3 mapped = t * local.x + bitangent * local.y + n * local.z;
  float length2 = dot(mapped, mapped);
  return length2 > 1e-12f ? mapped / sqrt(length2) : n;
}

const int kAlphaOpaque = 0;
const int kAlphaMask = 1;
const int kAlphaBlend = 2;

// Whether a ray passes as if nothing were there.
SHARED bool is_hole(int mode, float alpha, float cutoff) {
  return mode == kAlphaMask ? alpha < cutoff : (mode == kAlphaBlend && alpha <= 0.0f);
}
