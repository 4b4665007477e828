#include "bench/chart/bench.h"

#include <algorithm>

#include "core/compare/magma.h"
#include "core/image/codecs/png.h"
#include "core/image/rgb.h"
#include "core/image/tonemap.h"
#include "core/math/median.h"
#include "hybrid/frame/samples.h"

namespace pinocchio::chart {
namespace {

FrameRequest raster_only(FrameRequest request) {
  (void)apply_preset("mode", "raster", request.settings);
  return request;
}

Scene settled(Scene scene, const Settings& settings) {
  settle_environment(scene, settings);
  return scene;
}

// The screen: after each frame of the motion is requested, the newest delivered picture.
class Screen {
 public:
  Screen(Engine& engine, FrameRequest request, Progress* progress)
      : request_(std::move(request)),
        mean_(request_.settings, [this](FrameResult&& picture) { color_ = std::move(picture.color); }),
        renderer_(engine, {[this](Frame& frame) { mean_.add(frame); }, {}}, progress) {}

  const Image<glm::vec4>& show(const View& view) {
    request_.view = view;
    submit_samples(renderer_, request_);
    return color_;
  }

 private:
  FrameRequest request_;
  Image<glm::vec4> color_;
  SampleMean mean_;
  Renderer renderer_;
};

}  // namespace

Bench::Bench(Engine& engine, FrameRequest base, const BenchSettings& settings, std::vector<View> views,
             std::filesystem::path folder)
    : engine_(engine),
      last_(std::move(base)),
      settings_(settings),
      views_(std::move(views)),
      folder_(std::move(folder)),
      ground_truth_(settled(last_.scene, last_.settings), last_.settings.depth, settings_.area_side, views_,
                    folder_ / "pictures", engine.workers(), settings_.progress),
      raster_(engine, raster_only(last_), settings_.progress) {}

PointFigures Bench::measure(const Configuration& configuration) {
  const FrameRequest request = request_for(configuration.settings);
  PointFigures figures;
  measure_time(request, figures);
  measure_error(configuration, request, figures);
  return figures;
}

// The request with the tree for the settings. The last tree is kept.
FrameRequest Bench::request_for(const Settings& settings) {
  if (!last_.tracer || !same_tracer(settings, last_.settings))
    last_.tracer = Engine::prepare(last_.scene, settings, settings_.progress);
  last_.settings = settings;
  return last_;
}

void Bench::measure_time(const FrameRequest& request, PointFigures& figures) {
  TimedRenderer renderer(engine_, request, settings_.progress);
  if (!warm_) {  // the first frames allocate memory, start threads and compile shaders for all later ones
    (void)raster_.draw(views_);
    (void)renderer.draw(views_);
    warm_ = true;
  }
  std::vector<double> ratios, frame_ms, round_ms, raster_ms, cpu_ms, raster_cpu_ms, latency_ms;
  const bool by_cpu = settings_.clock == Clock::cpu;
  TimedRenderer::Round round;
  for (int i = 0; i < settings_.rounds; ++i) {
    const TimedRenderer::Round raster = raster_.draw(views_);
    round = renderer.draw(views_);
    ratios.push_back(by_cpu ? round.cpu_ms / raster.cpu_ms : round.frame_ms / raster.frame_ms);
    frame_ms.push_back(round.least_ms);
    round_ms.push_back(round.frame_ms);
    raster_ms.push_back(raster.least_ms);
    cpu_ms.push_back(round.cpu_ms);
    raster_cpu_ms.push_back(raster.cpu_ms);
    latency_ms.push_back(round.latency_ms);
  }
  const auto least = [](const std::vector<double>& values) {
    return *std::min_element(values.begin(), values.end());
  };
  figures.frame_ms = least(frame_ms);
  figures.round_low_ms = least(round_ms);
  figures.round_high_ms = *std::ranges::max_element(round_ms);
  figures.round_ms = median(std::move(round_ms));
  figures.raster_ms = least(raster_ms);
  figures.cpu_ms = least(cpu_ms);
  figures.raster_cpu_ms = least(raster_cpu_ms);
  figures.ratio_median = median(std::move(ratios));
  figures.latency_ms = least(latency_ms);
  figures.latency_frames = round.latency_frames;
  figures.age_frames = round.age_frames;
  figures.bytes_gpu_to_cpu = round.bytes_to_cpu;
  figures.bytes_cpu_to_gpu = round.bytes_to_gpu;
}

// The area reference is expensive: only the last frame is compared with it.
std::vector<std::size_t> Bench::compared_frames(bool area) const {
  const std::size_t first = kWarmUpFrames, last = views_.size() - 1;
  const auto count = static_cast<std::size_t>(area ? 1 : settings_.error_frames);
  std::vector<std::size_t> frames;
  for (std::size_t i = 1; i < count; ++i) frames.push_back(first + (last - first) * (i - 1) / (count - 1));
  frames.push_back(last);
  return frames;
}

void Bench::measure_error(const Configuration& configuration, const FrameRequest& request,
                          PointFigures& figures) {
  const bool area = configuration.reference == "area";
  figures.reference = configuration.reference;
  const std::vector<std::size_t> compared = compared_frames(area);
  Screen screen(engine_, request, settings_.progress);
  for (std::size_t frame = 0; frame < views_.size(); ++frame) {
    const Image<glm::vec4>& color = screen.show(views_[frame]);
    if (std::find(compared.begin(), compared.end(), frame) == compared.end()) continue;
    const MeasuredError error = ground_truth_.measure(color, frame, area);
    if (error.not_finite > 0) {
      figures.failure = "NaN or infinity in " + std::to_string(error.not_finite) + " pixels";
      return;
    }
    figures.rmse += error.rgb.rmse / static_cast<double>(compared.size());
    figures.relative_mse += error.rgb.relative_mse / static_cast<double>(compared.size());
    figures.flip += error.mean_flip / static_cast<double>(compared.size());
    figures.worst = std::max(figures.worst, error.rgb.max_difference);
    if (frame == compared.back())
      write_pictures(configuration.name(), color, error, ground_truth_.reference(frame, area), area);
  }
}

void Bench::write_pictures(const std::string& name, const Image<glm::vec4>& color, const PictureError& error,
                           const Image<glm::vec3>& truth, bool area) const {
  const std::filesystem::path pictures = folder_ / "pictures";
  write_png(pictures / (name + ".png"), preview(color, 0.0f));
  write_png(pictures / (name + "-flip.png"), magma(error.flip));
  write_png(pictures / (area ? "reference-area.png" : "reference-centre.png"), preview(opaque(truth), 0.0f));
}

}  // namespace pinocchio::chart
