// The state of a context that our calls depend on. Each pass sets it; in a caller's context it is restored.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace pinocchio::gl {

// The texture units of our programs: as many as OpenGL 3.3 has.
inline constexpr int kTextureUnits = 16;

// Sets all state, except framebuffer and viewport, that decides which fragments a draw or a clear produces
// and where they go: nothing is culled, clipped, blended, masked or converted, unless a field says so.
struct RasterState {
  bool depth = false;         // reversed: greater is nearer
  bool srgb = true;           // linear light is encoded, where the target's format is sRGB
  bool fronts_only = false;   // only triangles that run counterclockwise; row 0 is the picture's top
  bool scissor = false;       // only the box below is drawn
  glm::ivec4 scissor_box{0};  // x, y, width, height
};
void set_raster_state(const RasterState& state);
void set_viewport(glm::ivec2 lo, glm::ivec2 size);

// Pictures are transferred tightly packed, with rows of any length, and their values are not clamped.
void set_pixel_store();

// The state of a caller's context, and what is bound in it.
class SavedState {
 public:
  // Reads the state and unbinds buffers. Throws Error, with nothing changed, where the caller has an active
  // query or a conditional render: neither can be suspended.
  void save();
  void restore() noexcept;

 private:
  void read();
  void read_program();

  std::vector<std::function<void()>> restorers_;
};

}  // namespace pinocchio::gl
