// The order of a frame's steps, from left to right; the rows happen at the same time (visibility and
// composite on the GPU, pipelined):
//
//   frame n    GPU  rasterise, send to CPU
//   frame n-1  CPU                          decode, trace
//   frame n-2  GPU                                       send to GPU, composite, deliver
#include "pinocchio/renderer.h"

#include <algorithm>
#include <utility>

#include "core/base/clock.h"
#include "core/scene/pose/mesh_pose.h"
#include "gl/context/context.h"
#include "gl/context/error.h"
#include "hybrid/exchange/encode.h"
#include "hybrid/frame/schedule.h"
#include "hybrid/passes/passes.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// The GPU's clock and the CPU's drift apart.
constexpr std::uint64_t kFramesBetweenCalibrations = 256;

}  // namespace

class Renderer::Loop {
 public:
  Loop(Engine& engine, FrameSinks sinks, Progress* progress)
      : engine_(engine.parts()), sinks_(std::move(sinks)), progress_(progress) {
    slots_.resize(kFramesInFlight);
  }

  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  // Runs `work` in the Engine's context. Where OpenGL fails, no frame in flight is used again.
  template <class Work>
  auto enter(const Work& work) {
    try {
      return engine_.enter(work);
    } catch (const gl::Error&) {
      forget_gpu();
      throw;
    }
  }

  void submit(FrameRequest request);
  bool try_submit(FrameRequest request);
  bool advance();
  [[nodiscard]] bool is_tracing() const;
  void drain();

 private:
  void forget_gpu();
  [[nodiscard]] FrameSlot* frames_back(int n);  // begun n frames before the newest; null: there is none
  [[nodiscard]] int frames_drawn() const;       // not counting delivered ones
  bool repeat(const FrameRequest& request);
  FrameSlot& begin(FrameRequest&& request);
  void record_pose(FrameSlot& frame);
  void draw(FrameSlot& frame);
  void submit_reprojected(FrameSlot& now);
  void start_trace(FrameSlot& frame);
  void take_traced(FrameSlot& frame);
  void finish(FrameSlot& frame);
  void deliver(FrameSlot& frame, const FrameSlot* older);
  void show(FrameSlot& frame);
  void report(const FrameRecord& record);
  void retire(FrameSlot& frame);
  [[nodiscard]] int generation() const {
    return engine_.has_gpu() ? engine_.passes->programs->generation() : 0;
  }

  Engine::Parts& engine_;
  FrameSinks sinks_;
  Progress* progress_;
  gl::GpuClock clock_;
  Gathering gathering_;  // before slots_, whose destructors wait for the tracing thread
  std::uint64_t next_number_ = 0;
  int generation_ = 0;                             // of the programs that drew the newest frame
  std::uint64_t drawn_ = 0;                        // frames that were not repeats
  std::uint64_t frames_on_gpu_ = 0;                // those of drawn_ that used the GPU
  std::vector<std::unique_ptr<FrameSlot>> slots_;  // the n-th of them is in slot n % kFramesInFlight
};

Renderer::Loop::~Loop() {
  try {
    engine_.enter([this] { slots_.clear(); });
  } catch (const std::exception&) {
    // The context is lost, and its objects with it.
  }
}

// All frames in flight are lost.
void Renderer::Loop::forget_gpu() {
  for (std::unique_ptr<FrameSlot>& slot : slots_) slot.reset();
  engine_.forget_gpu();
}

void Renderer::Loop::submit(FrameRequest request) {
  throw_if_cancelled(progress_);
  settle_lights(request.scene, request.settings);
  if (const FrameSlot* const last = frames_back(0);
      last && last->request.settings.exchange != request.settings.exchange)
    drain();
  if (repeat(request)) return;
  FrameSlot& now = begin(std::move(request));
  const Schedule schedule = schedule_of(now.request.settings);
  if (schedule.reprojects) return submit_reprojected(now);
  if (schedule.latency > 0) {
    // The CPU traces one frame at a time, and starts the next before the GPU finishes the last.
    FrameSlot* const oldest = frames_back(kMostLatency);
    if (oldest && oldest->tracing.valid()) oldest->tracing.wait();
    if (FrameSlot* const last = frames_back(1)) start_trace(*last);
  }
  for (int n = kMostLatency; n >= schedule.latency; --n)
    if (FrameSlot* const due = frames_back(n)) finish(*due);
}

