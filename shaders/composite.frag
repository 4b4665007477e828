#version 330 core
// The picture: each light's reflected light times its mask bit, plus the traced reflection. Shading and composite are one
// pass, as the mask weighs each light by itself and the sum of lights cannot be weighed afterwards.
//   ID_BITS           16, 24 or 32
//   HAS_MASK          the CPU's shadow mask; without it every light reaches everything
//   FREE_LIGHTS_ONLY  lights that cast are left out: the CPU adds them (design 2)
//   HAS_REFLECTION    the CPU's mirrored and refracted light; traced_light.glsl has its formats
//   HAS_MAPS          some material has maps
//   EYE_IN_MEDIUM     the eye lies in a body that absorbs light
//   HAS_ENVIRONMENT   a picture is seen where no triangle is; HAS_BACKGROUND_COLOR: a colour
//   HAS_CATCHER       the shadow catcher: where no triangle is, the reflection has the share of light that it lost
//   TERMINATOR_LIFTS, TERMINATOR_SMOOTHS  remedies of the shadow terminator; neither: none
//   HAS_SIZED_LIGHTS  some light has a size: the picture is lit by those points of it that the CPU's shadow rays
//                     of the same sample went to
//   SIZED_LIGHTS_ARE_TRACED  the CPU's light has theirs, filtered
//   ADDS_FILTERED     the filter's light of all samples is added in the last one's picture, also where that sample
//                     sees nothing
//   REPROJECT         mask and reflection are an older frame's, whose view and ids are given: each pixel reads
//                     them where its point was seen then. Where neither that pixel nor a neighbour saw the
//                     same triangle, the pixel is a hole: every light reaches it, and it takes the reflection
//                     that is there; its alpha is kHole.

#include "pixel_surface.glsl"
#ifdef HAS_SIZED_LIGHTS
#include "shared/sampling_params.glsl"
#include "shared/sampling.glsl"
#include "shared/sized_light.glsl"
#endif
#include "traced_light.glsl"

#ifdef HAS_ENVIRONMENT
uniform sampler2D environment;
uniform vec2 environment_size;
uniform float environment_turn;
uniform float environment_strength;

struct EnvironmentTexels {
  int lod;
};
vec3 environment_texel(EnvironmentTexels texels, float column, float row) {
  return texelFetch(environment, ivec2(column, row), texels.lod).rgb;
}

#include "shared/environment.glsl"

vec3 background(ivec2 pixel) {
  EnvironmentParams env = EnvironmentParams(EnvironmentTexels(0), ivec2(environment_size), environment_turn, environment_strength);
  return environment_light(env, pixel_direction(view_of_picture(), vec2(pixel)));
}
#elif defined(HAS_BACKGROUND_COLOR)
uniform vec3 background_color;
vec3 background(ivec2 pixel) { return background_color; }
#else
vec3 background(ivec2 pixel) { return vec3(0.0); }
#endif

// A hole's alpha (hybrid/frame.cpp, accumulate.frag): the largest half below 1, which no share of light has.
const float kHole = 1.0 - 1.0 / 2048.0;

#ifdef HAS_CATCHER
uniform float catcher_height;

// The share of light that the shadow catcher lost; 0 where the pixel does not see its plane.
float lost_light(ivec2 pixel) {
  vec3 origin = pixel_origin(view_of_picture(), vec2(pixel));
  vec3 direction = pixel_direction(view_of_picture(), vec2(pixel));
  if (!(direction.y < 0.0 && origin.y > catcher_height)) return 0.0;
  Source source = source_of(pixel, kNoTriangle, origin + (catcher_height - origin.y) / direction.y * direction);
  return source.hole ? 0.0 : clamp(reflected_light(source.pixel, kNoTriangle).r, 0.0, 1.0 - 1.0 / 1024.0);
}
#else
float lost_light(ivec2 pixel) { return 0.0; }
#endif

