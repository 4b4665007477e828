// The scene as texture buffers: what hybrid/gpu_scene.cpp uploads, read back as the shared sources' structs.

uniform usamplerBuffer triangle_corners;    // 3 texels a triangle
uniform usamplerBuffer triangle_materials;  // 1 texel a triangle
uniform samplerBuffer positions;            // 3 texels a vertex
uniform samplerBuffer normals;              // 3 texels a vertex
uniform samplerBuffer materials;            // kMaterialTexels a material
uniform samplerBuffer lights;               // kLightTexels a light

const int kMaterialTexels = 5;
const int kLightTexels = 4;

vec3 fetch_vec3(samplerBuffer buffer, uint i) {
  int first = 3 * int(i);
  return vec3(texelFetch(buffer, first).r, texelFetch(buffer, first + 1).r, texelFetch(buffer, first + 2).r);
}

uvec3 fetch_corners(uint triangle) {
  int first = 3 * int(triangle);
  return uvec3(texelFetch(triangle_corners, first).r, texelFetch(triangle_corners, first + 1).r,
               texelFetch(triangle_corners, first + 2).r);
}

vec3 linear_from_srgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

#ifdef HAS_TEXTURES
uniform samplerBuffer texcoords;  // 2 texels a vertex
uniform samplerBuffer texels;     // RGBA of all textures, one after the other, as stored (sRGB)

vec2 fetch_texcoord(uint i) {
  return vec2(texelFetch(texcoords, 2 * int(i)).r, texelFetch(texcoords, 2 * int(i) + 1).r);
}

vec3 linear_texel(ivec2 at, int first, ivec2 size) {
  at = ivec2(at.x - size.x * int(floor(float(at.x) / float(size.x))),
             at.y - size.y * int(floor(float(at.y) / float(size.y))));
  return linear_from_srgb(texelFetch(texels, first + at.y * size.x + at.x).rgb);
}

// Bilinear by hand, as core/trace/surface.cpp does it: hardware filters with 8 bits of weight.
vec3 sample_texture(vec2 texcoord, int first, ivec2 size) {
  vec2 at = fract(texcoord) * vec2(size) - 0.5;
  vec2 base = floor(at), f = at - base;
  ivec2 b = ivec2(base);
  return mix(mix(linear_texel(b, first, size), linear_texel(b + ivec2(1, 0), first, size), f.x),
             mix(linear_texel(b + ivec2(0, 1), first, size), linear_texel(b + ivec2(1, 1), first, size), f.x), f.y);
}
#endif

PhongParams fetch_material(uint triangle, uvec3 corners, vec3 weights) {
  int first = kMaterialTexels * int(texelFetch(triangle_materials, int(triangle)).r);
  vec4 ambient_shininess = texelFetch(materials, first);
  PhongParams m;
  m.ambient = ambient_shininess.rgb;
  m.shininess = ambient_shininess.a;
  m.diffuse = texelFetch(materials, first + 1).rgb;
  m.specular = texelFetch(materials, first + 2).rgb;
  m.emission = texelFetch(materials, first + 3).rgb;
#ifdef HAS_TEXTURES
  vec4 place = texelFetch(materials, first + 4);  // first texel (high, low 12 bits), width, height; width 0: none
  if (place.z > 0.0) {
    vec2 texcoord = weights.x * fetch_texcoord(corners.x) + weights.y * fetch_texcoord(corners.y) +
                    weights.z * fetch_texcoord(corners.z);
    vec3 color = sample_texture(texcoord, int(place.x) * 4096 + int(place.y), ivec2(place.zw));
    m.ambient *= color;
    m.diffuse *= color;
  }
#endif
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
  return light;
}

// Slot in the shadow mask of light i; -1: it does not cast.
int fetch_mask_slot(int i) { return int(texelFetch(lights, kLightTexels * i + 3).z); }
