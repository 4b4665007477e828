#pragma once

#include <glm/glm.hpp>

#include "pinocchio/bounds.h"
#include "pinocchio/camera.h"

namespace pinocchio::app {

// How mouse and keys move the camera: a turntable around its target (up stays up), and flight. Knows no
// window; distances on the screen are in pixels, y downwards.
class CameraControl {
 public:
  // What the scene is like: frame_all() shows what matters of it, flight is as fast as it is large.
  void set_scene(const Bounds& bounds, const Bounds& interest) {
    bounds_ = bounds;
    interest_ = interest;
  }
  void set_camera(const Camera& camera) { camera_ = camera; }
  [[nodiscard]] const Camera& camera() const { return camera_; }

  // Turns around the target: the window's height is half a turn.
  void orbit(glm::vec2 pixels, float window_height);
  // Turns the view, the eye stays.
  void look(glm::vec2 pixels, float window_height);
  // Moves sideways so that what is at the target's distance follows the pointer.
  void pan(glm::vec2 pixels, float window_height);
  // Nearer to the target (positive) or away; a step is a tenth of the distance.
  void zoom(float steps);
  // Flies along its own right, up and forward axes (each -1 to 1); the target keeps its distance.
  void fly(const glm::vec3& along, float seconds, bool fast);
  // What matters of the scene in view, seen from the same side. aspect: width / height.
  void frame_all(float aspect);
  // The same distance, seen along an axis: from where `from` points, `up` upwards.
  void view_from(const glm::vec3& from);
  // From now on it turns around that point, which comes to the middle.
  void look_at(const glm::vec3& p);
  [[nodiscard]] const Bounds& interest() const { return interest_; }

 private:
  [[nodiscard]] float distance() const;
  void turn(glm::vec3& arm, glm::vec2 pixels, float window_height) const;

  Camera camera_;
  Bounds bounds_, interest_;
};

}  // namespace pinocchio::app
