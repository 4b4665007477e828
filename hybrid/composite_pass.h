#pragma once

#include <compare>
#include <filesystem>
#include <map>

#include "core/trace/shared.h"
#include "gl/draw.h"
#include "gl/program.h"
#include "hybrid/gpu_scene.h"

namespace pinocchio {

// reads: ids, and where the plan has them the shadow mask and the reflection. writes: the picture, linear
// light, RGBA16F; alpha 0 where nothing is seen.
class CompositePass {
 public:
  struct Inputs {
    const gl::Texture& ids;
    const gl::Texture* mask = nullptr;  // R8UI, MaskImage's packed rows; null: every light reaches all
    int mask_bits = 0;
    const gl::Texture* reflection = nullptr;  // RGB; null: none
  };

  explicit CompositePass(std::filesystem::path shaders) : shaders_(std::move(shaders)) {}

  void draw(const GpuScene& scene, const shared::ViewParams& view, const Inputs& inputs,
            const gl::Framebuffer& target);

 private:
  // What the shader is compiled for: a scene pays for what it has.
  struct Variant {
    int mask_bits;
    bool reflection, textures;
    auto operator<=>(const Variant&) const = default;
  };
  const gl::Program& program_for(const Variant& variant);

  std::filesystem::path shaders_;
  std::map<Variant, gl::Program> programs_;
  gl::FullscreenTriangle triangle_;
};

}  // namespace pinocchio
