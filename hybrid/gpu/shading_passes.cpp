#include "hybrid/gpu/shading_passes.h"

#include "hybrid/exchange/encode.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "hybrid/gpu/visibility_pass.h"

namespace pinocchio {

void ShadingPasses::composite(const Inputs& inputs, LightSet lights, const Traced& traced,
                              const gl::Framebuffer& target) {
  Definitions definitions = definitions_of(inputs, traced);
  if (inputs.lights.any_size()) {
    definitions.emplace_back("HAS_SIZED_LIGHTS");
    if (inputs.options.denoise) definitions.emplace_back("SIZED_LIGHTS_ARE_TRACED");
    if (inputs.options.glossy == Glossy::sampled) definitions.emplace_back("HAS_SAMPLED_LOBES");
  }
  if (inputs.options.denoise && traced.reflection.texture) definitions.emplace_back("ADDS_FILTERED");
  if (lights == LightSet::free) definitions.emplace_back("FREE_LIGHTS_ONLY");
  if (inputs.eye_medium) definitions.emplace_back("EYE_IN_MEDIUM");
  if (traced.mask.texture && inputs.lights.casting() > traced.mask.bits)
    definitions.emplace_back("LIGHTS_IN_REFLECTION");
  const Background& background = inputs.options.background;
  const Backdrop backdrop = backdrop_of(inputs.scene, background, inputs.options.background_blur);
  if (backdrop.picture) {
    definitions.emplace_back("HAS_ENVIRONMENT");
    send(backdrop.picture);  // first: it binds textures of its own
  }
  const bool has_color = background.kind == Background::Kind::color;
  if (has_color) definitions.emplace_back("HAS_BACKGROUND_COLOR");
  const bool catches = traced.reflection.texture && inputs.options.catcher_height;
  if (catches) definitions.emplace_back("HAS_CATCHER");
  gl::begin_fullscreen_pass(target);
  const gl::Program& p = program("composite.frag", definitions);
  p.use();
  const int unit = bind(p, inputs, traced);
  if (backdrop.picture) bind_backdrop(p, backdrop, unit);
  if (inputs.eye_medium) {
    p.set("eye_medium_color", inputs.eye_medium->attenuation_color);
    p.set("eye_medium_distance", inputs.eye_medium->attenuation_distance);
  }
  if (has_color) p.set("background_color", background.color);
  if (catches) p.set("catcher_height", *inputs.options.catcher_height);
  if (inputs.lights.any_size()) {
    const shared::Sampling& sampling = traced.of ? traced.of->sampling : inputs.options.sampling;
    p.set("sequence", sampling.sequence);
    p.set("sample_index", sampling.index);
    p.set("sample_seed", sampling.seed);
    p.set("sample_count", sampling.count);
    p.set("throughput_cutoff", inputs.options.throughput_cutoff);
  }
  triangle_.draw();
}

void ShadingPasses::send(const std::shared_ptr<const Environment>& environment) {
  if (sent_ == environment) return;
  const Image<glm::vec3>& picture = environment->radiance();
  environment_ = gl::Texture(picture.size(), gl::kRgb32F);
  gl::Upload().send(std::as_bytes(picture.pixels()), environment_);
  sent_ = environment;
}

void ShadingPasses::bind_backdrop(const gl::Program& program, const Backdrop& backdrop, int unit) const {
  program.set("environment", unit, environment_);
  program.set("environment_size", glm::vec2(environment_.size()));
  program.set("environment_turn", backdrop.rotation_deg / 360.0f);
  program.set("environment_strength", backdrop.strength);
}

void ShadingPasses::inspect(const Inputs& inputs, const Traced& traced, const Inspected& what,
                            const gl::Framebuffer& target) {
  Definitions definitions = definitions_of(inputs, traced);
  if (!what.definition.empty()) definitions.push_back(what.definition);
  gl::begin_fullscreen_pass(target);
  const gl::Program& p = program("inspect.frag", definitions);
  p.use();
  bind(p, inputs, traced);
  p.set("slot", what.slot);
  p.set("first_slot", what.first_slot);
  p.set("age_frames", what.age_frames);
  p.set("range_lo", what.range_lo);
  p.set("range_hi", what.range_hi);
  triangle_.draw();
}

void ShadingPasses::normals(const Inputs& inputs, const gl::Framebuffer& target) {
  Definitions definitions = definitions_of(inputs);
  definitions.emplace_back("NORMALS_ONLY");
  gl::begin_fullscreen_pass(target);
  const gl::Program& p = program("gbuffer.frag", definitions);
  p.use();
  bind(p, inputs);
  triangle_.draw();
}

void ShadingPasses::gbuffer(const Inputs& inputs, const gl::Framebuffer& target) {
  gl::begin_fullscreen_pass(target);
  const gl::Program& p = program("gbuffer.frag", definitions_of(inputs));
  p.use();
  bind(p, inputs);
  triangle_.draw();
}

void ShadingPasses::show(const gl::Texture& finished, const Inputs& inputs, const gl::Framebuffer& target) {
  gl::begin_fullscreen_pass(target);
  Definitions definitions = definitions_of(inputs);
  definitions.push_back("FINISHED_TEXELS " + std::to_string(texels_a_pixel(finished)));
  const gl::Program& p = program("show.frag", definitions);
  p.use();
  p.set("finished", bind(p, inputs), finished);
  triangle_.draw();
}

const gl::Program& ShadingPasses::program(const std::string& file, const Definitions& definitions) const {
  return programs_->get("fullscreen.vert", file, definitions);
}

int ShadingPasses::bind(const gl::Program& program, const Inputs& inputs) const {
  program.set("eye", inputs.view.eye);
  program.set("corner", inputs.view.corner);
  program.set("step_x", inputs.view.step_x);
  program.set("step_y", inputs.view.step_y);
  program.set("first", inputs.view.first);
  program.set("texture_spread", inputs.options.texture_footprint);
  program.set("ids", 0, inputs.ids);
  return inputs.lights.bind(program, inputs.mesh.bind(program, 1));
}

int ShadingPasses::bind(const gl::Program& program, const Inputs& inputs, const Traced& traced) const {
  const auto& [mask, reflection, of] = traced;
  int unit = bind(program, inputs);
  if (mask.texture) program.set("mask", unit++, *mask.texture);
  if (reflection.texture) program.set("reflection", unit++, *reflection.texture);
  if (reflection.index) program.set("reflection_tiles", unit++, *reflection.index);
  if (of) {
    program.set("old_ids", unit++, of->ids);
    program.set("old_eye", of->view.eye);
    program.set("old_pixel_from_eye", glm::mat3(pixel_from_eye(of->view)));
  }
  return unit;
}

ShadingPasses::Definitions ShadingPasses::definitions_of(const Inputs& inputs) {
  Definitions definitions{"ID_BITS " + std::to_string(inputs.id_bits)};
  if (inputs.view.parallel) definitions.emplace_back("PARALLEL_RAYS");
  if (lifts(inputs.options.terminator)) definitions.emplace_back("TERMINATOR_LIFTS");
  if (inputs.options.terminator == Terminator::smoothed) definitions.emplace_back("TERMINATOR_SMOOTHS");
  const Definitions& of_maps = inputs.mesh.maps().definitions();
  definitions.insert(definitions.end(), of_maps.begin(), of_maps.end());
  return definitions;
}

ShadingPasses::Definitions ShadingPasses::definitions_of(const Inputs& inputs, const Traced& traced) {
  const auto& [mask, reflection, of] = traced;
  Definitions definitions = definitions_of(inputs);
  const auto define = [&](const std::string& name, int value) {
    definitions.push_back(name + " " + std::to_string(value));
  };
  if (mask.texture) {
    definitions.emplace_back("HAS_MASK");
    define("MASK_BITS", mask.bits);
    define("MASK_SCALE", mask.scale);
  }
  if (reflection.texture) {
    definitions.emplace_back("HAS_REFLECTION");
    define("REFLECTION_SCALE", reflection.scale);
    define("REFLECTION_TEXELS", texels_a_pixel(*reflection.texture));
    if (packing(reflection.format).is_srgb) definitions.emplace_back("REFLECTION_IS_SRGB");
    if (reflection.index) define("REFLECTION_TILE", kReflectionTile);
  }
  if (of) definitions.emplace_back("REPROJECT");
  return definitions;
}

}  // namespace pinocchio
