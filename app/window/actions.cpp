#include "app/window/actions.h"

#include <algorithm>

namespace pinocchio::app {
namespace {

constexpr float kScaleStep = 1.25f, kExposureStep = 0.5f;

using S = ViewSettings;

template <class T>
const Rule* put(T& setting, T value) {
  setting = value;
  return nullptr;
}

const Rule* toggle(bool& setting) {
  return put(setting, !setting);
}

const Rule* add_bounces(S& s, int more) {
  s.settings.depth = std::clamp(s.settings.depth + more, 0, kMostBounces);
  return nullptr;
}

// Steps of the scale meet whole size exactly.
const Rule* rescale(S& s, float by) {
  const float scale = s.scale * by;
  return put(s.scale, scale > 0.95f && scale < 1.05f ? 1.0f : scale);
}

const Rule* brighten(S& s, float stops) {
  return put(s.exposure_ev, s.exposure_ev + stops);
}

}  // namespace

const std::vector<KeyBinding>& key_bindings() {
  constexpr Change kBrighter = [](S& s) { return brighten(s, kExposureStep); };
  constexpr Change kDarker = [](S& s) { return brighten(s, -kExposureStep); };
  const auto change = [](Change c) { return c; };
  static const std::vector<KeyBinding> kBindings{
      {'F', "F", Action::frame_all, "whole scene in view"},
      {gl::kKeyHome, "Home", Action::frame_all, "whole scene in view"},
      {'R', "R", Action::reset_camera, "camera as at the start"},
      {gl::kKeyEnter, "Enter", Action::reset_camera, "camera as at the start"},
      {'M', "M", change([](S& s) { return next_preset("mode", s); }), "mode: hybrid, raytrace, raster"},
      {'G', "G", change([](S& s) { return next_preset("design", s); }), "design 1 or 2"},
      {'X', "X", change(next_exchange), "exchange: sync, pipelined, reproject"},
      {'L', "L", change([](S& s) { return next_preset("plan", s); }), "plan: auto or slides"},
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
      {'V', "V", Action::next_buffer, "look at ids, normals, mask, reflection, age"},
      {'B', "B", change([](S& s) { return put(s.split, next(s.split, 3)); }),
       "beside the reference; its heat map; off"},
      {'N', "N", change([](S& s) { return toggle(s.accumulate); }), "a still camera gathers samples"},
      {'Y', "Y", change([](S& s) { return toggle(s.vsync); }), "wait for the display (vsync)"},
      {gl::kKeyF12, "F12", Action::screenshot, "screenshot: PNG of the window, EXR of the picture"},
      {'C', "C", Action::save_camera, "save the camera for --path"},
      {'P', "P", Action::print_command, "print the command that renders this"},
      {'H', "H", change([](S& s) { return toggle(s.overlay); }), "hide or show the overlay"},
      {gl::kKeyF1, "F1", change([](S& s) { return toggle(s.help); }), "keys"},
      {gl::kKeyF11, "F11", Action::full_screen, "full screen"},
      {gl::kKeyEscape, "Esc", Action::close, "close"},
  };
  return kBindings;
}

const KeyBinding* binding_of(const gl::KeyEvent& event) {
  const std::vector<KeyBinding>& all = key_bindings();
  const auto found = std::find_if(all.begin(), all.end(), [&event](const KeyBinding& binding) {
    return binding.key == event.character || binding.key == event.key;
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace pinocchio::app
