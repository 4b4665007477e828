#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "gl/candidate.h"
#include "gl/context.h"

struct GLFWwindow;

namespace pinocchio::gl {

// A context that comes with a window of the display, by GLFW. To be made, used for events and destroyed on
// the main thread.
class GlfwContext final : public Context {
 public:
  struct Request {
    std::string title = "pinocchio";
    glm::ivec2 size{1, 1};  // of the window's inside, in the display's units
    bool visible = false;
    bool debug = false;
  };
  // Throws Error where there is no display, or none of its contexts is enough.
  explicit GlfwContext(const Request& request);
  ~GlfwContext() override;

  void enter() override;
  [[nodiscard]] GLFWwindow* window() const { return window_; }

 private:
  void open(const Request& request);
  [[nodiscard]] bool is_bound() const override;
  void bind() override;
  void unbind() override;
  [[nodiscard]] GLADloadfunc loader() const override;

  std::shared_ptr<void> library_;  // GLFW, initialised while any context lives
  GLFWwindow* window_ = nullptr;
  NativeContext native_;
  GLFWwindow* callers_window_ = nullptr;  // that GLFW had for current, and has again after unbind()
};

// GLFW's way, in a window that is never shown. Needs a display, so it is only taken where it is asked for.
[[nodiscard]] Candidate glfw_candidate();

}  // namespace pinocchio::gl
