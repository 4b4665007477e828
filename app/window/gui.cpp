#include "app/window/gui.h"

#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include <array>
#include <cmath>
#include <filesystem>

namespace pinocchio::app {
namespace {

constexpr float kFontPixels = 14.0f;  // on a usual display

// Where distributions keep a sans serif whose figures are all of one width.
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
  set(ImGuiCol_WindowBg, 0.06f, 0.07f, 0.09f, 0.86f);
  set(ImGuiCol_PopupBg, 0.08f, 0.09f, 0.11f, 0.96f);
  set(ImGuiCol_Border, 1.0f, 1.0f, 1.0f, 0.08f);
  set(ImGuiCol_FrameBg, 1.0f, 1.0f, 1.0f, 0.07f);
  set(ImGuiCol_FrameBgHovered, 1.0f, 1.0f, 1.0f, 0.13f);
  set(ImGuiCol_FrameBgActive, 1.0f, 1.0f, 1.0f, 0.18f);
  set(ImGuiCol_TitleBg, 0.06f, 0.07f, 0.09f, 0.95f);
  set(ImGuiCol_TitleBgActive, 0.06f, 0.07f, 0.09f, 0.95f);
  set(ImGuiCol_TitleBgCollapsed, 0.06f, 0.07f, 0.09f, 0.75f);
  set(ImGuiCol_Header, 0.95f, 0.62f, 0.25f, 0.20f);
  set(ImGuiCol_HeaderHovered, 0.95f, 0.62f, 0.25f, 0.32f);
  set(ImGuiCol_HeaderActive, 0.95f, 0.62f, 0.25f, 0.42f);
  set(ImGuiCol_Button, 1.0f, 1.0f, 1.0f, 0.10f);
  set(ImGuiCol_ButtonHovered, 0.95f, 0.62f, 0.25f, 0.45f);
  set(ImGuiCol_ButtonActive, 0.95f, 0.62f, 0.25f, 0.65f);
  set(ImGuiCol_CheckMark, 0.98f, 0.68f, 0.30f, 1.0f);
  set(ImGuiCol_SliderGrab, 0.95f, 0.62f, 0.25f, 0.75f);
  set(ImGuiCol_SliderGrabActive, 0.98f, 0.68f, 0.30f, 1.0f);
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

Gui::Gui(const gl::Window& window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // leaves no file behind
  ImGui_ImplGlfw_InitForOpenGL(window.handle(), true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::set_scale(float scale) {
  scale_ = scale;
  set_style(scale);
  load_font(std::round(kFontPixels * scale));
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // made anew with the next frame
  ImGui_ImplOpenGL3_DestroyDeviceObjects();
}

void Gui::begin_frame() {
  // Another monitor may have another scale.
  if (const float scale = window_.content_scale(); scale != scale_) set_scale(scale);
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Gui::end_frame() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Gui::wants_pointer() const {
  return ImGui::GetIO().WantCaptureMouse;
}
bool Gui::wants_text() const {
  return ImGui::GetIO().WantTextInput;
}

}  // namespace pinocchio::app
