#include "hybrid/settings/explain.h"

#include <cmath>

#include "core/base/decimal.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

std::string plural(int count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

std::string percent(double share) {
  return std::to_string(as_int(std::ceil(100.0 * share))) + " %";
}

std::string per_sample(int scale) {
  return scale == 1 ? ""
                    : ", one sample for " + std::to_string(scale) + "x" + std::to_string(scale) + " pixels";
}

std::string who_draws(const Settings& s) {
  if (!s.uses_gpu() && s.by_machine)
    return std::string("the CPU draws alone, ") + kGainOverSoftwareGl +
           ", as OpenGL is software here; it is not opened (--mode auto)";
  if (!s.uses_gpu()) return "the CPU draws alone; no OpenGL is opened";
  if (!s.traces()) return "the GPU draws alone";
  return s.composite == Processor::gpu
             ? "the GPU composites the picture (design 1)"
             : "the GPU finds the visible triangles, the CPU composites the picture (design 2)";
}

std::string why_primary(const SceneStats& stats, const Settings& s) {
  const std::string triangles = std::to_string(stats.triangles) + " triangles";
  const std::string bits = std::to_string(s.id_bits) + " bits";
  if (!s.traces()) return "the GPU finds the visible triangles, and ids stay there: the CPU has no part";
  if (s.visibility == Processor::cpu)
    return "the CPU finds the visible triangles, and ids of " + bits + " go to the GPU: " + triangles +
           ", more than a software rasteriser draws in the time of a ray for every pixel";
  return "the GPU finds the visible triangles, and ids of " + bits + " go to the CPU: " + triangles;
}

std::string why_mask(const SceneStats& stats, const Settings& s) {
  if (s.mask_bits == 0 && stats.casting_lights > 0) return "no shadow mask: the plan leaves shadows out";
  if (s.mask_bits == 0) {
    if (stats.lights == 0) return "no shadow mask: there is no light";
    return stats.idle_lights == stats.lights ? "no shadow mask: no light reaches anything"
                                             : "no shadow mask: no light casts";
  }
  const bool travels = s.uses_gpu() && s.composite == Processor::gpu;
  std::string text = "shadow mask of " + plural(s.mask_bits, "bit") + " a pixel";
  if (travels && s.mask_bits > 8) text += ", " + plural(s.mask_bits / 8, "byte") + " to the GPU";
  text += per_sample(s.mask_scale) + ": " + plural(stats.casting_lights, "light") +
          (stats.casting_lights == 1 ? " casts" : " cast");
  if (adds_lights(s, stats.casting_lights))
    text += "; the CPU shades " + std::to_string(stats.casting_lights - s.mask_bits) +
            " of them, whose light travels with mirrored light";
  return text;
}

std::string format_of(const Settings& s) {
  switch (s.reflection) {
    case ReflectionFormat::rgb8:
      return "24-bit sRGB, clipped at white";
    case ReflectionFormat::rgb9e5:
      return "9 bits a colour with a shared exponent, a third less than half RGB";
    case ReflectionFormat::full:
      return "float RGB";
    default:
      return "half RGB, which keeps what is brighter than white";
  }
}

std::string why_reflection(const SceneStats& stats, const Settings& s) {
  const bool lights = adds_lights(s, stats.casting_lights);
  if (!stats.mirrors && lights)
    return "light that the CPU shades is sent as " + format_of(s) + per_sample(s.reflection_scale) +
           ": nothing mirrors or refracts, but some lights are not in the mask";
  if (!stats.mirrors) return "no reflection pass: nothing mirrors or refracts";
  if (!s.reflects()) return "no reflection pass: the plan leaves mirrors out (depth 0)";
  std::string text = "reflection pass";
  if (s.uses_gpu() && s.composite == Processor::gpu)
    text += ", sent as " + format_of(s) + per_sample(s.reflection_scale) +
            (s.tiles ? ", where there is some" : "");
  return text + ": " + percent(stats.mirror_share) + " of the surface " +
         (stats.transmits() ? "mirrors or refracts" : "mirrors");
}

std::string why_glass(const Settings& s) {
  return s.glass_shadows == GlassShadows::tinted
             ? "shadow rays go straight on through glass: a ray for each surface more, and the light travels "
               "with the reflection"
             : "glass casts full shadows: shadow rays end there";
}

std::string why_sky(const Settings& s) {
  if (s.environment_light == EnvironmentMethod::sampled)
    return "the environment lights by samples: exact in the mean, with noise";
  std::string shadows = "without noise; it casts no shadows";
  if (s.sky_occlusion > 0) {
    shadows = "and casts shadows by " + plural(s.sky_occlusion, "ray") + " a point";
    if (s.sky_bounce > 0.0f && s.indirect == 0)
      shadows += ", which keep " + shortest(s.sky_bounce.value) + " times the albedo of the hidden light";
  }
  return "the environment lights by means " + shadows + "; rough surfaces mirror " +
         (s.glossy == Glossy::sampled ? "the scene by samples" : "it alone");
}

std::string why_denoise(const Settings& s) {
  return "sampled light is filtered by the CPU, " +
         (s.spp > 1 ? "the mean of " + plural(s.spp, "sample") : std::string("each sample")) +
         ": less noise, and soft detail of light is lost; hard light, sharp mirrors and textures stay exact";
}

std::string how_blurred(const Settings& s) {
  if (s.background_blur <= 0.0f) return {};
  return ", blurred by " + shortest(kWidestBlur_deg * s.background_blur) + " degrees";
}

std::string why_background(const SceneStats& stats, const Settings& s) {
  const Background& background = s.background.value;
  if (background.kind == Background::Kind::color)
    return "behind the scene is the colour " + to_text(background) + ", linear";
  if (background.kind == Background::Kind::studio)
    return "behind the scene is the studio's neutral sky" + how_blurred(s);
  if (!background.is_transparent())
    return stats.environment ? "behind the scene is its environment" + how_blurred(s)
                             : "behind the scene is black";
  if (!stats.blends) return "behind the scene is nothing: alpha is the covered share of a pixel";
  return s.coverage ? "behind the scene is nothing: the CPU draws alone, as it counts what surfaces that "
                      "blend let through (coverage)"
                    : "behind the scene is nothing; surfaces that blend have alpha 1 without coverage";
}

std::string why_catcher(const Settings& s) {
  if (!s.reflects()) return "the shadow catcher catches nothing: the plan traces no mirrored light";
  return "the shadow catcher at height " + shortest(s.shadow_catcher.value.height) +
         " takes shadow rays at each pixel of the ground that sees nothing else" +
         (s.uses_gpu() ? "; its alpha travels in the reflection pass" : "");
}

std::string why_depth(const SceneStats& stats, const Settings& s) {
  const std::string bounces = plural(s.depth, "bounce");
  if (s.depth < stats.useful_depth) return bounces + ": as many as requested";
  return bounces + (stats.useful_depth == 1 ? ": no mirror sees another"
                                            : ": further ones are too faint for a pixel to show");
}

std::string why_threads(const Settings& s) {
  return s.threads == 0 ? "workers on all cores: rasteriser and tracer are never faster with fewer"
                        : plural(s.threads, "worker thread") + ", as requested";
}

std::string why_rays(const Settings& s) {
  const std::string still =
      s.reuse ? "a frame like the last one costs no ray" : "nothing of earlier frames is reused";
  return s.light_cutoff > 0.0f
             ? "no shadow ray where a light brings less than half a step of an 8-bit picture; " + still
             : "a shadow ray wherever a light may reach, as the mask itself is kept; " + still;
}

// The texture and alpha code that the scene needs.
std::string why_maps(const SceneStats& stats) {
  if (!stats.textures && !stats.vertex_colors && !stats.holes && !stats.blends)
    return "no texture code in the shaders: nothing is textured";
  std::string line = stats.textures        ? "textures are looked up: some triangle has one"
                     : stats.vertex_colors ? "vertex colours are looked up: some triangle has them"
                                           : "alpha is looked up: some triangle has it";
  if (stats.holes) line += "; rays continue behind holes";
  if (stats.blends) line += "; surfaces that blend send a ray straight on";
  if (!stats.holes && !stats.blends) line += "; nothing has holes or blends: rays stop at their first hit";
  return line;
}

}  // namespace

std::vector<std::string> explain(const SceneStats& stats, const Settings& s) {
  std::vector<std::string> lines{who_draws(s)};
  if (s.uses_gpu()) lines.push_back(why_primary(stats, s));
  lines.push_back(why_mask(stats, s));
  lines.push_back(why_reflection(stats, s));
  const bool sky = stats.environment && s.environment_strength > 0.0f;
  if (stats.glass && s.reflects() && (sky || s.mask_bits > 0)) lines.push_back(why_glass(s));
  if (sky && s.reflects()) lines.push_back(why_sky(s));
  if (s.denoise) lines.push_back(why_denoise(s));
  if (s.background.given || s.background_blur.given ||
      s.background.value.kind != Background::Kind::environment)
    lines.push_back(why_background(stats, s));
  if (s.shadow_catcher.value.kind != ShadowCatcher::Kind::off) lines.push_back(why_catcher(s));
  if (s.reflects() && (stats.mirrors || !adds_lights(s, stats.casting_lights)))
    lines.push_back(why_depth(stats, s));
  if (s.mask_bits > 0) lines.push_back(why_rays(s));
  if (s.traces()) lines.push_back(why_threads(s));
  lines.push_back(why_maps(stats));
  return lines;
}

}  // namespace pinocchio
