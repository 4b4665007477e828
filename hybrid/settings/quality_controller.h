#pragma once

#include <cstddef>
#include <vector>

#include "hybrid/settings/quality_ladder.h"

namespace pinocchio {

// Keeps frames within a time: goes to the next cheaper plan of a front where frames take too long, and back
// where there is room. It looks at medians, waits after every change, and after a way back that did not
// last it waits twice as long before it tries again: so it settles, and never oscillates.
class QualityController {
 public:
  // front: slowest first, not empty; of it the plans within budget.error are used (the first, where none is).
  QualityController(std::vector<MeasuredSettings> front, const Budget& budget);

  [[nodiscard]] const MeasuredSettings& now() const { return front_[at_]; }
  // Notes how long a frame took that was drawn by now(). True where now() is another plan afterwards.
  bool note(double frame_ms);

 private:
  bool change_to(std::size_t at);

  std::vector<MeasuredSettings> front_;
  double limit_ms_;  // infinite: none
  std::size_t at_ = 0;
  std::vector<double> times_ms_;  // since the last change
  int frames_ = 0;                // since the last change
  int patience_;                  // frames before a way back is tried
  bool climbed_ = false;          // the last change was a way back
};

}  // namespace pinocchio
