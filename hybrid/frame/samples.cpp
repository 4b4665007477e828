#include "hybrid/frame/samples.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/parallel/tiles.h"
#include "core/trace/view/jitter.h"
#include "hybrid/frame/lines.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/conversion.h"
#include "pinocchio/surface_images.h"

namespace pinocchio {

namespace {

float texture_footprint(const Settings& settings, const View& view) {
  if (!settings.filter_textures) return 0.0f;
  const int samples = std::max(settings.spp.value, view.sample + 1);  // accumulated samples exceed spp
  return samples == 1 ? 1.0f : 1.0f / std::sqrt(as_float(samples));
}

std::optional<float> catcher_height(const Settings& settings) {
  const ShadowCatcher& catcher = settings.shadow_catcher.value;
  return catcher.kind == ShadowCatcher::Kind::at && settings.reflects() ? std::optional(catcher.height)
                                                                        : std::nullopt;
}

// The samples of a pixel that are spread together with its neighbours'. A picture that is shown while it
// gathers takes more than spp.
std::uint32_t together(int spp) {
  return std::bit_ceil(as_uint32(std::clamp(spp, 4, 1024)));
}

}  // namespace

TraceOptions trace_options(const Settings& settings, const View& view) {
  return {.throughput_cutoff = settings.throughput_cutoff,
          .light_cutoff = settings.light_cutoff,
          .texture_footprint = texture_footprint(settings, view),
          .terminator = settings.terminator,
          .backfaces = settings.backfaces,
          .environment_light = settings.environment_light,
          .glossy = settings.glossy,
          .sky_occlusion = settings.sky_occlusion,
          .sky_bounce = settings.indirect > 0 ? 0.0f : settings.sky_bounce.value,
          .denoise = settings.denoise,
          .glass_shadows = settings.glass_shadows,
          .background = settings.background,
          .background_blur = settings.background_blur,
          .catcher_height = catcher_height(settings),
          .jitter = view.jitter,
          .sampling = {.sequence = as_int(settings.sequence.value),
                       .index = as_uint32(view.sample),
                       .seed = as_uint32(settings.seed),
                       .count = together(settings.spp)}};
}

std::optional<glm::vec3> color_behind(const Settings& settings) {
  const Background& background = settings.background.value;
  return background.kind == Background::Kind::color ? std::optional(background.color) : std::nullopt;
}

void settle_environment(Scene& scene, const Settings& settings) {
  scene.environment_rotation_deg = settings.environment_rotation;
  scene.environment_strength = settings.environment_strength;
  if (settings.environment_strength <= 0.0f) scene.environment.reset();
  // Ambient light stands for light from other surfaces and the sky.
  if (settings.reflects() && (settings.indirect > 0 || scene.environment))
    scene.ambient_light = glm::vec3(0.0f);
}

bool same_view(FrameRequest a, const FrameRequest& b) {
  a.view.jitter = b.view.jitter;
  a.view.sample = b.view.sample;
  return a == b;
}

namespace {

int casting(const Scene& scene) {
  return as_int(std::ranges::count_if(scene.lights, &Light::casts_shadow));
}

}  // namespace

int mask_bits_of(const Settings& settings, const Scene& scene) {
  return settings.mask_bits == 0 ? 0 : std::max<int>(settings.mask_bits, MaskImage::bits_for(casting(scene)));
}

bool sends_lights(const Settings& settings, const Scene& scene) {
  return adds_lights(settings, casting(scene));
}

void submit_samples(Renderer& renderer, FrameRequest request, SampleMean* mean) {
  for (int k = 0; k < request.settings.spp; ++k) {
    request.view = at_sample(request.view, k, request.settings.pixel_filter);
    if (mean) request.left_out = mean->finished_;
    if (request.left_out && std::ranges::count(*request.left_out, 0) == 0) break;
    renderer.submit(request);
  }
  if (!mean || !mean->is_adaptive_) return;
  renderer.drain();  // frames in flight are samples of this picture
  if (mean->samples_ > 0) mean->finish();
}

void SampleMean::add(Frame& frame) {
  if (samples_ == 0) sum_ = frame.read();
  const Image<glm::vec4>& sample = samples_ == 0 ? sum_.color : frame.color(sample_);
  if (frame.request().settings.average_layers && spp_ > 1) add_surfaces(frame);
  if (is_adaptive_) {
    add_tiles(frame.request(), sample);
  } else if (samples_ > 0) {
    for (std::size_t i = 0; i < sample.pixels().size(); ++i) sum_.color[i] += sample[i];
  }
  if (++samples_ == spp_) finish();
}

// Adds what the frame's sample sees to the layers that are means.
void SampleMean::add_surfaces(const Frame& frame) {
  const FrameResult sample = frame.read();
  SurfaceImages seen{{}, {}, Image<glm::vec3>(sample.ids.size()), Image<glm::vec3>(sample.ids.size())};
  write_sample_surfaces(sample, seen);
  if (samples_ == 0) {
    sum_.mean_normal = std::move(seen.n_shading);
    sum_.mean_albedo = std::move(seen.albedo);
    return;
  }
  for (std::size_t i = 0; i < sum_.mean_normal.pixels().size(); ++i) {
    sum_.mean_normal[i] += seen.n_shading[i];
    sum_.mean_albedo[i] += seen.albedo[i];
  }
}

// Adds the tiles that the frame traced.
void SampleMean::add_tiles(const FrameRequest& request, const Image<glm::vec4>& picture) {
  const TileGrid grid(sum_.color.size());
  if (samples_ == 0) {
    squares_ = Image<glm::vec3>(sum_.color.size());
    tile_samples_.assign(grid.count(), 0);
  }
  for (std::size_t i = 0; i < grid.count(); ++i) {
    if (request.left_out && (*request.left_out)[i] != 0) continue;
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) {
      const glm::vec4& sample = picture.at(x, y);
      if (samples_ > 0) sum_.color.at(x, y) += sample;
      squares_.at(x, y) += glm::vec3(sample) * glm::vec3(sample);
    });
    if (++tile_samples_[i] % 16 == 0) check_tile(i);
  }
}

