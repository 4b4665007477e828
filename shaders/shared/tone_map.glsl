// Source of GLSL and of C++ (core/image/tonemap.cpp): linear light of any strength to 0 to 1, before sRGB's curve. All
// but neutral treat each channel by itself.

const int kToneClip = 0;      // what is brighter than white is white
const int kToneReinhard = 1;  // Reinhard et al. 2002, equation 3: white is never reached
const int kToneAces = 2;      // Narkowicz 2015: a fit of the film curve of ACES
const int kToneNeutral = 3;   // Khronos PBR Neutral (2024): colours below 0.8 stay, apart from a little glare

// Takes the 4 % that dielectrics mirror of a white sky from all channels, and compresses what is brighter than 0.8 by its
// brightest channel, towards white.
SHARED vec3 neutral_tone(vec3 light) {
  float least = min(light.x, min(light.y, light.z));
  vec3 x = light - (least < 0.08f ? least - 6.25f * least * least : 0.04f);
  float peak = max(x.x, max(x.y, x.z));
  const float kStart = 0.76f;
  if (peak < kStart) return x;
  const float kRest = 1.0f - kStart;
  float shown_peak = 1.0f - kRest * kRest / (peak + kRest - kStart);
  float whiter = 1.0f - 1.0f / (0.15f * (peak - shown_peak) + 1.0f);
  return mix(x * (shown_peak / peak), vec3(shown_peak), whiter);
}

SHARED vec3 tone_mapped(vec3 light, int curve) {
  vec3 x = clamp(light, vec3(0.0f), vec3(65504.0f));
  if (curve == kToneReinhard) return x / (x + 1.0f);
  if (curve == kToneAces)
    return clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), vec3(0.0f), vec3(1.0f));
  if (curve == kToneNeutral) return clamp(neutral_tone(x), vec3(0.0f), vec3(1.0f));
  return min(x, vec3(1.0f));
}
