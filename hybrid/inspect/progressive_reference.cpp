#include "hybrid/inspect/progressive_reference.h"

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>

#include "core/parallel/priority.h"
#include "core/parallel/start_thread.h"
#include "core/parallel/workers.h"
#include "core/reference/reference_tracer.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// Pixels from one sample to the next, pass by pass.
constexpr std::array<int, 4> kSteps{8, 4, 2, 1};
static_assert(TileGrid::kTileSize % kSteps.front() == 0);  // samples of a tile are the tile's own

}  // namespace

// One view's picture, while it is made.
struct ProgressiveReference::Job {
  Job(const ReferenceView& of, std::shared_ptr<pinocchio::Progress> mesh_progress)
      : scene(of.scene),
        camera(of.view),
        size(of.view.box().size()),
        depth(of.depth),
        options(of.options),
        of_mesh(std::move(mesh_progress)) {}

  Scene scene;
  ReferenceCamera camera;
  glm::ivec2 size;
  int depth;
  TraceOptions options;
  pinocchio::Progress of_view;                   // cancelled: another view is wanted
  std::shared_ptr<pinocchio::Progress> of_mesh;  // cancelled: another mesh is wanted

  struct Sample {
    glm::ivec2 at;
    glm::vec4 color;
  };
  struct Patch {
    int step;  // each sample covers step x step pixels
    std::vector<Sample> samples;
  };
  std::mutex mutex;            // guards the two below
  std::vector<Patch> patches;  // finished since the last poll
  std::exception_ptr error;

  std::size_t samples_taken = 0;  // by poll()
};

// Draws jobs in the background and keeps the tree between them.
class ProgressiveReference::Painter {
 public:
  explicit Painter(int threads) : workers_(threads) {}

  void draw(Job& job) {
    if (!tree_ || tree_mesh_ != job.scene.mesh) {
      tree_.reset();
      tree_mesh_ = job.scene.mesh;
      tree_.emplace(*tree_mesh_, job.of_mesh.get());
    }
    const ReferenceTracer tracer(job.scene, *tree_, job.options);
    const TileGrid grid(job.size);
    for (std::size_t pass = 0; pass < kSteps.size(); ++pass)
      workers_.for_each(grid.count(), [&](std::size_t i) { draw_tile(tracer, grid.tile(i), pass, job); });
  }

 private:
  static void draw_tile(const ReferenceTracer& tracer, const PixelBox& tile, std::size_t pass, Job& job) {
    const int step = kSteps[pass], last_step = pass > 0 ? kSteps[pass - 1] : 0;
    Job::Patch patch{step, {}};
    for (int y = tile.lo.y; y < tile.hi.y; y += step)
      for (int x = tile.lo.x; x < tile.hi.x; x += step) {
        if (job.of_view.cancelled()) return;
        if (last_step > 0 && x % last_step == 0 && y % last_step == 0) continue;  // of an earlier pass
        patch.samples.push_back({{x, y}, tracer.pixel(job.camera, x, y, job.depth).color});
      }
    const std::lock_guard lock(job.mutex);
    job.patches.push_back(std::move(patch));
  }

  Workers workers_;
  std::optional<ReferenceTree> tree_;
  std::shared_ptr<const Mesh> tree_mesh_;
};

ProgressiveReference::ProgressiveReference(int threads)
    : threads_(threads),
      thread_(start_thread<std::jthread>([this](const std::stop_token& stop) { work(stop); })) {}

ProgressiveReference::~ProgressiveReference() {
  stop();
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

void ProgressiveReference::show(const ReferenceView& view) {
  if (view_ && *view_ == view) return;
  const bool same_mesh = view_ && view_->scene.mesh == view.scene.mesh;
  const auto of_mesh = same_mesh ? wanted_->of_mesh : std::make_shared<pinocchio::Progress>();
  if (same_mesh) {
    wanted_->of_view.cancel();
  } else {
    stop();
  }
  view_ = std::make_unique<ReferenceView>(view);
  if (shown_.size() != view.view.box().size())
    shown_ = Image<glm::vec4>(view.view.box().size());
  else if (!shown_is_clear_)
    std::ranges::fill(shown_.pixels(), glm::vec4(0.0f));
  shown_is_clear_ = true;
  {
    const std::lock_guard lock(mutex_);
    wanted_ = std::make_shared<Job>(view, of_mesh);
  }
  wake_.notify_one();
}

void ProgressiveReference::stop() {
  if (!view_) return;
  wanted_->of_view.cancel();
  wanted_->of_mesh->cancel();
  const std::lock_guard lock(mutex_);
  wanted_.reset();
  view_.reset();
}

ProgressiveReference::Progress ProgressiveReference::poll() {
  if (!view_) return {shown_, 0.0, false};
  if (!thread_.joinable())
    throw std::runtime_error("the reference picture needs a thread, and the system starts no more of them");
  Job& job = *wanted_;
  std::vector<Job::Patch> patches;
  {
    const std::lock_guard lock(job.mutex);
    if (job.error) std::rethrow_exception(std::exchange(job.error, nullptr));
    patches.swap(job.patches);
  }
  for (const auto& [step, samples] : patches) {
    job.samples_taken += samples.size();
    for (const auto& [at, color] : samples) {
      const glm::ivec2 end = glm::min(at + step, shown_.size());
      for (int y = at.y; y < end.y; ++y)
        for (int x = at.x; x < end.x; ++x) shown_.at(x, y) = color;
    }
  }
  shown_is_clear_ = shown_is_clear_ && patches.empty();
  const auto pixels = as_double(shown_.pixels().size());
  return {shown_, as_double(job.samples_taken) / pixels, !patches.empty()};
}

void ProgressiveReference::work(const std::stop_token& stop) {
  lower_priority(kForBackground);
  std::optional<Painter> painter;
  std::shared_ptr<Job> job;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, stop, [&] { return wanted_ && wanted_ != job; });
      if (stop.stop_requested()) return;
      job = wanted_;
    }
    try {
      if (!painter) painter.emplace(threads_);
      painter->draw(*job);
    } catch (const Cancelled&) {  // another mesh is wanted
    } catch (...) {
      const std::lock_guard lock(job->mutex);
      job->error = std::current_exception();
    }
  }
}

}  // namespace pinocchio
