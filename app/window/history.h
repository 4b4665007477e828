#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// What the last frames cost, newest last.
class History {
 public:
  static constexpr std::size_t kMost = 240;

  // Frames that were drawn: a picture that is shown once more is none.
  void add(const FrameRecord& record);
  void clear() { records_.clear(); }

  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] const std::deque<FrameRecord>& records() const { return records_; }

  // From one frame's end to the next one's where both were drawn, ms.
  [[nodiscard]] std::vector<float> frame_ms() const;
  [[nodiscard]] std::vector<float> latency_ms() const;
  [[nodiscard]] std::vector<float> stage_ms(Stage stage) const;

 private:
  std::deque<FrameRecord> records_;
};

// Of the newest `count` values; 0 where there are none.
[[nodiscard]] float median_of_newest(const std::vector<float>& values, std::size_t count);

}  // namespace pinocchio::app
