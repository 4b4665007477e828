#include "hybrid/settings/resolve.h"

#include <algorithm>
#include <string>

#include "core/trace/rays/trace_options.h"
#include "pinocchio/conversion.h"
#include "pinocchio/mask_image.h"

namespace pinocchio {
namespace {

constexpr std::size_t kMost16BitIds = 0xffff, kMost24BitIds = 0xffffff;  // all ones is "none"

// A software rasteriser takes as long for this many triangles as the tracer takes for a pixel's primary ray
// (docs/measurements.md, "Who finds what is seen").
constexpr double kTrianglesPerPixelForRays = 2.0;

Unexpected refused(const std::string& what, const std::string& remedy) {
  return Unexpected(InputError{{}, 0, what, remedy});
}

std::size_t most_ids(int id_bits) {
  return id_bits == 16 ? kMost16BitIds : id_bits == 24 ? kMost24BitIds : 0xffffffffu;
}

// Whether the GPU's mask does not have all casting lights.
bool exceeds_mask(const Settings& s, int casting_lights) {
  return s.composite == Processor::gpu && s.mask_bits != 0 && s.mask_bits < casting_lights;
}

// Below 8 bits a mask holds all lights: the light of others is added by whole bytes of slots.
Expected<void> check_mask(const Settings& s, const SceneStats& stats) {
  const std::string bits = std::to_string(s.mask_bits), lights = std::to_string(stats.casting_lights);
  if (s.mask_bits != 0 && s.mask_bits < std::min(8, stats.casting_lights))
    return refused("mask_bits " + bits + " cannot hold the scene's " + lights + " casting lights",
                   "use more bits, or 0 for no shadows");
  if (exceeds_mask(s, stats.casting_lights) && !s.reflects())
    return refused("mask_bits " + bits + " cannot hold the scene's " + lights +
                       " casting lights, and with reflection none no other light travels",
                   "leave reflection out, use more bits (64 at most), or composite cpu (--design 2)");
  return {};
}

Expected<void> check(const Settings& s, const SceneStats& stats) {
  if (const Rule* const rule = broken_rule(s))
    return refused(std::string(rule->what), std::string(rule->remedy));
  if (s.uses_gpu() && stats.triangles >= most_ids(s.id_bits))
    return refused("id_bits " + std::to_string(s.id_bits) + " cannot name the scene's " +
                       std::to_string(stats.triangles) + " triangles",
                   "use more bits (--plan auto, where --plan slides says 24)");
  return check_mask(s, stats);
}

bool lights_through_glass(const Settings& s, const SceneStats& stats) {
  return s.glass_shadows == GlassShadows::tinted && stats.glass && stats.casting_lights > 0 &&
         s.mask_bits > 0;
}

// The limit loses nothing: beyond the useful depth every ray is below the cutoff.
void fill_depth(const SceneStats& stats, Settings& s) {
  // With --indirect, rough surfaces of glTF's model send mirrored rays too. They need the depth that was
  // given.
  const bool lobes = s.indirect > 0 && s.glossy == Glossy::sampled && stats.microfacets;
  if (!stats.mirrors && !lobes) s.depth.value = 0;
  if (s.throughput_cutoff >= kThroughputCutoff && !lobes)
    s.depth.value = std::min<int>(s.depth, stats.useful_depth);
  // Samples of an environment, of light from other surfaces and of the shadow catcher travel with mirrored
  // light, and so does light through glass.
  const bool samples = s.indirect > 0 || (stats.environment && s.environment_strength > 0.0f) ||
                       (s.denoise && stats.sized_lights) ||
                       s.shadow_catcher.value.kind != ShadowCatcher::Kind::off;
  s.reflection.fill(s.depth > 0 || samples || lights_through_glass(s, stats) ? ReflectionFormat::half
                                                                             : ReflectionFormat::none);
  if (s.reflection == ReflectionFormat::none) s.depth.value = 0;
}

// Whether light is found at random.
bool takes_samples(const SceneStats& stats, const Settings& s) {
  const bool sky = stats.environment && s.environment_strength > 0.0f, lobes = s.glossy == Glossy::sampled;
  return s.indirect > 0 || stats.sized_lights || (sky && s.environment_light == EnvironmentMethod::sampled) ||
         (lobes && (stats.glossy || (sky && stats.microfacets)));
}

// Lights beyond the mask travel as light. Where that is ruled out, the CPU composites.
void make_way_for_lights(const SceneStats& stats, Settings& s) {
  if (!exceeds_mask(s, stats.casting_lights)) return;
  s.reflection.fill(ReflectionFormat::half);
  if (!s.reflects()) s.composite.fill(Processor::cpu);
}

// What is behind the scene. Where the background is transparent, surfaces that blend are, too: by coverage,
// which the CPU counts where it may draw alone. The shadow catcher's share of light travels with mirrored
// light, which design 2 does not send.
void fill_background(const SceneStats& stats, const Circumstances& c, Settings& s) {
  if (stats.studio) s.background.fill({Background::Kind::studio});
  const bool gpu_given = (s.visibility.given && s.visibility == Processor::gpu) ||
                         (s.composite.given && s.composite == Processor::gpu);
  if (s.background.value.is_transparent() && stats.blends && !gpu_given) s.coverage.fill(true);
  const bool travels = c.needs_rays || s.visibility == Processor::cpu || s.composite == Processor::gpu;
  const bool reflects = !s.reflection.given || s.reflects();
  if (stats.studio && travels && reflects) s.shadow_catcher.fill({ShadowCatcher::Kind::lowest});
  if (s.shadow_catcher.value.kind == ShadowCatcher::Kind::lowest)
    s.shadow_catcher.value = {ShadowCatcher::Kind::at,
                              std::clamp(stats.bounds.lo.y, -kMostCatcherHeight, kMostCatcherHeight)};
}

// --mode auto. The GPU stays where other settings need it.
void choose_processors(const Circumstances& c, Settings& s) {
  if (!s.by_machine || !c.software_gl) return;
  Settings alone = s;
  alone.visibility.fill(Processor::cpu);
  alone.composite.fill(Processor::cpu);
  if (!broken_rule(alone)) s = alone;
}

}  // namespace

Expected<Settings> resolve(const Settings& settings, const SceneStats& stats, const Circumstances& c) {
  Settings s = settings;
  if (stats.studio) {
    s.environment_light.fill(EnvironmentMethod::prefiltered);
    s.sky_occlusion.fill(8);
    if (s.indirect == 0) s.sky_bounce.fill(0.5f);
  }
  if (s.environment_light == EnvironmentMethod::prefiltered) s.glossy.fill(Glossy::sharp);
  s.id_bits.fill(stats.triangles < kMost16BitIds ? 16 : 32);
  s.mask_bits.fill(mask_bits_for(stats.casting_lights));
  fill_background(stats, c, s);
  fill_depth(stats, s);
  choose_processors(c, s);
  if (s.coverage) {
    s.visibility.fill(Processor::cpu);
    s.composite.fill(Processor::cpu);
  }
  if (c.needs_rays) draw_on_cpu(s);
  make_way_for_lights(stats, s);
  const bool needs_bits = c.keeps_mask || s.mask_bits == 0;
  s.light_cutoff.fill(needs_bits ? 0.0f : light_cutoff_of(stats.casting_lights));
  s.tiles.fill(s.composite == Processor::gpu && s.reflects());
  const double pixels = as_double(c.size.x) * as_double(c.size.y);
  const bool faster_by_rays = as_double(stats.triangles) > kTrianglesPerPixelForRays * pixels;
  if (c.software_gl && s.exchange != Exchange::reproject && s.composite == Processor::gpu && s.traces() &&
      faster_by_rays)
    s.visibility.fill(Processor::cpu);
  // Filtered light travels with mirrored light.
  if (!takes_samples(stats, s) || !s.reflects() || (!s.denoise.given && !can_denoise(s)))
    s.denoise.value = false;
  // The samples of neighbouring pixels then complement each other, and the filter's means have less noise.
  s.sequence.fill(s.denoise ? Sequence::z_order : Sequence::sobol);
  if (const Expected<void> checked = check(s, stats); !checked) return Unexpected(checked.error());
  return s;
}

int mask_bits_for(int casting_lights) {
  return std::min(MaskImage::bits_for(casting_lights), kMostMaskBits);
}

bool adds_lights(const Settings& s, int casting_lights) {
  return exceeds_mask(s, casting_lights) && s.reflects();
}

std::vector<std::string> losses(const Settings& s, const SceneStats& stats) {
  std::vector<std::string> lines;
  if (s.mask_bits.given && s.mask_bits == 0 && stats.casting_lights > 0)
    lines.push_back("mask_bits 0: the shadows of " + std::to_string(stats.casting_lights) +
                    " light(s) are left out");
  if (adds_lights(s, stats.casting_lights) && s.reflection == ReflectionFormat::rgb8)
    lines.push_back(
        "mask_bits " + std::to_string(s.mask_bits) + ": the light of the other " +
        std::to_string(stats.casting_lights - s.mask_bits) +
        " lights travels with mirrored light, of which reflection rgb8 clips what is brighter than white");
  if (s.reflection.given && !s.reflects() && stats.mirrors)
    lines.emplace_back("reflection none: mirrors and glass are left out");
  if (s.reflection.given && !s.reflects() && lights_through_glass(s, stats))
    lines.emplace_back("reflection none: light that comes through glass is left out");
  if (s.reflection.given && !s.reflects() && stats.environment)
    lines.emplace_back("reflection none: the environment is seen, and lights nothing");
  if (s.reflection.given && !s.reflects() && s.indirect > 0)
    lines.emplace_back("reflection none: light from other surfaces is left out");
  if (s.reflection.given && !s.reflects() && s.shadow_catcher.value.kind != ShadowCatcher::Kind::off)
    lines.emplace_back("reflection none: the shadow catcher catches nothing");
  return lines;
}

}  // namespace pinocchio
