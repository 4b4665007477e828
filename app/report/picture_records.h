#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include "pinocchio/frame.h"

namespace pinocchio::app {

// Ends the verb with kUsage where a run has more samples than `who` keeps records of, some 260 bytes each.
void check_records(std::size_t pictures, const Settings& settings, const std::string& who);

// Sums the records of a picture's samples, each a frame, into one record: counts and times add up, and the
// picture lasts from the first one's begin to the last one's end.
class PictureRecords {
 public:
  using Done = std::function<void(const FrameRecord&)>;

  // `frames`: of each picture, unless it is ended earlier.
  PictureRecords(int frames, Done done) : frames_(frames), done_(std::move(done)) {}

  void add(const FrameRecord& frame);
  // Ends the picture that has fewer frames; nothing where none has begun.
  void end();

 private:
  int frames_, added_ = 0;
  Done done_;
  FrameRecord picture_;
  std::size_t pictures_ = 0;
};

}  // namespace pinocchio::app