void SampleMean::check_tile(std::size_t tile) {
  const TileGrid grid(sum_.color.size());
  const double n = tile_samples_[tile];
  double sum = 0.0;
  TileGrid::for_each_pixel(grid.tile(tile), [&](int x, int y) {
    const glm::dvec3 mean = glm::dvec3(sum_.color.at(x, y)) / n, squares = glm::dvec3(squares_.at(x, y)) / n;
    const glm::dvec3 of_mean = glm::max(squares - mean * mean, 0.0) / (n - 1.0);
    sum += (of_mean.x + of_mean.y + of_mean.z) / 3.0;
  });
  const glm::ivec2 size = grid.tile(tile).size();
  if (std::sqrt(sum / (size.x * size.y)) > as_double(max_noise_)) return;
  auto finished = finished_ ? std::make_shared<std::vector<std::uint8_t>>(*finished_)
                            : std::make_shared<std::vector<std::uint8_t>>(grid.count());
  (*finished)[tile] = 1;
  finished_ = std::move(finished);
}

void SampleMean::finish() {
  const TileGrid grid(sum_.color.size());
  for (std::size_t i = 0; i < grid.count() && samples_ > 1; ++i) {
    const auto share = as_float(is_adaptive_ ? tile_samples_[i] : samples_);
    TileGrid::for_each_pixel(grid.tile(i), [&](int x, int y) { sum_.color.at(x, y) /= share; });
  }
  for (Image<glm::vec3>* const mean : {&sum_.mean_normal, &sum_.mean_albedo})
    for (glm::vec3& pixel : mean->pixels()) pixel /= as_float(samples_);
  samples_ = 0;
  finished_ = nullptr;
  done_(std::move(sum_));
}

}  // namespace pinocchio
