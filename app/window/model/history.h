#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// The records of the last frames, newest last. Pauses in drawing are cut out.
class History {
 public:
  static constexpr std::size_t kMost = 240;

  // Ignores a picture that was only shown again.
  void add(FrameRecord record);
  // Nothing is drawn until the next frame begins.
  void pause() { paused_ = true; }
  void clear();

  [[nodiscard]] bool empty() const { return records_.empty(); }
  [[nodiscard]] const std::deque<FrameRecord>& records() const { return records_; }

  // Frames a second, over the last second of drawing. 0: not known yet.
  [[nodiscard]] double rate() const;
  // From one frame's end to the next one's, without pauses, ms.
  [[nodiscard]] std::vector<float> frame_ms() const;
  [[nodiscard]] std::vector<float> latency_ms() const;
  [[nodiscard]] std::vector<float> stage_ms(Stage stage) const;

 private:
  std::deque<FrameRecord> records_;  // times are without pauses
  std::deque<bool> after_pause_;
  bool paused_ = false;
  double cut_s_ = 0.0;  // length of all pauses
};

inline constexpr std::size_t kMedianOf = 20;  // frames for the median of a shown figure
// The median of the newest `count` values. 0: there are none.
[[nodiscard]] float median_of_newest(const std::vector<float>& values, std::size_t count);

}  // namespace pinocchio::app
