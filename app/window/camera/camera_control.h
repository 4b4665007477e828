#pragma once

#include <glm/glm.hpp>

#include "pinocchio/bounds.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

// Moves the camera: on a turntable around its target, where up stays up, and in flight. Distances on the
// screen are in pixels, y downwards.
class CameraControl {
 public:
  // frame_all() shows `interest`. The speed of flight is proportional to the size of `bounds`.
  void set_scene(const Bounds& bounds, const Bounds& interest) {
    bounds_ = bounds;
    interest_ = interest;
  }
  void set_camera(const Camera& camera) { camera_ = camera; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

  // Turns around the target: the window's height is half a turn.
  void orbit(glm::vec2 pixels, float window_height);
  // Turns the view around the eye.
  void turn_view(glm::vec2 pixels, float window_height);
  // Moves sideways, so that points at the target's distance follow the pointer.
  void pan(glm::vec2 pixels, float window_height);
  // Moves towards the target (positive) or away from it; a step is a tenth of the distance.
  void zoom(float steps);
  // Moves along the camera's right, up and forward axes (each -1 to 1); the target keeps its distance.
  void fly(const glm::vec3& along, float seconds, bool fast);
  // Shows the bounds of interest, from the same side. aspect: width / height.
  void frame_all(float aspect);
  // Moves to the direction `from` of the target, at the same distance.
  void view_from(const glm::vec3& from);
  // Sees the target as large as before, where the other projection has a height or a field of view.
  void set_projection(Projection projection);
  // The camera turns around that point from now on, and shows it in the middle.
  void set_target(const glm::vec3& p);
  [[nodiscard]] const Bounds& interest() const { return interest_; }

 private:
  [[nodiscard]] float distance() const;
  void turn(glm::vec3& arm, glm::vec2 pixels, float window_height) const;

  Camera camera_;
  Bounds bounds_, interest_;
};

}  // namespace pinocchio::app
