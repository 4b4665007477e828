#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "app/window/model/settings.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {

// ImGui's widgets in this window's form: the name at the left, the control in the middle, the value with its
// unit at the right, and a tooltip for each.

// For windows that are not panels: they cannot be moved.
inline constexpr ImGuiWindowFlags kBare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
inline const ImVec4 kAccent{0.98f, 0.68f, 0.30f, 1.0f};

// Shown while the pointer is on the last item.
void tooltip(const std::string& text);
// The rule that the choice would break, else its help.
void tooltip(const Choice& choice);

// A name in the left column. The next control fills the rest of the line.
void label(const char* name, const std::string& help);
// `value` at the right edge of the line of `name`.
void row(const char* name, const std::string& value, const std::string& help);
void paragraph(const std::string& text);

// A row of buttons of which one is chosen. Returns the one that is clicked, or -1.
[[nodiscard]] int choose(const char* name, const std::string& help, const std::vector<Choice>& choices,
                         std::size_t chosen);
// The same for an enumeration whose values have the choices' order.
template <class Enum>
void choose_value(const char* name, const std::string& help, const std::vector<Choice>& choices,
                  Enum& value) {
  const int clicked = choose(name, help, choices, as_size(value));
  if (clicked >= 0) value = static_cast<Enum>(clicked);
}
// shown: the value with its unit, beside the slider.
bool slider(const char* name, float& value, float lo, float hi, const std::string& shown,
            const std::string& help);
bool slider(const char* name, int& value, int lo, int hi, const std::string& shown, const std::string& help);
bool checkbox(const char* name, bool& value, const std::string& help);
bool button(const char* name, const std::string& help, bool chosen = false);
// A colour in linear light, edited as displays and other programs give it (sRGB).
bool edit_color(const char* name, glm::vec3& color, const std::string& help);
// The window that is being described stays in front of panels, as long as no list or menu is open.
void keep_in_front();
// A line of a list. True: it is clicked.
[[nodiscard]] bool list_item(const char* name, bool chosen = false);

// printf into a string, up to 511 characters.
[[nodiscard]] std::string format(const char* pattern, ...) __attribute__((format(printf, 1, 2)));

}  // namespace pinocchio::app
