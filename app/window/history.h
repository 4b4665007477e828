#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// What the last frames cost, newest last. Times in which nothing was drawn are cut out.
class History {
 public:
  static constexpr std::size_t kMost = 240;

  // Frames that were drawn: a picture that is shown once more is none.
  void add(FrameRecord record);
  // Nothing is drawn until the next frame begins.
  void pause() { paused_ = true; }
  void clear();

  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] const std::deque<FrameRecord>& records() const { return records_; }

  // Frames a second, over the last second that was drawn in; 0: not known yet.
  [[nodiscard]] double rate() const;
  // From one frame's end to the next one's where nothing lay between, ms.
  [[nodiscard]] std::vector<float> frame_ms() const;
  [[nodiscard]] std::vector<float> latency_ms() const;
  [[nodiscard]] std::vector<float> stage_ms(Stage stage) const;

 private:
  std::deque<FrameRecord> records_;  // as if pauses had not been
  std::deque<bool> after_pause_;
  bool paused_ = false;
  double cut_s_ = 0.0;  // of all pauses
};

// Of the newest `count` values; 0 where there are none.
[[nodiscard]] float median_of_newest(const std::vector<float>& values, std::size_t count);

}  // namespace pinocchio::app
