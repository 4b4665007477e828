#version 330 core
// One of a frame's buffers as a picture for people (inspect/inspect_pass.h), in linear light; a screen's sRGB
// curve is still to come. Mask and reflection are looked up by what the composite looks them up with.
//   ID_BITS          16, 24 or 32
//   one of SHOW_IDS, SHOW_NORMALS, SHOW_MASK, SHOW_REFLECTION, SHOW_DELAY, SHOW_DEPTH,
//   SHOW_POSITION, SHOW_ALBEDO; with none, all is grey
//   HAS_MASK, HAS_REFLECTION, REPROJECT and what goes with them: traced_light.glsl

#include "pixel_surface.glsl"
#include "traced_light.glsl"

uniform int light_count;
uniform int slot;        // SHOW_MASK: of the mask
uniform int first_slot;  // SHOW_MASK: that the texture has
uniform int age_frames;  // SHOW_DELAY: of the answer that is shown
uniform vec3 range_lo;   // SHOW_DEPTH, SHOW_POSITION: what is black ...
uniform vec3 range_hi;   // ... and what is white

out vec4 color;

const vec3 kDark = vec3(0.01);
const vec3 kNothingAsked = vec3(0.18);
const vec3 kAges[4] = vec3[](vec3(0.02, 0.35, 0.07), vec3(0.75, 0.6, 0.02), vec3(0.8, 0.2, 0.01), vec3(0.6, 0.0, 0.0));
const vec3 kHole = vec3(0.8, 0.0, 0.6);

// Neighbours' ids are close to each other, and their colours must not be (PCG: Jarzynski and Olano 2020).
vec3 color_of(uint id) {
  uint state = id * 747796405u + 2891336453u;
  uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  uint hash = (word >> 22u) ^ word;
  vec3 rgb = vec3(hash & 0xffu, hash >> 8u & 0xffu, hash >> 16u & 0xffu) / 255.0;
  return linear_from_srgb(0.25 + 0.75 * rgb);
}

#ifdef SHOW_MASK
// Whether a shadow ray is fired from there to the light of that slot.
bool asked(PixelSurface s) {
  for (int i = 0; i < light_count; ++i)
    if (fetch_mask_slot(i) == slot) {
      LightParams light = fetch_light(i);
      return faces_light(s, incident_light(light, light.position, s.p_world).to_light);
    }
  return false;
}

vec3 color_of_mask(uint id, ivec2 pixel) {
  PixelSurface s = surface_of(id, pixel);
  float reach = reach_of_light(reach_from(source_of(pixel, id, s.p_world), id), slot - first_slot);
  return reach > 0.0 || asked(s) ? vec3(reach) : kNothingAsked;
}
#endif

vec3 in_range(vec3 value) {
  vec3 width = range_hi - range_lo;
  vec3 part = (value - range_lo) / mix(width, vec3(1.0), equal(width, vec3(0.0)));
  return linear_from_srgb(clamp(part, 0.0, 1.0));
}

vec3 color_of_pixel(uint id, ivec2 pixel) {
#if defined(SHOW_IDS)
  return color_of(id);
#elif defined(SHOW_NORMALS)
  return linear_from_srgb(0.5 * surface_of(id, pixel).n.shading + 0.5);
#elif defined(SHOW_MASK)
  return color_of_mask(id, pixel);
#elif defined(SHOW_REFLECTION)
  return reflected_light(source_of(pixel, id, surface_of(id, pixel).p_world).pixel, id);
#elif defined(SHOW_DELAY)
  bool hole = source_of(pixel, id, surface_of(id, pixel).p_world).hole;
  return hole ? kHole : kAges[clamp(age_frames, 0, 3)];
#elif defined(SHOW_DEPTH)
  vec3 direction = pixel_direction(view_of_picture(), vec2(pixel));
  vec3 origin = pixel_origin(view_of_picture(), vec2(pixel));
  float z_eye = dot(surface_of(id, pixel).p_world - origin, direction) / dot(direction, direction);
  return in_range(vec3(z_eye));
#elif defined(SHOW_POSITION)
  return in_range(surface_of(id, pixel).p_world);
#elif defined(SHOW_ALBEDO)
  return surface_of(id, pixel).material.diffuse;
#else
  return kNothingAsked;
#endif
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = fetch_id(ids, pixel);
#ifdef SHOW_MASK
  vec3 nothing_seen = kNothingAsked;
#else
  vec3 nothing_seen = kDark;
#endif
  color = vec4(id == kNoTriangle ? nothing_seen : color_of_pixel(id, pixel), 1.0);
}
