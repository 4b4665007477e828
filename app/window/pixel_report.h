#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pinocchio/engine.h"
#include "pinocchio/frame.h"

namespace pinocchio::app {

// What one pixel is made of.
struct PixelReport {
  struct LightShare {
    std::string name;
    bool reaches = false;   // no shadow ray is blocked, and the surface faces it
    glm::vec3 light{0.0f};  // that it brings the pixel, linear
  };

  glm::ivec2 pixel{0};
  glm::vec3 color{0.0f};  // linear light, one sample at the pixel's centre
  std::uint32_t triangle = kNoTriangle;
  std::uint32_t material = 0;  // index in the mesh's
  float depth = 0.0f;          // along the view axis, scene units
  glm::vec3 position{0.0f}, normal{0.0f};
  std::vector<LightShare> lights;
  glm::vec3 ambient{0.0f};   // and emitted
  glm::vec3 mirrored{0.0f};  // reflected and refracted light
  int bounces = 0;           // after which no further ray is fired
  RayCounts rays;
};

// Draws single pixels on the CPU, apart from the window's frames.
class PixelInspector {
 public:
  // view: of the whole picture.
  [[nodiscard]] PixelReport look(const Scene& scene, const std::shared_ptr<const Tracer>& tracer,
                                 const View& view, glm::ivec2 pixel, int depth);

 private:
  [[nodiscard]] FrameResult draw(const FrameRequest& request);

  Engine engine_;  // its frames are the CPU's alone: no OpenGL is opened
};

}  // namespace pinocchio::app
