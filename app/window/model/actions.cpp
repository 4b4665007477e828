#include "app/window/model/actions.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

constexpr float kScaleStep = 1.25f, kExposureStep = 0.5f;

using S = ViewSettings;

template <class T>
const Rule* set(T& setting, T value) {
  setting = value;
  return nullptr;
}

const Rule* toggle(bool& setting) {
  return set(setting, !setting);
}

const Rule* add_bounces(S& s, int more) {
  s.settings.depth = std::clamp(s.settings.depth + more, 0, kMostBounces);
  return nullptr;
}

// Steps of the scale hit whole size exactly.
const Rule* rescale(S& s, float by) {
  const float scale = s.scale * by;
  return set(s.scale, scale > 0.95f && scale < 1.05f ? 1.0f : scale);
}

const Rule* brighten(S& s, float stops) {
  return set(s.exposure_ev, s.exposure_ev + stops);
}

KeyBinding with_control(KeyBinding binding) {
  binding.with_control = true;
  return binding;
}

}  // namespace

const std::vector<KeyBinding>& key_bindings() {
  constexpr Change kBrighter = [](S& s) { return brighten(s, kExposureStep); };
  constexpr Change kDarker = [](S& s) { return brighten(s, -kExposureStep); };
  const auto change = [](Change c) { return c; };
  static const std::vector<KeyBinding> kBindings{
      {'F', "F", Action::frame_all, "show the whole scene, without the walls around it"},
      {gl::kKeyHome, "Home", Action::frame_all, "show the whole scene, without the walls around it"},
      {'R', "R", Action::reset_camera, "camera as at the start"},
      {gl::kKeyEnter, "Enter", Action::reset_camera, "camera as at the start"},
      {'M', "M", change([](S& s) { return next_preset("mode", s); }), "mode: hybrid, raytrace, raster"},
      {'G', "G", change([](S& s) { return next_preset("design", s); }), "design 1 or 2"},
      {'X', "X", change(next_exchange), "exchange: sync, pipelined, reproject"},
      {'L', "L", change([](S& s) { return next_preset("plan", s); }),
       "plan: send what is needed, or a fixed format"},
      {'O', "O", change([](S& s) { return toggle(s.shadows); }), "shadows"},
      {'I', "I", change([](S& s) { return toggle(s.reflections); }), "reflections"},
      {'.', ".", change([](S& s) { return add_bounces(s, 1); }), "one bounce more"},
      {',', ",", change([](S& s) { return add_bounces(s, -1); }), "one bounce less"},
      {'=', "+", kBrighter, "half a stop brighter"},
      {'+', "+", kBrighter, "half a stop brighter"},
      {gl::kKeyPlus, "+", kBrighter, "half a stop brighter"},
      {'-', "-", kDarker, "half a stop darker"},
      {gl::kKeyMinus, "-", kDarker, "half a stop darker"},
      {']', "]", change([](S& s) { return rescale(s, kScaleStep); }), "more pixels"},
      {'[', "[", change([](S& s) { return rescale(s, 1.0f / kScaleStep); }), "fewer pixels"},
      {'V', "V", Action::next_buffer, "show the next channel: ids, normals, depth ..."},
      {'B', "B", change([](S& s) { return set(s.split, next(s.split, 3)); }),
       "compare with the reference; difference; off"},
      {'Z', "Z", change([](S& s) { return toggle(s.wireframe); }), "edges of the visible triangles"},
      {'T', "T", Panel::scene, "panel: what the file holds; hide parts"},
      {'N', "N", change([](S& s) { return toggle(s.accumulate); }),
       "gather samples while the camera stands still"},
      {'Y', "Y", change([](S& s) { return toggle(s.vsync); }), "wait for the display (vsync)"},
      {gl::kKeyF12, "F12", Action::screenshot,
       "screenshot: the picture as PNG and EXR; with Shift, the panels too"},
      {'C', "C", Action::save_camera, "save the camera for --path"},
      {'P', "P", Action::print_command,
       "print the command that renders this; an edited scene is saved for it"},
      {'H', "H", change([](S& s) { return toggle(s.overlay); }), "hide or show everything over the picture"},
      {gl::kKeyF1, "F1", Panel::help, "this list"},
      {gl::kKeyF2, "F2", Panel::figures, "panel: frame times"},
      {gl::kKeyF3, "F3", Panel::drawing, "panel: how the scene is drawn"},
      {gl::kKeyF4, "F4", Panel::settings, "panel: all settings"},
      {gl::kKeyF5, "F5", Panel::lights, "panel: lights"},
      {gl::kKeyF6, "F6", Panel::camera, "panel: camera"},
      {gl::kKeyF7, "F7", Panel::materials, "panel: materials"},
      {gl::kKeyF8, "F8", Panel::pixel, "panel: the pixel under the pointer"},
      {gl::kKeyF9, "F9", Panel::timeline, "panel: timeline"},
      {gl::kKeyF10, "F10", Panel::files, "panel: files"},
      {gl::kKeyF11, "F11", Action::full_screen, "full screen"},
      {gl::kKeyLeft, "Left", Action::previous_file, "previous scene of the folder"},
      {gl::kKeyRight, "Right", Action::next_file, "next scene of the folder"},
      {gl::kKeySpace, "Space", Action::play, "play or pause the scene's animation"},
      with_control({gl::kKeyLeft, "Ctrl + Left", Action::frame_back, "the animation's previous frame"}),
      with_control({gl::kKeyRight, "Ctrl + Right", Action::frame_on, "the animation's next frame"}),
      {'K', "K", Action::record, "record the pictures as PNG files, with Shift as EXR too; or stop"},
      with_control({'O', "Ctrl + O", Panel::files, "open a scene"}),
      with_control({'S', "Ctrl + S", Action::save_scene,
                    "save the scene as glTF; with Shift, choose folder and name"}),
      with_control({'Z', "Ctrl + Z", Action::undo, "undo"}),
      with_control({'Y', "Ctrl + Y", Action::redo, "redo"}),
      {gl::kKeyEscape, "Esc", Action::close, "close a popup or panel, leave full screen, quit"},
  };
  return kBindings;
}

const KeyBinding* binding_of(const gl::KeyEvent& event) {
  const std::vector<KeyBinding>& all = key_bindings();
  const auto found = std::find_if(all.begin(), all.end(), [&event](const KeyBinding& binding) {
    return binding.with_control == event.with.control &&
           (binding.key == event.character || binding.key == event.key);
  });
  return found == all.end() ? nullptr : &*found;
}

const std::vector<std::pair<const char*, const char*>>& mouse_bindings() {
  static const std::vector<std::pair<const char*, const char*>> kBindings{
      {"left drag", "orbit; look around while flying"},
      {"middle drag", "pan"},
      {"Shift + left drag", "pan"},
      {"wheel, right drag", "zoom"},
      {"double-click", "turn around this point"},
      {"Ctrl + wheel", "enlarge pixels"},
      {"Ctrl + click", "pick the material"},
      {"Ctrl + Shift + click", "expose for this point"},
      {"Ctrl + click", "type a number of a panel"},
      {"Tab", "type the next number"},
      {"W A S D", "fly, Shift faster"},
      {"E Q", "fly up, down"},
      {"1 to 9", "the file's cameras"},
      {"drop a file", "open it"},
  };
  return kBindings;
}

}  // namespace pinocchio::app
