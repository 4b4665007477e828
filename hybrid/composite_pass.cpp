#include "hybrid/composite_pass.h"

#include <string>
#include <vector>

namespace pinocchio {

void CompositePass::draw(const GpuScene& scene, const shared::ViewParams& view, const Inputs& inputs,
                         const gl::Framebuffer& target) {
  gl::begin_fullscreen_pass(target);
  const gl::Program& program =
      program_for({inputs.mask ? inputs.mask_bits : 0, inputs.reflection != nullptr, scene.textured()});
  program.use();
  program.set("eye", view.eye);
  program.set("corner", view.corner);
  program.set("step_x", view.step_x);
  program.set("step_y", view.step_y);
  program.set("first", view.first);
  program.set("no_triangle", inputs.ids.format() == gl::kR16Ui ? 0xffffu : 0xffffffffu);
  int unit = 0;
  program.set("ids", unit++, inputs.ids);
  if (inputs.mask) program.set("mask", unit++, *inputs.mask);
  if (inputs.reflection) program.set("reflection", unit++, *inputs.reflection);
  scene.bind(program, unit);
  triangle_.draw();
}

const gl::Program& CompositePass::program_for(const Variant& variant) {
  const auto found = programs_.find(variant);
  if (found != programs_.end()) return found->second;
  std::vector<std::string> definitions;
  if (variant.mask_bits > 0) {
    definitions.emplace_back("HAS_MASK");
    definitions.emplace_back("MASK_BITS " + std::to_string(variant.mask_bits));
  }
  if (variant.reflection) definitions.emplace_back("HAS_REFLECTION");
  if (variant.textures) definitions.emplace_back("HAS_TEXTURES");
  return programs_.emplace(variant, gl::Program(shaders_, "fullscreen.vert", "composite.frag", definitions))
      .first->second;
}

}  // namespace pinocchio
