// The CPU's mask and reflection of a pixel, and the places in them to read. Expects pixel_surface.glsl
// and scene_fetch.glsl before it.
//   HAS_MASK        MASK_BITS a sample, one sample for MASK_SCALE x MASK_SCALE pixels: up to 8 in a texel's byte,
//                   more in a texel of one or two words
//   LIGHTS_IN_REFLECTION  the light in slots beyond MASK_BITS is in the reflection
//   HAS_REFLECTION  one sample for REFLECTION_SCALE x REFLECTION_SCALE pixels, of REFLECTION_TEXELS texels;
//                   REFLECTION_IS_SRGB: in bytes; REFLECTION_TILE: only tiles of so many samples a side that
//                   have some light in them, and an index that says where each is
//   REPROJECT       they are an older frame's, whose view and ids are given

#ifdef REPROJECT
uniform usampler2D old_ids;
uniform vec3 old_eye;
uniform mat3 old_pixel_from_eye;  // (p_world - old_eye) to pixel x, y times z, and z
#define traced_ids old_ids
#else
#define traced_ids ids
#endif

#ifdef HAS_MASK
uniform usampler2D mask;
#endif
#ifdef HAS_REFLECTION
uniform sampler2D reflection;
#ifdef REFLECTION_TILE
uniform usampler2D reflection_tiles;
#endif
#endif

// The four samples around a pixel, where there is one for scale x scale pixels. Near ones count more; of
// them those that saw the pixel's own triangle most, then its material, and others only where there is no
// such one (joint bilateral upsampling: Kopf et al. 2007).
struct Samples {
  ivec2 at[4];
  float weight[4];  // adding up to 1
};

uint material_of(uint id) {
  return texelFetch(triangle_materials, int(id)).r;
}

float likeness(uint a, uint b) {
  if (a == b) return 1.0;
  if (a == kNoTriangle || b == kNoTriangle) return 1e-8;
  return material_of(a) == material_of(b) ? 0.1 : 1e-4;
}

Samples samples_near(ivec2 pixel, uint id, int scale) {
  ivec2 last = (textureSize(traced_ids, 0) - 1) / scale;
  ivec2 first = pixel / scale;
  vec2 part = vec2(pixel - scale * first) / float(scale);
  Samples s;
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 step_to = ivec2(k & 1, k >> 1);
    s.at[k] = min(first + step_to, last);
    vec2 near = mix(1.0 - part, part, vec2(step_to));
    s.weight[k] = (near.x * near.y + 1e-6) * likeness(fetch_id(traced_ids, s.at[k] * scale), id);
    sum += s.weight[k];
  }
  for (int k = 0; k < 4; ++k) s.weight[k] /= sum;
  return s;
}

#ifdef HAS_MASK
#if MASK_BITS > 8
#define MaskSample uvec2
MaskSample mask_sample(ivec2 at) { return texelFetch(mask, at, 0).rg; }
float mask_bit(MaskSample lights, int slot) { return float((slot < 32 ? lights.x : lights.y) >> uint(slot & 31) & 1u); }
#else
#define MaskSample ivec2
MaskSample mask_sample(ivec2 at) { return at; }
float mask_bit(MaskSample at, int slot) {
  int bit = at.x * MASK_BITS + slot;
  uint byte_of_mask = texelFetch(mask, ivec2(bit / 8, at.y), 0).r;
  return float(byte_of_mask >> uint(bit % 8) & 1u);
}
#endif
#endif

#ifdef HAS_REFLECTION
vec3 reflection_at(ivec2 at) {
#ifdef REFLECTION_TILE
  ivec2 cell = at / REFLECTION_TILE;
  uint tile = texelFetch(reflection_tiles, cell, 0).r;
  if (tile == 0xffffffffu) return vec3(0.0);
  int columns = textureSize(reflection_tiles, 0).x;
  at += REFLECTION_TILE * (ivec2(int(tile) % columns, int(tile) / columns) - cell);
#endif
  vec3 light = fetch_rgb(reflection, at, REFLECTION_TEXELS);
#ifdef REFLECTION_IS_SRGB
  light = linear_from_srgb(light);
#endif
  return light;
}

vec3 reflected_light(ivec2 pixel, uint id) {
#if REFLECTION_SCALE == 1
  return reflection_at(pixel);
#else
  Samples s = samples_near(pixel, id, REFLECTION_SCALE);
  vec3 sum = vec3(0.0);
  for (int k = 0; k < 4; ++k) sum += s.weight[k] * reflection_at(s.at[k]);
  return sum;
#endif
}
#endif

// The pixel whose mask and reflection are read.
struct Source {
  ivec2 pixel;
  bool hole;
};

Source source_of(ivec2 pixel, uint id, vec3 p_world) {
#ifdef REPROJECT
  vec3 at = old_pixel_from_eye * (p_world - old_eye);
  ivec2 last = textureSize(old_ids, 0) - 1;
  // Clamped first: no int holds every float.
  ivec2 nearest = ivec2(clamp(floor((kParallel ? at.xy - first : at.xy / max(at.z, 1e-20)) + 0.5), vec2(0.0), vec2(last)));
  if (at.z > 0.0) {
    // The pixel itself first, then its neighbours.
    for (int i = 0; i < 9; ++i) {
      int k = i == 0 ? 4 : i <= 4 ? i - 1 : i;
      ivec2 there = clamp(nearest + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), last);
      if (fetch_id(old_ids, there) == id) return Source(there, false);
    }
  }
  return Source(nearest, true);
#else
  return Source(pixel, false);
#endif
}

// The places that the mask is read at, the same for all lights.
struct Reach {
  Source source;
#ifdef HAS_MASK
#if MASK_SCALE > 1
  float weight[4];
  MaskSample lights[4];
#else
  MaskSample lights;
#endif
#endif
};

Reach reach_from(Source source, uint id) {
  Reach reach;
  reach.source = source;
#ifdef HAS_MASK
#if MASK_SCALE > 1
  Samples samples = samples_near(source.pixel, id, MASK_SCALE);
  reach.weight = samples.weight;
  for (int k = 0; k < 4; ++k) reach.lights[k] = mask_sample(samples.at[k]);
#else
  reach.lights = mask_sample(source.pixel);
#endif
#endif
  return reach;
}

// slot: -1 where the light does not cast.
float reach_of_light(Reach reach, int slot) {
  if (slot < 0) return 1.0;
#ifdef HAS_MASK
#ifdef LIGHTS_IN_REFLECTION
  if (slot >= MASK_BITS) return 0.0;
#endif
  if (reach.source.hole) return 1.0;
#if MASK_SCALE > 1
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += reach.weight[k] * mask_bit(reach.lights[k], slot);
  return sum;
#else
  return mask_bit(reach.lights, slot);
#endif
#else
  return 1.0;
#endif
}
