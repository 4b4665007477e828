#include "bench/chart/timed_renderer.h"

#include <algorithm>
#include <cassert>

#include "core/base/clock.h"
#include "core/math/median.h"
#include "hybrid/frame/samples.h"

namespace pinocchio::chart {

// Points of a chart do not depend on frames that other points have drawn.
TimedRenderer::TimedRenderer(Engine& engine, FrameRequest request, Progress* progress)
    : request_(std::move(request)),
      renderer_(engine, {{}, [this](const FrameRecord& record) { records_.push_back(record); }}, progress) {
  request_.settings.reuse = false;
}

TimedRenderer::Round TimedRenderer::draw(const std::vector<View>& views) {
  assert(views.size() > kWarmUpFrames + 1);
  records_.clear();
  const double begin_cpu_s = processor_s();
  for (const View& view : views) {
    request_.view = view;
    submit_samples(renderer_, request_);
  }
  renderer_.drain();
  Round round;
  round.cpu_ms = 1e3 * (processor_s() - begin_cpu_s) / static_cast<double>(views.size());

  const auto samples = static_cast<std::size_t>(request_.settings.spp);
  const auto first_sample = [&](std::size_t frame) -> const FrameRecord& {
    return records_[frame * samples];
  };
  const std::size_t first = kWarmUpFrames, last = views.size() - 1;
  round.frame_ms = 1e3 * (first_sample(last).frame.begin_s - first_sample(first).frame.begin_s) /
                   static_cast<double>(last - first);
  round.least_ms = round.frame_ms;
  for (std::size_t frame = first; frame + kFramesInFlight <= last; ++frame)
    round.least_ms = std::min(
        round.least_ms,
        1e3 * (first_sample(frame + kFramesInFlight).frame.begin_s - first_sample(frame).frame.begin_s) /
            kFramesInFlight);
  std::vector<double> latencies_ms;
  for (std::size_t frame = first; frame < last; ++frame)
    latencies_ms.push_back(
        1e3 * (records_[(frame + 1) * samples - 1].frame.end_s - first_sample(frame).frame.begin_s));
  round.latency_ms = median(std::move(latencies_ms));
  // Not the last frame: a reprojected frame's mask and reflection are transferred after it was shown.
  const std::size_t usual = (first + last) / 2;
  round.latency_frames = first_sample(usual).latency_frames;
  round.age_frames = first_sample(usual).age_frames;
  for (std::size_t k = 0; k < samples; ++k) {
    round.bytes_to_cpu += static_cast<double>(records_[usual * samples + k].bytes_to_cpu());
    round.bytes_to_gpu += static_cast<double>(records_[usual * samples + k].bytes_to_gpu());
  }
  return round;
}

}  // namespace pinocchio::chart
