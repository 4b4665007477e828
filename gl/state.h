// The state of a context that our calls depend on: set by each pass, and, where the context is a caller's,
// given back.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace pinocchio::gl {

// Texture units that our programs use: as many as OpenGL 3.3 has.
inline constexpr int kTextureUnits = 16;

// Sets all that decides which fragments a draw or a clear has and where they go, but for the framebuffer and
// its viewport: nothing is culled, clipped, blended, masked or converted, unless it is said here.
struct RasterState {
  bool depth = false;         // reversed: greater is nearer
  bool srgb = true;           // linear light is encoded, where the target's format is sRGB
  bool scissor = false;       // to the box below
  glm::ivec4 scissor_box{0};  // x, y, width, height
};
void set_raster_state(const RasterState& state);
void set_viewport(glm::ivec2 lo, glm::ivec2 size);

// Pictures travel tightly packed, rows of any length, and their values are not clamped.
void set_pixel_store();

// What a caller's context has of all this, and what is bound in it.
class SavedState {
 public:
  // Reads it, and lets our calls find a context without bound buffers. Throws Error, with nothing changed,
  // where the caller counts what is drawn, or draws on a condition: neither can be interrupted.
  void save();
  void restore() noexcept;

 private:
  void read();
  void read_program();

  std::vector<std::function<void()>> restorers_;
};

}  // namespace pinocchio::gl
