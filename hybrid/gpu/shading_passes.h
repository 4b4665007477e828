#pragma once

#include <memory>
#include <string>

#include "core/shade/shared.h"
#include "core/trace/rays/trace_options.h"
#include "gl/objects/draw.h"
#include "gl/objects/program.h"
#include "gl/transfer/transfer.h"
#include "hybrid/gpu/gpu_mesh.h"
#include "hybrid/gpu/programs.h"
#include "pinocchio/settings.h"

namespace pinocchio {

// The lights that a pass adds up.
enum class LightSet {
  all,   // casting lights where the mask says so, or everywhere without a mask; the others everywhere
  free,  // lights that cast no shadow
};

// An older frame whose mask and reflection are warped to this one.
struct OlderFrame {
  const gl::Texture& ids;
  shared::ViewParams view;
  shared::Sampling sampling;
};

// The passes that shade pixels from their ids (shaders/composite.frag, gbuffer.frag, show.frag,
// inspect.frag).
class ShadingPasses {
 public:
  struct Inputs {
    const GpuMesh& mesh;
    const GpuLights& lights;
    shared::ViewParams view;
    const gl::Texture& ids;
    int id_bits;
    TraceOptions options;
    const Material* eye_medium;  // absorbs light around the eye; null: none does
    const Scene& scene;          // its environment may be the background
  };
  // The CPU's answer; null parts are missing.
  struct Traced {
    struct Mask {
      const gl::Texture* texture = nullptr;  // packed_mask_texture(); null: every light reaches all
      int bits = 0;                          // a sample
      int scale = 1;                         // one sample for scale x scale pixels
    } mask;
    struct Reflection {
      const gl::Texture* texture = nullptr;
      const gl::Texture* index = nullptr;  // where its tiles are; null: it is whole
      ReflectionFormat format = ReflectionFormat::none;
      int scale = 1;
    } reflection;
    const OlderFrame* of = nullptr;  // the frame they were traced for; null: this one
  };

  explicit ShadingPasses(std::shared_ptr<Programs> programs) : programs_(std::move(programs)) {}

  // Light of every light by the reflection model, plus reflection, linear; where nothing is seen, the
  // background with alpha 0, or with the share of light that the shadow catcher lost.
  void composite(const Inputs& inputs, LightSet lights, const Traced& traced, const gl::Framebuffer& target);
  // A frame's layer as the window shows it.
  struct Inspected {
    std::string definition;  // of shaders/inspect.frag; empty: all is grey
    int slot = 0;            // of the mask
    int first_slot = 0;      // that the mask's texture has
    int age_frames = 0;
    glm::vec3 range_lo{0.0f}, range_hi{1.0f};  // of depth and position
  };
  void inspect(const Inputs& inputs, const Traced& traced, const Inspected& what,
               const gl::Framebuffer& target);
  // Shading normals, 0.5 n + 0.5.
  void normals(const Inputs& inputs, const gl::Framebuffer& target);
  // Design 2's 128 bits a pixel.
  void gbuffer(const Inputs& inputs, const gl::Framebuffer& target);
  // A finished sRGB picture to linear light; alpha as above.
  void show(const gl::Texture& finished, const Inputs& inputs, const gl::Framebuffer& target);

 private:
  using Definitions = Programs::Definitions;
  [[nodiscard]] const gl::Program& program(const std::string& file, const Definitions& definitions) const;
  // Sets the inputs of every pass over ids; returns the next free texture unit.
  int bind(const gl::Program& program, const Inputs& inputs) const;
  int bind(const gl::Program& program, const Inputs& inputs, const Traced& traced) const;
  // The background's picture: sends it, and sets it for the program in use.
  void send(const std::shared_ptr<const Environment>& environment);
  void bind_backdrop(const gl::Program& program, const Backdrop& backdrop, int unit) const;
  [[nodiscard]] static Definitions definitions_of(const Inputs& inputs);
  [[nodiscard]] static Definitions definitions_of(const Inputs& inputs, const Traced& traced);

  std::shared_ptr<Programs> programs_;
  gl::FullscreenTriangle triangle_;
  std::shared_ptr<const Environment> sent_;  // in environment_
  gl::Texture environment_;
};

}  // namespace pinocchio
