#include "app/window/actions.h"

#include <algorithm>

namespace pinocchio::app {

const std::vector<KeyBinding>& key_bindings() {
  static const std::vector<KeyBinding> kBindings{
      {'F', "F", Action::frame_all, "whole scene in view"},
      {gl::kKeyHome, "Home", Action::frame_all, "whole scene in view"},
      {'R', "R", Action::reset_camera, "camera as at the start"},
      {gl::kKeyEnter, "Enter", Action::reset_camera, "camera as at the start"},
      {'M', "M", Action::next_mode, "mode: hybrid, raytrace, raster"},
      {'G', "G", Action::next_design, "design 1 or 2"},
      {'X', "X", Action::next_exchange, "exchange: sync, pipelined, reproject"},
      {'L', "L", Action::next_plan, "plan: auto or slides"},
      {'O', "O", Action::shadows, "shadows"},
      {'I', "I", Action::reflections, "reflections"},
      {'.', ".", Action::deeper, "one bounce more"},
      {',', ",", Action::shallower, "one bounce less"},
      {'=', "+", Action::brighter, "half a stop brighter"},
      {'+', "+", Action::brighter, "half a stop brighter"},
      {gl::kKeyPlus, "+", Action::brighter, "half a stop brighter"},
      {'-', "-", Action::darker, "half a stop darker"},
      {gl::kKeyMinus, "-", Action::darker, "half a stop darker"},
      {']', "]", Action::finer, "more pixels"},
      {'[', "[", Action::coarser, "fewer pixels"},
      {'V', "V", Action::next_buffer, "look at ids, normals, mask, reflection, age"},
      {'B', "B", Action::split, "beside the reference; its heat map; off"},
      {'N', "N", Action::accumulate, "a still camera gathers samples"},
      {'Y', "Y", Action::vsync, "wait for the display (vsync)"},
      {gl::kKeyF12, "F12", Action::screenshot, "screenshot: PNG of the window, EXR of the picture"},
      {'C', "C", Action::save_camera, "save the camera for --path"},
      {'P', "P", Action::print_command, "print the command that renders this"},
      {'H', "H", Action::overlay, "hide or show the overlay"},
      {gl::kKeyF1, "F1", Action::help, "keys"},
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