bool Renderer::Loop::try_submit(FrameRequest request) {
  settle_lights(request.scene, request.settings);
  const Schedule schedule = schedule_of(request.settings);
  const FrameSlot* const last = frames_back(0);
  const bool same_way = last && last->request.settings.exchange == request.settings.exchange &&
                        schedule_of(last->request.settings).latency == schedule.latency;
  const bool all_delivered = advance();
  if (!all_delivered &&
      (!same_way || last->request == request || frames_drawn() > std::min(schedule.latency, 1)))
    return false;
  if (schedule.reprojects) {
    // The same request again: the frame gets its own mask and reflection.
    FrameSlot* const newest = frames_back(0);
    const bool again = newest && newest->request == request;
    if (again && newest->state == FrameSlot::State::delivered && !newest->complete) start_trace(*newest);
    const FrameSlot* const awaited = again ? newest : frames_back(kMostLatency - 1);
    if (awaited && awaited->is_tracing()) return false;
    submit(std::move(request));
    return true;
  }
  if (all_delivered && repeat(request)) return true;
  begin(std::move(request));
  (void)advance();
  return true;
}

bool Renderer::Loop::advance() {
  for (int n = kMostLatency; n >= 0; --n) {
    FrameSlot* const frame = frames_back(n);
    if (!frame || frame->state != FrameSlot::State::drawn) continue;
    start_trace(*frame);
    if (frame->is_tracing()) return false;
    // The CPU traces the next frame while the GPU finishes this one.
    if (FrameSlot* const next = n > 0 ? frames_back(n - 1) : nullptr;
        next && next->state == FrameSlot::State::drawn)
      start_trace(*next);
    finish(*frame);
  }
  return true;
}

int Renderer::Loop::frames_drawn() const {
  return as_int(std::ranges::count_if(slots_, [](const std::unique_ptr<FrameSlot>& slot) {
    return slot && slot->state == FrameSlot::State::drawn;
  }));
}

bool Renderer::Loop::is_tracing() const {
  return std::ranges::any_of(
      slots_, [](const std::unique_ptr<FrameSlot>& slot) { return slot && slot->is_tracing(); });
}

void Renderer::Loop::drain() {
  for (int n = kMostLatency; n >= 0; --n)
    if (FrameSlot* const frame = frames_back(n)) finish(*frame);
  for (int n = kMostLatency; n >= 0; --n)
    if (FrameSlot* const frame = frames_back(n)) retire(*frame);
}

// Delivers the newest raster at once: while the CPU traces the frame before, it is shown with the mask and
// reflection of an earlier one. The first frame, and one that no earlier answer fits, waits for its own.
void Renderer::Loop::submit_reprojected(FrameSlot& now) {
  FrameSlot *const last = frames_back(1), *const oldest = frames_back(kMostLatency);
  if (oldest) take_traced(*oldest);
  if (last) finish(*last);  // drawn by the CPU alone, or delayed by an error
  if (last && last->state == FrameSlot::State::delivered) start_trace(*last);
  for (const FrameSlot* const source : {last, oldest})
    if (source && source->reprojects_to(now)) return deliver(now, source);
  if (last) take_traced(*last);
  finish(now);
}

bool Renderer::Loop::repeat(const FrameRequest& request) {
  FrameSlot* const last = frames_back(0);
  if (!last || !request.settings.reuse || !(last->request == request)) return false;
  if (generation_ != generation()) return false;
  if (last->state == FrameSlot::State::delivered && !last->complete) start_trace(*last);
  drain();
  if (!last->complete) {  // it was shown with an older frame's answer
    if (!last->answered) return false;
    composite_on_gpu(engine_.gpu(), *last, nullptr);
    last->complete = true;
    last->answer_of = last;
  }
  last->record = FrameRecord{};
  last->record.number = next_number_++;
  last->record.frame.begin_s = now_s();
  show(*last);
  last->record.frame.end_s = now_s();
  report(last->record);
  pinocchio::advance(progress_);
  return true;
}

// A pose's first frame records what the pose and its trees took.
void Renderer::Loop::record_pose(FrameSlot& frame) {
  const FrameRequest& request = frame.request;
  const MeshPose* const pose = request.scene.mesh->pose().get();
  if (!pose || std::exchange(engine_.last_pose_s, pose->begin_s) == pose->begin_s) return;
  frame.record[Stage::pose] = {pose->begin_s, pose->end_s};
  if (request.tracer)
    frame.record[Stage::trees] = {request.tracer->build_begin_s(), request.tracer->build_end_s()};
}

