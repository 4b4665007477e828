#include "app/window/model/history.h"

#include <algorithm>
#include <utility>

#include "core/math/median.h"

namespace pinocchio::app {
namespace {

// Moves all times of the record.
void shift(FrameRecord& record, double by_s) {
  const auto move = [by_s](Span& span) {
    if (span.end_s > 0.0) span = {span.begin_s + by_s, span.end_s + by_s};
  };
  std::ranges::for_each(record.stages, move);
  move(record.frame);
}

}  // namespace

void History::add(FrameRecord record) {
  if (record[Stage::composite].end_s <= 0.0) return;
  const bool after_pause = std::exchange(paused_, false) && !records_.empty();
  if (after_pause) cut_s_ += std::max(record.frame.begin_s - cut_s_ - records_.back().frame.end_s, 0.0);
  shift(record, -cut_s_);
  records_.push_back(record);
  after_pause_.push_back(after_pause);
  if (records_.size() <= kMost) return;
  records_.pop_front();
  after_pause_.pop_front();
}

void History::clear() {
  records_.clear();
  after_pause_.clear();
  paused_ = false;
  cut_s_ = 0.0;
}

double History::rate() const {
  constexpr double kLongest_s = 1.0;
  const std::vector<float> times = frame_ms();
  double sum_s = 0.0;
  int frames = 0;
  for (auto ms = times.rbegin(); ms != times.rend() && sum_s < kLongest_s; ++ms, ++frames)
    sum_s += 1e-3 * *ms;
  return sum_s > 0.0 ? frames / sum_s : 0.0;
}

std::vector<float> History::frame_ms() const {
  std::vector<float> values;
  for (std::size_t i = 1; i < records_.size(); ++i)
    if (!after_pause_[i]) values.push_back(1e3 * (records_[i].frame.end_s - records_[i - 1].frame.end_s));
  return values;
}

std::vector<float> History::latency_ms() const {
  std::vector<float> values;
  for (const FrameRecord& record : records_) values.push_back(record.frame.ms());
  return values;
}

std::vector<float> History::stage_ms(Stage stage) const {
  std::vector<float> values;
  for (const FrameRecord& record : records_) values.push_back(record[stage].ms());
  return values;
}

float median_of_newest(const std::vector<float>& values, std::size_t count) {
  std::vector<float> newest(values.end() - std::min(count, values.size()), values.end());
  return newest.empty() ? 0.0f : median(std::move(newest));
}

}  // namespace pinocchio::app
