#include "hybrid/frame.h"

namespace pinocchio {

const char* exchange_name(Exchange exchange) {
  return exchange == Exchange::sync ? "sync" : "pipelined";
}

FrameLoop::FrameLoop(Workers& workers, const std::filesystem::path& shaders, Exchange exchange,
                     gl::Mapping mapping, Sinks sinks)
    : steps_(workers, shaders), exchange_(exchange), sinks_(std::move(sinks)) {
  for (int i = 0; i < kFramesInFlight; ++i) slots_.push_back(std::make_unique<Flight>(mapping));
}

// The order of a frame. Left to right is a frame's way, top to bottom what happens at one time:
//
//   frame n    GPU  draw_visibility
//   frame n-1  CPU                  fetch_ids  trace
//   frame n-2  GPU                                   upload  composite
void FrameLoop::submit(const FrameRequest& request) {
  Flight& now = begin(request);
  steps_.draw_visibility(now);
  if (exchange_ == Exchange::sync || !request.plan.traces()) {
    drain();
    return;
  }
  Flight* const last = frames_back(1);
  Flight* const oldest = frames_back(kLatencyFrames);
  if (oldest && oldest->tracing.valid()) oldest->tracing.wait();  // the CPU traces one frame at a time ...
  if (last) start_trace(*last);  // ... and is not idle while the GPU finishes one
  if (oldest) finish(*oldest);
}

void FrameLoop::drain() {
  for (int n = kLatencyFrames; n >= 0; --n)
    if (Flight* const frame = frames_back(n)) finish(*frame);
  for (int n = kLatencyFrames; n >= 0; --n)
    if (Flight* const frame = frames_back(n)) retire(*frame);
}

Flight& FrameLoop::begin(const FrameRequest& request) {
  Flight& frame = *slots_[next_number_ % kFramesInFlight];
  retire(frame);
  frame.request = request;
  frame.record = FrameRecord{};
  frame.record.number = next_number_++;
  frame.record.frame.begin_s = now_s();
  frame.state = Flight::State::drawn;
  return frame;
}

Flight* FrameLoop::frames_back(int n) {
  const auto back = static_cast<std::uint64_t>(n) + 1;
  return next_number_ < back ? nullptr : slots_[(next_number_ - back) % kFramesInFlight].get();
}

void FrameLoop::start_trace(Flight& frame) {
  if (frame.state != Flight::State::drawn || !frame.request.plan.traces()) return;
  steps_.fetch_ids(frame);
  frame.tracing = std::async(std::launch::async, [this, &frame] { steps_.trace(frame); });
  frame.state = Flight::State::tracing;
}

void FrameLoop::finish(Flight& frame) {
  start_trace(frame);
  if (frame.state != Flight::State::drawn && frame.state != Flight::State::tracing) return;
  frame.state = Flight::State::idle;  // lost, should a line below throw
  if (frame.tracing.valid()) {
    frame.tracing.get();
    steps_.upload(frame);
  }
  steps_.composite(frame);
  frame.state = Flight::State::finished;
  frame.record.latency_frames = static_cast<int>(next_number_ - 1 - frame.record.number);
  sinks_.picture(frame);
}

// The GPU is done with the frame long since, unless it was the last one.
void FrameLoop::retire(Flight& frame) {
  if (frame.state != Flight::State::finished) return;
  steps_.complete_record(frame);
  frame.state = Flight::State::idle;
  sinks_.record(frame.record);
}

}  // namespace pinocchio
