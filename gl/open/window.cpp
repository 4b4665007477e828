#include "gl/open/window.h"

#include <cctype>
#include <utility>

#include "gl/context/error.h"
#include "gl/open/glfw_library.h"
#include "gl/open/probe.h"

namespace pinocchio::gl {
namespace {

static_assert(kKeySpace == GLFW_KEY_SPACE && kKeyEscape == GLFW_KEY_ESCAPE && kKeyEnter == GLFW_KEY_ENTER &&
              kKeyTab == GLFW_KEY_TAB && kKeyHome == GLFW_KEY_HOME && kKeyF1 == GLFW_KEY_F1 &&
              kKeyRight == GLFW_KEY_RIGHT && kKeyLeft == GLFW_KEY_LEFT &&
              kKeyLeftControl == GLFW_KEY_LEFT_CONTROL && kKeyRightControl == GLFW_KEY_RIGHT_CONTROL &&
              kKeyF10 == GLFW_KEY_F10 && kKeyF11 == GLFW_KEY_F11 && kKeyF12 == GLFW_KEY_F12 &&
              kKeyPlus == GLFW_KEY_KP_ADD && kKeyMinus == GLFW_KEY_KP_SUBTRACT);

using Events = std::vector<WindowEvent>;

Modifiers modifiers_of(int mods) {
  return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

Events& events_of(GLFWwindow* window) {
  return *static_cast<Events*>(glfw().GetWindowUserPointer(window));
}

int character_of(int key, int scancode) {
  const char* const name = glfw().GetKeyName(key, scancode);
  if (!name || name[0] == '\0' || name[1] != '\0') return key;
  return std::toupper(static_cast<unsigned char>(name[0]));
}

void on_key(GLFWwindow* window, int key, int scancode, int action, int mods) {
  events_of(window).push_back(KeyEvent{key, character_of(key, scancode), action != GLFW_RELEASE,
                                       action == GLFW_REPEAT, modifiers_of(mods)});
}

void on_button(GLFWwindow* window, int button, int action, int mods) {
  events_of(window).push_back(ButtonEvent{button, action == GLFW_PRESS, modifiers_of(mods)});
}

void on_pointer(GLFWwindow* window, double x, double y) {
  int width = 0, height = 0, pixels_x = 0, pixels_y = 0;
  glfw().GetWindowSize(window, &width, &height);
  glfw().GetFramebufferSize(window, &pixels_x, &pixels_y);
  if (width < 1 || height < 1) return;
  const glm::dvec2 scale(static_cast<double>(pixels_x) / width, static_cast<double>(pixels_y) / height);
  events_of(window).push_back(PointerEvent{glm::vec2(glm::dvec2(x, y) * scale)});
}

void on_scroll(GLFWwindow* window, double, double y) {
  events_of(window).push_back(ScrollEvent{static_cast<float>(y)});
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
  events_of(window).push_back(DropEvent{{paths, paths + count}});
}

void on_text(GLFWwindow* window, unsigned character) {
  events_of(window).push_back(TextEvent{character});
}

void on_expose(GLFWwindow* window) {
  events_of(window).push_back(ExposeEvent{});
}

void on_resize(GLFWwindow* window, int, int) {
  events_of(window).push_back(ExposeEvent{});
}

void on_focus(GLFWwindow* window, int) {
  events_of(window).push_back(ExposeEvent{});
}

GlfwContext::Request request_of(const std::string& title, glm::ivec2 size, bool debug) {
  GlfwContext::Request request;
  request.title = title;
  request.size = size;
  request.visible = true;
  request.debug = debug;
  return request;
}

// The monitor with the window's centre.
GLFWmonitor* monitor_of(const glm::ivec4& window) {
  const glm::ivec2 middle = glm::ivec2(window) + glm::ivec2(window.z, window.w) / 2;
  int count = 0;
  GLFWmonitor** const monitors = glfw().GetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    glm::ivec4 area(0);
    glfw().GetMonitorWorkarea(monitors[i], &area.x, &area.y, &area.z, &area.w);
    const glm::ivec2 in = middle - glm::ivec2(area);
    if (in.x >= 0 && in.y >= 0 && in.x < area.z && in.y < area.w) return monitors[i];
  }
  return glfw().GetPrimaryMonitor();
}

}  // namespace

Window::Window(const std::string& title, glm::ivec2 size, bool debug) try
    : context_(request_of(title, size, debug)) {
  probe(context_.info());
  listen();
  glfw().SetWindowSizeLimits(handle(), 64, 64, GLFW_DONT_CARE, GLFW_DONT_CARE);
  set_vsync(true);
} catch (const Error& error) {
  throw NoContextError(std::string("no window: ") + error.what());
}

void Window::listen() {
  glfw().SetWindowUserPointer(handle(), &events_);
  glfw().SetKeyCallback(handle(), on_key);
  glfw().SetMouseButtonCallback(handle(), on_button);
  glfw().SetCursorPosCallback(handle(), on_pointer);
  glfw().SetScrollCallback(handle(), on_scroll);
  glfw().SetDropCallback(handle(), on_drop);
  glfw().SetCharCallback(handle(), on_text);
  glfw().SetWindowRefreshCallback(handle(), on_expose);
  glfw().SetFramebufferSizeCallback(handle(), on_resize);
  glfw().SetWindowFocusCallback(handle(), on_focus);
}

std::vector<WindowEvent> Window::take_events(double timeout_s) {
  if (timeout_s > 0.0) {
    glfw().WaitEventsTimeout(timeout_s);
  } else {
    glfw().PollEvents();
  }
  return std::exchange(events_, {});
}

bool Window::is_down(int key) const {
  return glfw().GetKey(handle(), key) == GLFW_PRESS;
}

bool Window::close_asked() const {
  return glfw().WindowShouldClose(handle()) != 0;
}

void Window::ask_close() {
  glfw().SetWindowShouldClose(handle(), GLFW_TRUE);
}

void Window::stay_open() {
  glfw().SetWindowShouldClose(handle(), GLFW_FALSE);
}

glm::ivec2 Window::pixels() const {
  glm::ivec2 size(0);
  glfw().GetFramebufferSize(handle(), &size.x, &size.y);
  return size;
}

bool Window::minimised() const {
  return glfw().GetWindowAttrib(handle(), GLFW_ICONIFIED) != 0 || pixels().x < 1 || pixels().y < 1;
}

float Window::content_scale() const {
  float x = 1.0f, y = 1.0f;
  glfw().GetWindowContentScale(handle(), &x, &y);
  // A display that enlarges windows itself has large units already.
  int width = 0;
  glfw().GetWindowSize(handle(), &width, nullptr);
  const float pixels_a_unit = width > 0 ? static_cast<float>(pixels().x) / static_cast<float>(width) : 1.0f;
  return x > 0.0f && pixels_a_unit > 0.0f ? x / pixels_a_unit : 1.0f;
}

bool Window::full_screen() const {
  return glfw().GetWindowMonitor(handle()) != nullptr;
}

void Window::set_full_screen(bool on) {
  if (on == full_screen()) return;
  if (on) {
    glfw().GetWindowPos(handle(), &windowed_.x, &windowed_.y);
    glfw().GetWindowSize(handle(), &windowed_.z, &windowed_.w);
    GLFWmonitor* const monitor = monitor_of(windowed_);
    const GLFWvidmode* const mode = monitor ? glfw().GetVideoMode(monitor) : nullptr;
    if (mode) glfw().SetWindowMonitor(handle(), monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  } else {
    glfw().SetWindowMonitor(handle(), nullptr, windowed_.x, windowed_.y, windowed_.z, windowed_.w, 0);
  }
}

void Window::set_title(const std::string& title) {
  glfw().SetWindowTitle(handle(), title.c_str());
}

void Window::set_clipboard(const std::string& text) {
  glfw().SetClipboardString(handle(), text.c_str());
}

void Window::set_vsync(bool on) {
  glfw().SwapInterval(on ? 1 : 0);
}

void Window::present() {
  glfw().SwapBuffers(handle());
  if (context_lost()) throw ContextLostError("the GPU was reset and its OpenGL context is lost; start again");
}

}  // namespace pinocchio::gl