FrameSlot& Renderer::Loop::begin(FrameRequest&& request) {
  const gl::Mapping mapping = request.settings.persistent ? gl::Mapping::persistent : gl::Mapping::each_time;
  std::unique_ptr<FrameSlot>& slot = slots_[drawn_ % kFramesInFlight];
  if (slot) retire(*slot);
  if (!slot || slot->mapping != mapping) slot = std::make_unique<FrameSlot>(engine_, mapping);
  ++drawn_;
  FrameSlot& frame = *slot;
  const bool gpu = schedule_of(request.settings).gpu;
  if (gpu) {
    (void)engine_.gpu();
    if (gl::context_lost())
      throw gl::ContextLostError("the GPU was reset and its OpenGL context is lost; start again");
    if (frames_on_gpu_++ % kFramesBetweenCalibrations == 0 || clock_.is_old()) clock_.calibrate();
  }
  generation_ = generation();
  frame.begin(std::move(request), next_number_++, progress_);
  record_pose(frame);
  if (gpu) draw(frame);
  frame.state = FrameSlot::State::drawn;  // last: a frame is lost if drawing throws
  return frame;
}

void Renderer::Loop::draw(FrameSlot& frame) {
  frame.mesh = engine_.gpu_mesh(frame.request.scene.mesh);
  frame.lights.update(frame.request.scene);
  if (frame.request.settings.visibility == Processor::cpu) return;
  rasterise(engine_.gpu(), frame);
  send_to_cpu(frame);
  engine_.throw_gl_errors();
}

FrameSlot* Renderer::Loop::frames_back(int n) {
  const auto back = static_cast<std::uint64_t>(n) + 1;
  return drawn_ < back ? nullptr : slots_[(drawn_ - back) % kFramesInFlight].get();
}

void Renderer::Loop::start_trace(FrameSlot& frame) {
  if (frame.state == FrameSlot::State::idle || frame.tracing.valid() || frame.answered) return;
  if (!frame.request.settings.traces()) return;
  take_on_cpu(frame);
  Workers& workers = engine_.workers(frame.request.settings.threads);
  frame.tracing = engine_.tracing.post([this, &workers, &frame] {
    trace(workers, frame, gathering_);
    encode_answer(workers, frame);
  });
}

// Waits for the CPU's part and sends it to the GPU. Throws exceptions of tracing; the frame is lost then.
void Renderer::Loop::take_traced(FrameSlot& frame) {
  if (!frame.tracing.valid()) return;
  const FrameSlot::State state = std::exchange(frame.state, FrameSlot::State::idle);
  frame.tracing.get();
  if (schedule_of(frame.request.settings).gpu) send_to_gpu(frame);
  frame.answered = true;
  frame.state = state;
}

void Renderer::Loop::finish(FrameSlot& frame) {
  if (frame.state != FrameSlot::State::drawn) return;
  start_trace(frame);
  take_traced(frame);
  deliver(frame, nullptr);
}

void Renderer::Loop::deliver(FrameSlot& frame, const FrameSlot* older) {
  frame.state = FrameSlot::State::idle;  // the frame is lost if a line below throws
  if (schedule_of(frame.request.settings).gpu) {
    composite_on_gpu(engine_.gpu(), frame, older);
    frame.release_unused();
    engine_.throw_gl_errors();
  }
  frame.answer_of = older ? older : frame.answered ? &frame : nullptr;
  frame.state = FrameSlot::State::delivered;
  frame.complete = !older;
  frame.record.latency_frames = as_int(next_number_ - 1 - frame.record.number);
  if (older) frame.record.age_frames = as_int(frame.record.number - older->record.number);
  show(frame);
  if (!frame.request.settings.traces()) pinocchio::advance(progress_);
}

void Renderer::Loop::show(FrameSlot& slot) {
  if (!sinks_.frame) return;
  engine_.call_out([&] {
    Frame frame(slot);
    sinks_.frame(frame);
  });
}

// Waits for the GPU only where the frame was the last one.
void Renderer::Loop::retire(FrameSlot& frame) {
  take_traced(frame);
  if (frame.state != FrameSlot::State::delivered) return;
  frame.add_gpu_times(clock_);
  frame.state = FrameSlot::State::idle;
  report(frame.record);
}

void Renderer::Loop::report(const FrameRecord& record) {
  if (sinks_.record) engine_.call_out([&] { sinks_.record(record); });
}

Renderer::Renderer(Engine& engine, FrameSinks sinks, Progress* progress)
    : loop_(std::make_unique<Loop>(engine, std::move(sinks), progress)) {}
Renderer::~Renderer() = default;

void Renderer::submit(const FrameRequest& request) {
  loop_->enter([&] { loop_->submit(request); });
}
bool Renderer::try_submit(const FrameRequest& request) {
  return loop_->enter([&] { return loop_->try_submit(request); });
}
bool Renderer::advance() {
  return loop_->enter([&] { return loop_->advance(); });
}
bool Renderer::is_tracing() const {
  return loop_->is_tracing();
}
void Renderer::drain() {
  loop_->enter([&] { loop_->drain(); });
}

}  // namespace pinocchio
