#include "app/window/scene/edit_history.h"

#include <utility>

namespace pinocchio::app {
namespace {

constexpr double kOneStep_s = 0.4;

}  // namespace

void EditHistory::begin(const EditState& state) {
  now_ = state;
  before_.clear();
  after_.clear();
}

void EditHistory::note(const EditState& state, double now_s) {
  if (!now_) return begin(state);
  if (*now_ == state) return;
  if (now_s - changed_s_ > kOneStep_s || before_.empty()) {
    before_.push_back(std::move(*now_));
    if (before_.size() > kMost) before_.erase(before_.begin());
  }
  changed_s_ = now_s;
  now_ = state;
  after_.clear();
}

std::optional<EditState> EditHistory::step(std::vector<EditState>& from, std::vector<EditState>& to) {
  if (from.empty() || !now_) return std::nullopt;
  to.push_back(std::exchange(*now_, std::move(from.back())));
  from.pop_back();
  changed_s_ = -1e9;  // the next change is a step of its own
  return now_;
}

std::optional<EditState> EditHistory::undo() {
  return step(before_, after_);
}

std::optional<EditState> EditHistory::redo() {
  return step(after_, before_);
}

}  // namespace pinocchio::app
