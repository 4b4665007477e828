#include "app/report/picture_records.h"

#include <algorithm>

#include "app/cli/errors.h"
#include "pinocchio/conversion.h"

namespace pinocchio::app {
namespace {

void add_time(Span& to, const Span& more) {
  if (to.end_s <= to.begin_s)
    to = more;
  else
    to.end_s += std::max(more.end_s - more.begin_s, 0.0);
}

}  // namespace

void check_records(std::size_t pictures, const Settings& settings, const std::string& who) {
  constexpr std::size_t kMost = 100'000;
  const std::size_t frames = pictures * as_size(settings.spp.value);
  if (frames > kMost)
    throw Exit(kUsage, std::to_string(frames) + " frames are more than " + who + " keeps figures of (" +
                           std::to_string(kMost) + "); give fewer --frames or a lower --spp");
}

void PictureRecords::add(const FrameRecord& frame) {
  if (added_++ == 0) {
    picture_ = frame;
    picture_.number = pictures_;
  } else {
    for (std::size_t i = 0; i < frame.stages.size(); ++i) {
      add_time(picture_.stages[i], frame.stages[i]);
      if (!picture_.processors[i]) picture_.processors[i] = frame.processors[i];
    }
    picture_.frame.end_s = frame.frame.end_s;
    picture_.latency_frames = std::max(picture_.latency_frames, frame.latency_frames);
    picture_.age_frames = std::max(picture_.age_frames, frame.age_frames);
    for (std::size_t i = 0; i < frame.bytes.size(); ++i) picture_.bytes[i] += frame.bytes[i];
    picture_.rays += frame.rays;
  }
  if (added_ == frames_) end();
}

void PictureRecords::end() {
  if (added_ == 0) return;
  added_ = 0;
  ++pictures_;
  done_(picture_);
}

}  // namespace pinocchio::app