#ifdef EYE_IN_MEDIUM
uniform vec3 eye_medium_color;  // what is left of light after
uniform float eye_medium_distance;

// What is left of light on its way to the eye (Beer and Lambert).
vec3 left_of_light(vec3 p_world) {
  vec3 left = pow(max(eye_medium_color, 1e-30), vec3(distance(eye, p_world) / eye_medium_distance));
  return mix(vec3(0.0), left, greaterThan(eye_medium_color, vec3(0.0)));
}
#endif

uniform vec3 ambient_light;
uniform int light_count;

out vec4 color;

const float kLargestHalf = 65504.0;

#ifdef HAS_SIZED_LIGHTS
uniform int sequence;
uniform uint sample_index;  // the mask's frame's
uniform uint sample_seed;
uniform uint sample_count;
uniform float throughput_cutoff;

Incident light_at(int i, vec3 p_world, ivec2 pixel) {
  LightParams light = fetch_light(i);
  SampledPixel sampled = sampled_pixel(Sampling(sequence, sample_index, sample_seed, sample_count), uvec2(ivec2(first) + pixel));
  return sampled_light(light, p_world, sample_2d(sampled, kLightDimension + uint(i)));
}
#else
Incident light_at(int i, vec3 p_world, ivec2 pixel) {
  LightParams light = fetch_light(i);
  return incident_light(light, light.position, p_world);
}
#endif

// What reflected_light weighs the lobe's density with: the CPU's rays along the lobe look for casting lights.
float lobe_counted(PixelSurface s, int slot) {
#if defined(HAS_SAMPLED_LOBES) && defined(HAS_REFLECTION)
  if (slot < 0 || !(s.material.ggx_alpha > 0.0)) return 0.0;
  if (s.transmits) return kAlone;
  float share = mirrored_share(s.material, cosine_of_view(s.n.shading, s.to_viewer));
  return s.alpha * share < throughput_cutoff ? 0.0 : 1.0;
#else
  return 0.0;
#endif
}

float share_of_light(Reach reach, int slot) {
#ifdef FREE_LIGHTS_ONLY
  if (slot >= 0) return 0.0;
#endif
  return reach_of_light(reach, slot);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint id = fetch_id(ids, pixel);
  if (id == kNoTriangle) {
    float lost = lost_light(pixel);
    vec3 behind = background(pixel);
#if defined(ADDS_FILTERED) && !defined(HAS_CATCHER) && !defined(REPROJECT)
    behind += reflection_at(pixel);
#endif
    color = vec4((1.0 - lost) * min(behind, kLargestHalf), lost);
    return;
  }

  PixelSurface s = surface_of(id, pixel);
  Source source = source_of(pixel, id, s.p_world);
  Reach reach = reach_from(source, id);
  vec3 sum = phong_ambient(s.material, ambient_light);
  for (int i = 0; i < light_count; ++i) {
#ifdef SIZED_LIGHTS_ARE_TRACED
    if (has_size(fetch_light(i))) continue;
#endif
    int slot = fetch_mask_slot(i);
    float share = share_of_light(reach, slot);
    if (share == 0.0) continue;
    Incident incident = light_at(i, s.p_world, source.pixel);
    if (!faces_light(s, incident.to_light)) continue;
#ifdef TERMINATOR_SMOOTHS
    share *= terminator_factor(s.n.shading, s.n.geometric, incident.to_light);
#endif
    sum += share * reflected_light(s.material, incident, s.n.shading, s.to_viewer, true, lobe_counted(s, slot));
  }
#ifdef HAS_MAPS
  sum *= s.alpha;
#endif
#ifdef EYE_IN_MEDIUM
  sum *= left_of_light(s.p_world);
#endif
#ifdef HAS_REFLECTION
  sum += reflected_light(source.pixel, id);
#endif
  color = vec4(min(sum, kLargestHalf), source.hole ? kHole : 1.0);
}
