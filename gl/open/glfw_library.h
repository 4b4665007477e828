// GLFW's functions, found at run time: what never opens a window needs neither GLFW nor X11.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace pinocchio::gl {

#define PINOCCHIO_GLFW_FUNCTIONS(X) \
  X(CreateWindow)                   \
  X(DefaultWindowHints)             \
  X(DestroyWindow)                  \
  X(GetCurrentContext)              \
  X(GetError)                       \
  X(GetFramebufferSize)             \
  X(GetKey)                         \
  X(GetKeyName)                     \
  X(GetMonitorWorkarea)             \
  X(GetMonitors)                    \
  X(GetPrimaryMonitor)              \
  X(GetProcAddress)                 \
  X(GetTimerFrequency)              \
  X(GetVideoMode)                   \
  X(GetWindowAttrib)                \
  X(GetWindowContentScale)          \
  X(GetWindowMonitor)               \
  X(GetWindowPos)                   \
  X(GetWindowSize)                  \
  X(GetWindowUserPointer)           \
  X(Init)                           \
  X(MakeContextCurrent)             \
  X(PollEvents)                     \
  X(SetCharCallback)                \
  X(SetClipboardString)             \
  X(SetCursorPosCallback)           \
  X(SetDropCallback)                \
  X(SetFramebufferSizeCallback)     \
  X(SetKeyCallback)                 \
  X(SetMouseButtonCallback)         \
  X(SetScrollCallback)              \
  X(SetWindowFocusCallback)         \
  X(SetWindowMonitor)               \
  X(SetWindowRefreshCallback)       \
  X(SetWindowShouldClose)           \
  X(SetWindowSizeLimits)            \
  X(SetWindowTitle)                 \
  X(SetWindowUserPointer)           \
  X(SwapBuffers)                    \
  X(SwapInterval)                   \
  X(Terminate)                      \
  X(WaitEventsTimeout)              \
  X(WindowHint)                     \
  X(WindowShouldClose)

struct GlfwFunctions {
#define PINOCCHIO_MEMBER(name) decltype(&::glfw##name) name = nullptr;
  PINOCCHIO_GLFW_FUNCTIONS(PINOCCHIO_MEMBER)
#undef PINOCCHIO_MEMBER
};

// The library is never unloaded. Throws Error where it is missing.
[[nodiscard]] const GlfwFunctions& glfw();

}  // namespace pinocchio::gl
