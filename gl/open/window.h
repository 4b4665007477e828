#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <variant>
#include <vector>

#include "gl/open/glfw.h"

namespace pinocchio::gl {

// Keys that print nothing. Other keys are the upper-case character that a US keyboard prints.
enum Key : int {
  kKeySpace = 32,
  kKeyEscape = 256,
  kKeyEnter = 257,
  kKeyTab = 258,
  kKeyRight = 262,
  kKeyLeft = 263,
  kKeyHome = 268,
  kKeyF1 = 290,
  kKeyF2,
  kKeyF3,
  kKeyF4,
  kKeyF5,
  kKeyF6,
  kKeyF7,
  kKeyF8,
  kKeyF9,
  kKeyF10,
  kKeyF11 = 300,
  kKeyF12 = 301,
  kKeyLeftControl = 341,
  kKeyRightControl = 345,
  kKeyPlus = 334,   // of the number pad
  kKeyMinus = 333,  // of the number pad
};

struct Modifiers {
  bool shift = false, control = false, alt = false;
};

// Events of the window. Positions are in pixels of the framebuffer, from the top left.
struct KeyEvent {
  int key = 0;        // its place on the keyboard (Key)
  int character = 0;  // the character printed on it, upper case; `key` if there is none
  bool down = false;
  bool repeated = false;  // by holding the key
  Modifiers with;
};
struct ButtonEvent {
  int button = 0;  // 0 left, 1 right, 2 middle
  bool down = false;
  Modifiers with;
};
struct PointerEvent {
  glm::vec2 position{0.0f};
};
struct ScrollEvent {
  float steps = 0.0f;  // positive: away from the person
};
struct DropEvent {
  std::vector<std::filesystem::path> files;
};
struct TextEvent {
  unsigned character = 0;  // Unicode, as typed
};
// The window must be redrawn: its contents are lost, or its size or focus changed.
struct ExposeEvent {};
using WindowEvent =
    std::variant<KeyEvent, ButtonEvent, PointerEvent, ScrollEvent, DropEvent, TextEvent, ExposeEvent>;

// A window on the display with its OpenGL context, current on the thread that opened it: the main one.
class Window {
 public:
  // Throws NoContextError where there is no display, or its OpenGL has less than we need.
  Window(const std::string& title, glm::ivec2 size, bool debug);

  [[nodiscard]] Context& context() { return context_; }
  // For libraries that draw into the window themselves (Dear ImGui).
  [[nodiscard]] GLFWwindow* handle() const { return context_.window(); }

  // The events since the last call, in order. Waits up to `timeout_s` for an event.
  [[nodiscard]] std::vector<WindowEvent> take_events(double timeout_s = 0.0);
  // `key` is a place on the keyboard.
  [[nodiscard]] bool is_down(int key) const;

  [[nodiscard]] bool close_asked() const;
  void ask_close();
  void stay_open();                         // takes the request to close back
  [[nodiscard]] glm::ivec2 pixels() const;  // the framebuffer's size; 0 where the window is minimised
  [[nodiscard]] bool minimised() const;
  // The scale of text and lines: 1 on a usual display, 2 on a high-DPI one.
  [[nodiscard]] float content_scale() const;
  [[nodiscard]] bool full_screen() const;
  void set_full_screen(bool on);
  void set_title(const std::string& title);
  void set_vsync(bool on);
  void set_clipboard(const std::string& text);

  // Shows what was drawn. With vsync, waits for the display. Throws ContextLostError.
  void present();

 private:
  void listen();

  GlfwContext context_;
  std::vector<WindowEvent> events_;
  glm::ivec4 windowed_{0};  // position and size before full screen
};

}  // namespace pinocchio::gl
