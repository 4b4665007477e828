// Source of GLSL and of C++ (core/image/tonemap.cpp): linear light of any strength to 0 to 1, channel by channel,
// before sRGB's curve.

const int kToneClip = 0;      // what is brighter than white is white
const int kToneReinhard = 1;  // Reinhard et al. 2002, equation 3: white is never reached
const int kToneAces = 2;      // Narkowicz 2015: a fit of the film curve of ACES

SHARED vec3 tone_mapped(vec3 light, int curve) {
  vec3 x = clamp(light, vec3(0.0f), vec3(65504.0f));
  if (curve == kToneReinhard) return x / (x + 1.0f);
  if (curve == kToneAces)
    return clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), vec3(0.0f), vec3(1.0f));
  return min(x, vec3(1.0f));
}
