#pragma once

#include <cstddef>
#include <vector>

#include "hybrid/settings/quality_ladder.h"

namespace pinocchio {

// Keeps frames within a time limit: takes the next cheaper plan of a front where frames take too long, and
// the next better one where there is time left. It compares medians, waits after every change, and doubles
// the wait after a better plan that was too slow, so it does not oscillate.
class QualityController {
 public:
  // front: slowest first, not empty. Plans beyond budget.error are not used, except the first.
  QualityController(std::vector<MeasuredSettings> front, const Budget& budget);

  [[nodiscard]] const MeasuredSettings& now() const { return front_[at_]; }
  // Adds the time of a frame that was drawn by now(). True where now() changed.
  bool note(double frame_ms);

 private:
  bool change_to(std::size_t at);

  std::vector<MeasuredSettings> front_;
  double limit_ms_;  // infinite: none
  std::size_t at_ = 0;
  std::vector<double> times_ms_;  // since the last change
  int frames_ = 0;                // since the last change
  int patience_;                  // frames before a better plan is tried
  bool climbed_ = false;          // the last change was to a better plan
};

}  // namespace pinocchio
