#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "gl/context/context.h"
#include "gl/open/candidate.h"

struct GLFWwindow;

namespace pinocchio::gl {

// A context with a window on the display, made by GLFW. Construct it, handle its events and destroy it on the
// main thread.
class GlfwContext final : public Context {
 public:
  struct Request {
    std::string title = "pinocchio";
    glm::ivec2 size{1, 1};  // the window's content area, in the display's units
    bool visible = false;
    bool debug = false;
  };
  // Throws Error where there is no display, or its contexts have less than we need.
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
  GLFWwindow* callers_window_ = nullptr;  // current in GLFW before, and again after unbind()
};

// A window that is never shown. It needs a display, so it is used only on request.
[[nodiscard]] Candidate glfw_candidate();

}  // namespace pinocchio::gl
