#include "hybrid/frame.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "gl/context.h"
#include "hybrid/formats.h"

namespace pinocchio {
namespace {

// The GPU's clock and the CPU's drift apart.
constexpr std::uint64_t kFramesBetweenCalibrations = 256;

Span span_of(const gl::GpuTimer& timer, const gl::GpuClock& clock) {
  const gl::GpuSpan measured = timer.span(clock);
  return {measured.begin_s, measured.end_s};
}

// Whether the older frame's mask and reflection mean the same in the newer one.
bool reprojects_to(const Flight& older, const Flight& newer) {
  return older.answered && older.request.scene == newer.request.scene &&
         older.request.plan.mask_bits == newer.request.plan.mask_bits &&
         older.request.plan.reflection == newer.request.plan.reflection &&
         older.request.plan.id_bits == newer.request.plan.id_bits;
}

}  // namespace

const char* exchange_name(Exchange exchange) {
  switch (exchange) {
    case Exchange::sync:
      return "sync";
    case Exchange::pipelined:
      return "pipelined";
    case Exchange::reproject:
      return "reproject";
  }
  return "";
}

FrameLoop::FrameLoop(Workers& workers, std::shared_ptr<Programs> programs, Exchange exchange,
                     gl::Mapping mapping, Sinks sinks)
    : passes_(std::move(programs)),
      design1_(workers, passes_),
      design2_(workers, passes_),
      exchange_(exchange),
      sinks_(std::move(sinks)) {
  for (int i = 0; i < kFramesInFlight; ++i) slots_.push_back(std::make_unique<Flight>(mapping));
}

// The order of a frame. Left to right is a frame's way, top to bottom what happens at one time (design 1,
// pipelined):
//
//   frame n    GPU  draw
//   frame n-1  CPU        fetch  trace
//   frame n-2  GPU                      upload  composite
void FrameLoop::submit(const FrameRequest& request) {
  if (repeat(request)) return;
  Flight& now = begin(request);
  design_of(now).draw(now);
  if (exchange_ == Exchange::reproject && request.plan.traces() && request.plan.design == 1 &&
      request.plan.primary == Primary::raster)
    return submit_reprojected(now);
  const int latency = latency_of(request.plan);
  if (latency > 0) {
    // The CPU traces one frame at a time, and is not idle while the GPU finishes another.
    Flight* const oldest = frames_back(kLatencyFrames);
    if (oldest && oldest->tracing.valid()) oldest->tracing.wait();
    if (Flight* const last = frames_back(1)) start_trace(*last);
  }
  for (int n = kLatencyFrames; n >= latency; --n)
    if (Flight* const due = frames_back(n)) finish(*due);
}

void FrameLoop::drain() {
  for (int n = kLatencyFrames; n >= 0; --n)
    if (Flight* const frame = frames_back(n)) finish(*frame);
  for (int n = kLatencyFrames; n >= 0; --n)
    if (Flight* const frame = frames_back(n)) retire(*frame);
}

void FrameLoop::set_exchange(Exchange exchange) {
  if (exchange == exchange_) return;
  drain();
  exchange_ = exchange;
}

const Design& FrameLoop::design_of(const Flight& frame) const {
  const Plan& plan = frame.request.plan;
  if (plan.mode == Mode::hybrid && plan.design == 2) return design2_;
  return design1_;
}

int FrameLoop::latency_of(const Plan& plan) const {
  if (exchange_ != Exchange::pipelined || !plan.traces()) return 0;
  return plan.design == 2 ? kLatencyFramesDesign2 : kLatencyFrames;
}

// The newest raster at once. While the CPU traces the frame before, this one is shown with the answer to
// the one before that; the first frame, and one that no answer fits, waits for its own.
void FrameLoop::submit_reprojected(Flight& now) {
  Flight *const last = frames_back(1), *const oldest = frames_back(kLatencyFrames);
  if (oldest) take_traced(*oldest);
  if (last && last->state == Flight::State::delivered) start_trace(*last);
  for (const Flight* const source : {last, oldest})
    if (source && reprojects_to(*source, now)) return deliver(now, source);
  if (last) take_traced(*last);
  finish(now);
}

bool FrameLoop::repeat(const FrameRequest& request) {
  Flight* const last = frames_back(0);
  if (!last || !request.plan.reuse || !(last->request == request)) return false;
  if (generation_ != passes_.programs->generation()) return false;
  if (last->state == Flight::State::delivered && !last->complete) start_trace(*last);
  drain();
  if (!last->complete) {  // shown with an older frame's answer: its own, now
    if (!last->answered) return false;
    design_of(*last).composite(*last, nullptr);
    last->complete = true;
    last->answer_of = last;
  }
  last->record = FrameRecord{};
  last->record.number = next_number_++;
  last->record.frame.begin_s = now_s();
  sinks_.picture(*last);
  last->record.frame.end_s = now_s();
  sinks_.record(last->record);
  return true;
}

Flight& FrameLoop::begin(const FrameRequest& request) {
  if (gl::context_lost())
    throw EnvironmentError("the GPU was reset and its OpenGL context is lost; start again");
  Flight& frame = *slots_[drawn_++ % kFramesInFlight];
  retire(frame);
  if (drawn_ % kFramesBetweenCalibrations == 1) clock_.calibrate();
  generation_ = passes_.programs->generation();
  frame.request = request;
  frame.answered = frame.complete = false;
  frame.answer_of = nullptr;
  frame.record = FrameRecord{};
  frame.record.number = next_number_++;
  frame.record.frame.begin_s = now_s();
  frame.state = Flight::State::drawn;
  return frame;
}

Flight* FrameLoop::frames_back(int n) {
  const auto back = static_cast<std::uint64_t>(n) + 1;
  return drawn_ < back ? nullptr : slots_[(drawn_ - back) % kFramesInFlight].get();
}

void FrameLoop::start_trace(Flight& frame) {
  if (frame.state == Flight::State::idle || frame.tracing.valid() || frame.answered) return;
  if (!frame.request.plan.traces()) return;
  const Design& design = design_of(frame);
  design.fetch(frame);
  frame.record[Stage::readback].end_s = now_s();
  frame.tracing = std::async(std::launch::async, [&design, &frame] { design.trace(frame); });
}

// Waits for the CPU's part and sends it to the GPU. Throws what tracing threw; the frame is lost then.
void FrameLoop::take_traced(Flight& frame) {
  if (!frame.tracing.valid()) return;
  const Flight::State state = std::exchange(frame.state, Flight::State::idle);
  frame.tracing.get();
  design_of(frame).upload(frame);
  frame.answered = true;
  frame.state = state;
}

void FrameLoop::finish(Flight& frame) {
  if (frame.state != Flight::State::drawn) return;
  start_trace(frame);
  take_traced(frame);
  deliver(frame, nullptr);
}

void FrameLoop::deliver(Flight& frame, const Flight* older) {
  frame.state = Flight::State::idle;  // lost, should a line below throw
  design_of(frame).composite(frame, older);
  frame.answer_of = older ? older : frame.answered ? &frame : nullptr;
  frame.state = Flight::State::delivered;
  frame.complete = !older;
  frame.record.latency_frames = static_cast<int>(next_number_ - 1 - frame.record.number);
  if (older) frame.record.age_frames = static_cast<int>(frame.record.number - older->record.number);
  sinks_.picture(frame);
}

// The GPU is done with the frame long since, unless it was the last one.
void FrameLoop::retire(Flight& frame) {
  take_traced(frame);
  if (frame.state != Flight::State::delivered) return;
  FrameRecord& record = frame.record;
  Span& readback = record[Stage::readback];
  if (frame.request.plan.primary == Primary::rays) {
    readback = {};  // nothing was
  } else {
    record[Stage::raster] = span_of(frame.raster_timer, clock_);
    if (readback.end_s > 0.0) readback.begin_s = record[Stage::raster].end_s;
  }
  record[Stage::composite] = span_of(frame.composite_timer, clock_);
  record.frame.end_s = std::max(record[Stage::composite].end_s, record[Stage::present].end_s);
  frame.state = Flight::State::idle;
  sinks_.record(record);
}

void FrameLoop::read_picture(Flight& frame, Image<glm::vec4>& color) {
  const StageTimer timer(frame.record, Stage::present);
  fit(color, frame.picture.target.size());
  frame.picture.back.start(frame.picture.target);
  unpack_picture(frame.picture.back.open(), color);
  frame.picture.back.close();
}

void FrameLoop::read_ids(Flight& frame) {
  if (frame.answered) return;  // they came for the CPU
  frame.visibility.back.start(frame.visibility.target);
  fit(frame.ids, frame.visibility.target.size());
  unpack_ids(frame.visibility.back.open(), frame.request.plan.id_bits, frame.ids);
  frame.visibility.back.close();
}

}  // namespace pinocchio
