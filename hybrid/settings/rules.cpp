// Presets, and combinations of settings that are refused.
#include <algorithm>

#include "pinocchio/settings.h"

namespace pinocchio {
namespace {

void draw_all_on(Processor visibility, Processor composite, Settings& s) {
  s.visibility = visibility;
  s.composite = composite;
}

void apply_raster(Settings& s) {
  draw_all_on(Processor::gpu, Processor::gpu, s);
  s.mask_bits = 0;
  s.reflection = ReflectionFormat::none;
  s.depth = 0;
}

// The fixed budget of 2005: 6 bytes a pixel up and 4 down where the GPU composites, else 19 and 3.
void apply_slides(Settings& s) {
  if (s.visibility == Processor::cpu || (s.mask_bits.given && s.mask_bits == 0)) return;  // of hybrid frames
  const bool on_gpu = s.composite == Processor::gpu;
  s.visibility = Processor::gpu;
  s.mask_bits = 8;
  s.mask_scale = s.reflection_scale = 1;
  s.reflection = ReflectionFormat::rgb8;
  s.tiles = s.reuse = false;
  s.light_cutoff = 0.0f;
  s.glass_shadows = GlassShadows::opaque;
  s.id_bits = on_gpu ? 24 : 32;
  s.normals = on_gpu;
  s.wide = !on_gpu;
}

constexpr std::array kPresets{
    Preset{"mode", "hybrid", "the GPU rasterises, the CPU traces", [](Settings&) {}},
    Preset{"mode", "raytrace", "the CPU alone; no OpenGL is opened",
           [](Settings& s) { draw_all_on(Processor::cpu, Processor::cpu, s); }},
    Preset{"mode", "raster", "the GPU alone: no shadows, no mirrors", apply_raster},
    Preset{"mode", "auto", "as hybrid where OpenGL is hardware, else as raytrace",
           [](Settings& s) { s.by_machine = true; }},
    Preset{"design", "1", "the picture is put together on the GPU",
           [](Settings& s) { s.composite = Processor::gpu; }},
    Preset{"design", "2", "the picture is put together on the CPU",
           [](Settings& s) { draw_all_on(Processor::gpu, Processor::cpu, s); }},
    Preset{"plan", "auto", "only what the scene needs is modelled and sent", [](Settings&) {}},
    Preset{"plan", "slides", "the fixed bytes of 2005", apply_slides},
};

// What the filter needs. Where denoise is not given, it is off without it (resolve.cpp).
bool can_denoise_pixels(const Settings& s) {
  return s.max_noise == 0.0f && s.mask_scale == 1 && s.reflection_scale == 1;
}

bool can_send_denoised(const Settings& s) {
  return s.spp == 1 || s.composite == Processor::cpu ||
         (s.reflection != ReflectionFormat::rgb8 && s.reflection != ReflectionFormat::rgb9e5);
}

constexpr std::array kRules{
    Rule{"average_layers counts as many samples in every pixel", "leave it out, or max_noise",
         [](const Settings& s) { return s.average_layers && s.max_noise > 0.0f; }},
    Rule{"exchange reproject warps a mask and a reflection, which composite cpu does not send",
         "use composite gpu (--design 1)",
         [](const Settings& s) {
           return s.exchange == Exchange::reproject && s.visibility == Processor::gpu &&
                  s.composite == Processor::cpu;
         }},
    Rule{"mask_scale and reflection_scale above 1 and tiles are for what travels to the GPU",
         "leave them out, or use composite gpu (--design 1)",
         [](const Settings& s) {
           return s.composite == Processor::cpu && (s.mask_scale > 1 || s.reflection_scale > 1 || s.tiles);
         }},
    Rule{"normals travel with visibility gpu and composite gpu alone",
         "leave it out, or use both (--design 1)",
         [](const Settings& s) {
           return s.normals && (s.visibility == Processor::cpu || s.composite == Processor::cpu);
         }},
    Rule{"wide is for visibility gpu and composite cpu alone", "leave it out, or use both (--design 2)",
         [](const Settings& s) {
           return s.wide && (s.visibility == Processor::cpu || s.composite == Processor::gpu);
         }},
    Rule{"coverage needs the CPU to draw alone", "leave it out, or use --mode raytrace",
         [](const Settings& s) { return s.coverage && s.uses_gpu(); }},
    Rule{"denoise filters pixels that have as many samples as each other",
         "leave out max_noise, mask_scale and reflection_scale, or use --no-denoise",
         [](const Settings& s) { return s.denoise && s.denoise.given && !can_denoise_pixels(s); }},
    Rule{"denoise of several samples sends light below zero, which reflection rgb8 and rgb9e5 cannot hold",
         "use reflection half or float, or --no-denoise",
         [](const Settings& s) { return s.denoise && s.denoise.given && !can_send_denoised(s); }},
    Rule{"shadow_catcher does not travel with visibility gpu and composite cpu",
         "leave it out, use composite gpu (--design 1), or let the CPU draw alone (--mode raytrace)",
         [](const Settings& s) {
           return s.shadow_catcher.value.kind != ShadowCatcher::Kind::off && s.visibility == Processor::gpu &&
                  s.composite == Processor::cpu;
         }},
    Rule{"this processor does not have the SIMD level", "'pinocchio info --system' lists what it has",
         [](const Settings& s) { return !isa_supported(s.isa); }},
};

}  // namespace

std::span<const Preset> presets() {
  return kPresets;
}

void draw_on_cpu(Settings& settings) {
  draw_all_on(Processor::cpu, Processor::cpu, settings);
}

bool apply_preset(std::string_view option, std::string_view value, Settings& settings) {
  const auto* const found =
      std::ranges::find_if(kPresets, [&](const Preset& p) { return p.option == option && p.value == value; });
  if (found == kPresets.end()) return false;
  found->apply(settings);
  return true;
}

bool can_denoise(const Settings& settings) {
  return can_denoise_pixels(settings) && can_send_denoised(settings);
}

std::span<const Rule> settings_rules() {
  return kRules;
}

const Rule* broken_rule(const Settings& settings) {
  const auto* const found =
      std::ranges::find_if(kRules, [&](const Rule& rule) { return rule.broken(settings); });
  return found == kRules.end() ? nullptr : found;
}

const Rule* broken_by(const Settings& settings, std::string_view field, std::string_view text) {
  Settings changed = settings;
  const Field* const found = find_field(field);
  return found && found->take(text, changed) ? broken_rule(changed) : nullptr;
}

}  // namespace pinocchio
