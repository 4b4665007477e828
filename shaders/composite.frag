#version 330 core
// Phong per light times its mask bit, plus the traced reflection: the picture. Phong and composite are one
// pass, as the mask weighs each light by itself and the sum of lights cannot be weighed afterwards.
//   ID_BITS           16, 24 or 32
//   HAS_MASK          the CPU's shadow mask; without it every light reaches everything
//   FREE_LIGHTS_ONLY  lights that cast are left out: the CPU adds them (design 2)
//   HAS_REFLECTION    the CPU's mirrored and refracted light; traced_light.glsl has its formats
//   HAS_TEXTURES      some material has a texture
//   REPROJECT         mask and reflection are of an older frame, whose view and ids are given: each pixel
//                     looks up where its point was seen then. Where that frame saw another triangle there,
//                     nor one of the neighbours does, the pixel is a hole: every light reaches it, and it
//                     takes the reflection that is there; its alpha is 1/2.

#define SHARED
#include "shared/view.glsl"
#include "shared/surface.glsl"
#include "shared/phong.glsl"
#include "scene_fetch.glsl"
#include "pixel_surface.glsl"
#include "traced_light.glsl"

uniform vec3 ambient_light;
uniform int light_count;
#ifdef REPROJECT
uniform vec3 old_eye;
uniform mat3 old_pixel_from_eye;  // (p_world - old_eye) to pixel x, y times z, and z
#endif

out vec4 color;

const float kLargestHalf = 65504.0;

// Where mask and reflection of a pixel are to be found.
struct Source {
  ivec2 pixel;
  bool hole;
};

Source source_of(ivec2 pixel, uint id, vec3 p_world) {
#ifdef REPROJECT
  vec3 at = old_pixel_from_eye * (p_world - old_eye);
  ivec2 last = textureSize(old_ids, 0) - 1;
  ivec2 nearest = clamp(ivec2(floor(at.xy / max(at.z, 1e-20) + 0.5)), ivec2(0), last);
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

// How much of a light reaches the pixel.
struct Reach {
  Source source;
#ifdef HAS_MASK
#if MASK_SCALE > 1
  Samples samples;
#endif
#endif
};

float reach_of_light(Reach reach, int slot) {
  if (slot < 0) return 1.0;
#ifdef FREE_LIGHTS_ONLY
  return 0.0;
#endif
#ifdef HAS_MASK
  if (reach.source.hole) return 1.0;
#if MASK_SCALE > 1
  float sum = 0.0;
  for (int k = 0; k < 4; ++k) sum += reach.samples.weight[k] * mask_bit(reach.samples.at[k], slot);
  return sum;
#else
  return mask_bit(reach.source.pixel, slot);
#endif
#else
  return 1.0;
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = fetch_id(ids, pixel);
  color = vec4(0.0);
  if (id == kNoTriangle) return;

  PixelSurface s = surface_of(id, pixel);
  PhongParams material = fetch_material(id, s.corners, s.weights);
  Source source = source_of(pixel, id, s.p_world);
  Reach reach;
  reach.source = source;
#ifdef HAS_MASK
#if MASK_SCALE > 1
  reach.samples = samples_near(source.pixel, id, MASK_SCALE);
#endif
#endif
  vec3 sum = phong_ambient(material, ambient_light);
  for (int i = 0; i < light_count; ++i) {
    float share = reach_of_light(reach, fetch_mask_slot(i));
    if (share == 0.0) continue;
    Incident incident = incident_light(fetch_light(i), s.p_world);
    if (!faces_light(s.n.shading, s.n.geometric, incident.to_light)) continue;
    sum += share * phong_light(material, incident, s.n.shading, s.to_viewer);
  }
#ifdef HAS_REFLECTION
  sum += reflected_light(source.pixel, id);
#endif
  // Alpha 1/2 marks a hole.
  color = vec4(min(sum, kLargestHalf), source.hole ? 0.5 : 1.0);
}
