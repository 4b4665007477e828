#include "app/window/history.h"

#include <algorithm>
#include <utility>

#include "core/math/median.h"

namespace pinocchio::app {

void History::add(const FrameRecord& record) {
  if (record[Stage::composite].end_s <= 0.0) return;
  records_.push_back(record);
  if (records_.size() > kMost) records_.pop_front();
}

std::vector<float> History::frame_ms() const {
  std::vector<float> values;
  for (std::size_t i = 1; i < records_.size(); ++i)
    if (records_[i].number == records_[i - 1].number + 1)
      values.push_back(static_cast<float>(1e3 * (records_[i].frame.end_s - records_[i - 1].frame.end_s)));
  return values;
}

std::vector<float> History::latency_ms() const {
  std::vector<float> values;
  for (const FrameRecord& record : records_) values.push_back(static_cast<float>(record.frame.ms()));
  return values;
}

std::vector<float> History::stage_ms(Stage stage) const {
  std::vector<float> values;
  for (const FrameRecord& record : records_) values.push_back(static_cast<float>(record[stage].ms()));
  return values;
}

float median_of_newest(const std::vector<float>& values, std::size_t count) {
  std::vector<float> newest(values.end() - static_cast<std::ptrdiff_t>(std::min(count, values.size())),
                            values.end());
  return newest.empty() ? 0.0f : median(std::move(newest));
}

}  // namespace pinocchio::app
