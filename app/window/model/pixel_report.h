#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pinocchio/engine.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

struct Model;

// What one pixel is made of.
struct PixelReport {
  struct LightShare {
    std::string name;
    bool reaches = false;   // no shadow ray is blocked, and the surface faces the light
    glm::vec3 light{0.0f};  // what it adds to the pixel, linear
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
  int bounces = 0;           // of the longest path
  RayCounts rays;
};

// Draws single pixels on the CPU, apart from the window's frames.
class PixelInspector {
 public:
  // Nothing where there is no tree yet: it is requested.
  [[nodiscard]] std::optional<PixelReport> report(Model& model, glm::ivec2 pixel);
  // Puts the report into the model. False: it is there already.
  bool update(Model& model, glm::ivec2 pixel);

 private:
  [[nodiscard]] FrameResult draw(const FrameRequest& request);
  [[nodiscard]] PixelReport report_of(FrameRequest request);

  std::unique_ptr<Engine> engine_;        // null: no pixel was reported yet. It opens no OpenGL
  std::optional<FrameRequest> reported_;  // what the model's report was made from
};

}  // namespace pinocchio::app
