#include "app/window/overlay/gui.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <imgui_internal.h>  // ClosePopupToLevel, ClearActiveID

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

namespace pinocchio::app {
namespace {

constexpr float kFontPixels = 14.0f;  // on a usual display

// Sans serif fonts with figures of one width, where distributions install them.
constexpr std::array<const char*, 4> kFonts{
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf", "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"};

void load_font(float pixels) {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  std::error_code ignored;
  for (const char* file : kFonts)
    if (std::filesystem::is_regular_file(file, ignored) && atlas.AddFontFromFileTTF(file, pixels)) return;
  ImFontConfig config;
  config.SizePixels = pixels;
  atlas.AddFontDefault(&config);
}

void set_colors(ImGuiStyle& style) {
  ImGui::StyleColorsDark(&style);
  const auto set = [&style](int which, float r, float g, float b, float a) {
    style.Colors[which] = ImVec4(r, g, b, a);
  };
  set(ImGuiCol_WindowBg, 0.06f, 0.07f, 0.09f, 1.0f);  // panels may lie above each other
  set(ImGuiCol_PopupBg, 0.08f, 0.09f, 0.11f, 0.98f);
  set(ImGuiCol_Border, 1.0f, 1.0f, 1.0f, 0.08f);
  set(ImGuiCol_FrameBg, 1.0f, 1.0f, 1.0f, 0.07f);
  set(ImGuiCol_FrameBgHovered, 1.0f, 1.0f, 1.0f, 0.13f);
  set(ImGuiCol_FrameBgActive, 1.0f, 1.0f, 1.0f, 0.18f);
  set(ImGuiCol_TitleBg, 0.06f, 0.07f, 0.09f, 0.95f);
  set(ImGuiCol_TitleBgActive, 0.06f, 0.07f, 0.09f, 0.95f);
  set(ImGuiCol_TitleBgCollapsed, 0.06f, 0.07f, 0.09f, 0.94f);
  set(ImGuiCol_Header, 1.0f, 1.0f, 1.0f, 0.10f);
  set(ImGuiCol_HeaderHovered, 1.0f, 1.0f, 1.0f, 0.22f);
  set(ImGuiCol_HeaderActive, 1.0f, 1.0f, 1.0f, 0.30f);
  set(ImGuiCol_Button, 1.0f, 1.0f, 1.0f, 0.10f);
  set(ImGuiCol_ButtonHovered, 1.0f, 1.0f, 1.0f, 0.26f);
  set(ImGuiCol_ButtonActive, 1.0f, 1.0f, 1.0f, 0.40f);
  set(ImGuiCol_CheckMark, 0.98f, 0.68f, 0.30f, 1.0f);
  set(ImGuiCol_SliderGrab, 0.95f, 0.62f, 0.25f, 0.75f);
  set(ImGuiCol_SliderGrabActive, 0.98f, 0.68f, 0.30f, 1.0f);
  set(ImGuiCol_PlotHistogram, 0.62f, 0.36f, 0.08f, 1.0f);  // a bar of progress, below white letters
  set(ImGuiCol_TextSelectedBg, 0.62f, 0.36f, 0.08f, 1.0f);
  set(ImGuiCol_PlotLines, 0.98f, 0.72f, 0.38f, 1.0f);
  set(ImGuiCol_Separator, 1.0f, 1.0f, 1.0f, 0.12f);
}

void set_style(float scale) {
  ImGuiStyle& style = ImGui::GetStyle();
  style = ImGuiStyle();
  set_colors(style);
  style.WindowRounding = 6.0f;
  style.FrameRounding = 3.0f;
  style.GrabRounding = 3.0f;
  style.WindowPadding = ImVec2(10.0f, 8.0f);
  style.FramePadding = ImVec2(6.0f, 2.0f);
  style.ItemSpacing = ImVec2(7.0f, 4.0f);
  style.WindowTitleAlign = ImVec2(0.0f, 0.5f);
  style.ScrollbarSize = 10.0f;
  style.ScaleAllSizes(scale);
}

}  // namespace

Gui::Gui(const gl::Window& window, std::function<void()> describe)
    : window_(window), describe_(std::move(describe)) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // the session saves the layout
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), false);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::set_scale(float scale) {
  const bool first = scale_ == 0.0f;
  scale_ = scale;
  set_style(scale);
  load_font(std::round(kFontPixels * scale));
  if (first) return;  // the backend creates the texture with its other objects
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

void Gui::begin_frame() {
  // The window may be on another monitor now.
  if (const float scale = window_.content_scale(); scale != scale_) set_scale(scale);
  ImGuiIO& io = ImGui::GetIO();
  std::array<bool, 5> down{};
  std::copy_n(io.MouseDown, down.size(), down.begin());
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  // The backend uses the pointer's present position; events have the one when they happened.
  std::copy_n(down.begin(), down.size(), io.MouseDown);
  const ImVec2 pixels = io.DisplayFramebufferScale;
  io.MousePos = ImVec2(pointer_.x / std::max(pixels.x, 1e-3f), pointer_.y / std::max(pixels.y, 1e-3f));
  io.DeltaTime = std::max(io.DeltaTime, 1e-6f);
  ImGui::NewFrame();
  stale_ = false;
}

// Brings the layout up to date with all events.
void Gui::update() {
  begin_frame();
  describe_();
  ImGui::EndFrame();
}

void Gui::draw() {
  begin_frame();
  describe_();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::over_panel() {
  if (stale_) update();
  return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::handle(const gl::WindowEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  if (const auto* pointer = std::get_if<gl::PointerEvent>(&event)) {
    pointer_ = pointer->position;
    stale_ = true;
    return false;  // a drag of the picture continues over panels
  }
  if (const auto* button = std::get_if<gl::ButtonEvent>(&event)) {
    const bool ours = over_panel();
    if (button->button < 0 || button->button >= 5) return ours;
    io.MouseDown[button->button] = button->down;
    update();  // so that a release that follows at once is not lost
    return ours && button->down;
  }
  if (const auto* scroll = std::get_if<gl::ScrollEvent>(&event)) {
    if (!over_panel()) return false;
    io.MouseWheel += scroll->steps;
    update();
    return true;
  }
  if (const auto* key = std::get_if<gl::KeyEvent>(&event)) {
    const bool ours = wants_text() && key->key != gl::kKeyEscape;
    if (key->key >= 0)
      ImGui_ImplGlfw_KeyCallback(window_.handle(), key->key, 0, key->down ? GLFW_PRESS : GLFW_RELEASE, 0);
    if (ours) update();
    stale_ = true;
    return ours && key->down;
  }
  if (const auto* text = std::get_if<gl::TextEvent>(&event)) {
    if (wants_text()) io.AddInputCharacter(text->character);
    return true;
  }
  stale_ = true;
  return false;
}

// ImGui's WantTextInput is a frame behind: a key that follows Return at once would be lost.
bool Gui::wants_text() const {
  const ImGuiContext& gui = *ImGui::GetCurrentContext();
  return gui.ActiveId != 0 && gui.ActiveId == gui.InputTextState.ID;
}

bool Gui::is_active() const {
  return ImGui::IsAnyItemActive();
}

bool Gui::close_popup() {
  if (wants_text()) {
    ImGui::ClearActiveID();
    return true;
  }
  if (!ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopup)) return false;
  ImGui::ClosePopupToLevel(ImGui::GetCurrentContext()->OpenPopupStack.Size - 1, true);
  return true;
}

std::optional<Panel> Gui::front_panel(const OpenPanels& panels) const {
  const ImVector<ImGuiWindow*>& by_use = ImGui::GetCurrentContext()->WindowsFocusOrder;
  std::optional<Panel> front;
  int front_at = -1;
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    const auto panel = static_cast<Panel>(i);
    const ImGuiWindow* const window = panels[panel] ? ImGui::FindWindowByName(kPanels[i].title) : nullptr;
    const int at = window ? by_use.index_from_ptr(by_use.find(const_cast<ImGuiWindow*>(window))) : -1;
    if (!panels[panel] || (front && at <= front_at)) continue;
    front = panel;
    front_at = at;
  }
  return front;
}

std::string Gui::layout() const {
  return ImGui::SaveIniSettingsToMemory();
}

void Gui::set_layout(const std::string& text) {
  ImGui::LoadIniSettingsFromMemory(text.data(), text.size());
}

}  // namespace pinocchio::app
