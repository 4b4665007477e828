#include "hybrid/settings/quality_controller.h"

#include <algorithm>
#include <limits>

#include "core/math/median.h"

namespace pinocchio {
namespace {

constexpr int kSettling = 3;        // frames of the old plan that are delivered after a change
constexpr std::size_t kWindow = 9;  // frames of a median
constexpr int kFirstPatience = 30, kMostPatience = 10'000;  // frames
constexpr double kRoom = 0.85;  // most of the limit that a better plan may be expected to take

}  // namespace

QualityController::QualityController(std::vector<MeasuredSettings> front, const Budget& budget)
    : front_(std::move(front)),
      limit_ms_(budget.frame_ms.value_or(std::numeric_limits<double>::infinity())),
      patience_(kFirstPatience) {
  if (budget.error)
    while (front_.size() > 1 && front_.back().error > *budget.error) front_.pop_back();
  at_ = choose(front_, budget);
}

bool QualityController::note(double frame_ms) {
  if (++frames_ <= kSettling) return false;
  if (times_ms_.size() == kWindow) times_ms_.erase(times_ms_.begin());
  times_ms_.push_back(frame_ms);
  if (times_ms_.size() < kWindow) return false;
  const double ms = median(times_ms_);
  if (ms > limit_ms_) {
    if (at_ + 1 == front_.size()) return false;
    if (climbed_) patience_ = std::min(2 * patience_, kMostPatience);
    climbed_ = false;
    return change_to(at_ + 1);
  }
  if (at_ == 0 || limit_ms_ == std::numeric_limits<double>::infinity() || frames_ < patience_) return false;
  const double expected_ms = ms * front_[at_ - 1].frame_ms / std::max(front_[at_].frame_ms, 1e-6);
  if (expected_ms > kRoom * limit_ms_) return false;
  climbed_ = true;
  return change_to(at_ - 1);
}

bool QualityController::change_to(std::size_t at) {
  at_ = at;
  frames_ = 0;
  times_ms_.clear();
  return true;
}

}  // namespace pinocchio
