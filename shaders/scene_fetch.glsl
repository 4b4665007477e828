// The scene as texture buffers: what gpu/gpu_mesh.cpp uploads, read back as the shared sources' structs.

#include "shared/glsl.glsl"
#include "shared/view.glsl"
#include "shared/surface.glsl"
#include "shared/light_params.glsl"
#include "shared/layers.glsl"
#include "shared/phong.glsl"
#include "shared/microfacet.glsl"

uniform usamplerBuffer triangle_corners;    // 3 texels a triangle
uniform usamplerBuffer triangle_materials;  // 1 texel a triangle
uniform samplerBuffer positions;            // 3 texels a vertex
uniform samplerBuffer normals;              // 3 texels a vertex
uniform samplerBuffer materials;            // kMaterialTexels a material
uniform samplerBuffer lights;               // kLightTexels a light

const int kMaterialTexels = 7;
const int kLightTexels = 6;

vec3 fetch_vec3(samplerBuffer from, uint i) {
  int first = 3 * int(i);
  return vec3(texelFetch(from, first).r, texelFetch(from, first + 1).r, texelFetch(from, first + 2).r);
}

uvec3 fetch_corners(uint triangle) {
  int first = 3 * int(triangle);
  return uvec3(texelFetch(triangle_corners, first).r, texelFetch(triangle_corners, first + 1).r,
               texelFetch(triangle_corners, first + 2).r);
}

// c: 0 to 1. ((c + 0.055) / 1.055)^2.4 is a polynomial here, within 3e-6 of its value: with pow(), llvmpipe takes 1.15 times
// as long for a textured picture.
vec3 linear_from_srgb(vec3 c) {
  vec3 s = sqrt((c + 0.055) / 1.055);
  vec3 s2 = s * s;
  vec3 rest = 0.03118108 + s * (1.38847717 + s * (-1.04100981 + s * (1.32154628 + s * (-1.1547766 + s * (0.57973269 - s * 0.12515316)))));
  return mix(c / 12.92, s2 * s2 * rest, greaterThan(c, vec3(0.04045)));
}

// Where the material's maps are (map_fetch.glsl); -1: it has none.
int fetch_maps(int material) { return int(texelFetch(materials, kMaterialTexels * material + 1).w) - 1; }

Layers fetch_layers(samplerBuffer from, int first) {
  return layers_of(texelFetch(from, first), texelFetch(from, first + 1));
}

// A material without its maps.
ShadingParams fetch_material(int material, out bool transmits) {
  int first = kMaterialTexels * material;
  vec4 ambient_shininess = texelFetch(materials, first);
  ShadingParams m;
  m.ambient = ambient_shininess.rgb;
  m.shininess = ambient_shininess.a;
  m.diffuse = texelFetch(materials, first + 1).rgb;
  vec4 specular_alpha = texelFetch(materials, first + 2);
  m.specular = specular_alpha.rgb;
  m.ggx_alpha = specular_alpha.a;
  vec4 emission_transmission = texelFetch(materials, first + 3);
  m.emission = emission_transmission.rgb;
  m.occlusion = 1.0;
  vec4 layer = texelFetch(materials, first + 4);
  m.layer = vec3(layer.xy, emission_transmission.a);
  m.grazing = layer.z;
  int bits = int(layer.w);
  transmits = (bits & 1) != 0;
  m.layers = no_layers();
  if ((bits & 2) != 0) m.layers = fetch_layers(materials, first + 5);
  m.coat_normal = vec3(0.0);
  return m;
}

LightParams fetch_light(int i) {
  vec4 a = texelFetch(lights, kLightTexels * i), b = texelFetch(lights, kLightTexels * i + 1);
  vec4 c = texelFetch(lights, kLightTexels * i + 2), d = texelFetch(lights, kLightTexels * i + 3);
  LightParams light;
  light.kind = int(a.w);
  light.position = a.xyz;
  light.inverse_square = b.w > 0.0;
  light.direction = b.xyz;
  light.radiance = c.rgb;
  light.range = c.a;
  light.cos_inner = d.x;
  light.cos_outer = d.y;
  light.size = 0.0;
  light.edge_u = light.edge_v = vec3(0.0);
#ifdef HAS_SIZED_LIGHTS
  vec4 e = texelFetch(lights, kLightTexels * i + 4);
  light.size = e.w;
  light.edge_u = e.xyz;
  light.edge_v = texelFetch(lights, kLightTexels * i + 5).xyz;
#endif
  return light;
}

// Slot in the shadow mask of light i; -1: it does not cast.
int fetch_mask_slot(int i) { return int(texelFetch(lights, kLightTexels * i + 3).z); }
