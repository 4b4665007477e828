#include "app/window/leave.h"

#include <optional>

namespace pinocchio::app {

bool Leave::is_closed() {
  if (!window_.close_asked()) return false;
  if (!model_.unsaved) return true;
  window_.stay_open();
  request({});
  return false;
}

void Leave::request(const Leaving& to) {
  if (!model_.unsaved) return leave_now(to);
  model_.leaving = to;
}

void Leave::leave_now(const Leaving& to) {
  agreed_ = model_.edits;
  if (to.loaded) return;
  if (to.reload) return source_.reload();
  if (to.up_axis) return source_.turn_up(*to.up_axis);
  if (to.variant) return source_.choose_variant(*to.variant);
  if (to.file.empty()) {
    model_.unsaved = false;
    return window_.ask_close();
  }
  tried_ = to.file;
  source_.open(to.file);
}

void Leave::answer(Action action) {
  const std::optional<Leaving> to = std::exchange(model_.leaving, std::nullopt);
  if (!to || action == Action::stay) return;
  if (action == Action::save_and_leave) save_();
  leave_now(*to);
}

void Leave::open_neighbour(int by) {
  std::error_code unknown;
  const bool from_tried = std::filesystem::is_regular_file(tried_, unknown);
  const std::string file = neighbour_of(from_tried ? tried_ : model_.scene.source, by);
  if (file.empty()) return model_.messages.hint("there is no other scene in the folder");
  request({.file = file});
}

}  // namespace pinocchio::app
