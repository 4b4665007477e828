// Settings::denoise and average_layers in whole pictures.
#include <cmath>
#include <cstring>

#include "core/trace/view/jitter.h"
#include "hybrid/settings/resolve.h"
#include "pinocchio/batch.h"
#include "pinocchio/layers.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"
#include "tests/support/same_bits.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kDenoisedSize{96, 72};

// A plate over a floor, both matt, under an even sky with a bright part.
Scene under_sky() {
  Scene scene = plate_over_floor();
  scene.ambient_light = glm::vec3(0.0f);
  Image<glm::vec3> sky({32, 16}, glm::vec3(0.4f));
  for (int x = 8; x < 12; ++x) sky.at(x, 3) = glm::vec3(12.0f, 11.0f, 9.0f);
  scene.environment = std::make_shared<const Environment>(std::move(sky));
  return scene;
}

// Lit by a lamp with a size alone: with half of its light unshadowed.
Scene under_lamp() {
  Scene scene = plate_over_floor();
  scene.ambient_light = glm::vec3(0.05f);
  Light lamp = point_light({1.5f, 3.0f, 1.0f});
  lamp.radius = 0.6f;
  Light soft = lamp;
  soft.casts_shadow = false;
  soft.intensity = 0.3f;
  scene.lights = {lamp, soft};
  return scene;
}

// Lit by more lamps than a step of the tracer takes at once.
Scene under_many_lamps() {
  Scene scene = under_lamp();
  Light lamp = scene.lights.front();
  lamp.intensity *= 0.1f;
  scene.lights.assign(10, lamp);
  return scene;
}

Settings with(std::initializer_list<std::pair<std::string_view, std::string_view>> presets, int spp,
              bool denoise = true) {
  Settings settings = by(presets);
  settings.spp = spp;
  settings.denoise = denoise;
  return settings;
}

FrameResult picture(const Scene& scene, const Settings& settings, PixelBox part = {}) {
  return draw_one(scene, {.settings = settings, .size = kDenoisedSize, .part = part});
}

double distance(const Image<glm::vec4>& a, const Image<glm::vec4>& b) {
  double squares = 0.0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const glm::dvec4 off(a[i] - b[i]);
    squares += glm::dot(off, off);
  }
  return std::sqrt(squares / static_cast<double>(a.pixels().size()));
}

// The distance over pixels whose surroundings see one square of the scene: at others, few samples see edges
// roughly.
double distance_within(const FrameResult& a, const FrameResult& b) {
  double squares = 0.0, count = 0.0;
  for (int y = 1; y + 1 < kDenoisedSize.y; ++y)
    for (int x = 1; x + 1 < kDenoisedSize.x; ++x) {
      bool inside = a.ids.at(x, y) != kNoTriangle;
      for (int k = 0; k < 9; ++k)
        inside = inside && a.ids.at(x + k % 3 - 1, y + k / 3 - 1) / 2 == a.ids.at(x, y) / 2;
      if (!inside) continue;
      const glm::dvec4 off(a.color.at(x, y) - b.color.at(x, y));
      squares += glm::dot(off, off);
      count += 1.0;
    }
  return std::sqrt(squares / count);
}

// The share of pixels that differ by more than `by`: at a few edges, GPU and CPU see neighbouring triangles.
double share_off(const Image<glm::vec4>& a, const Image<glm::vec4>& b, float by) {
  std::size_t off = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i)
    off += glm::any(glm::greaterThan(glm::abs(a[i] - b[i]), glm::vec4(by))) ? 1 : 0;
  return static_cast<double>(off) / static_cast<double>(a.pixels().size());
}

TEST(DenoisedPicture, FewSamplesAreNearTheTruth) {
  for (const Scene& scene : {under_sky(), under_lamp()}) {
    const FrameResult truth = picture(scene, with({{"mode", "raytrace"}}, 1024, false));
    const FrameResult plain = picture(scene, with({{"mode", "raytrace"}}, 4, false));
    const FrameResult filtered = picture(scene, with({{"mode", "raytrace"}}, 4));
    EXPECT_LT(distance_within(filtered, truth), 0.6 * distance_within(plain, truth));
  }
}

// Hard light alone: the option changes no bit.
TEST(DenoisedPicture, WithoutSamplesNothingIsFiltered) {
  for (const auto& mode : {"raytrace", "hybrid"}) {
    Scene scene = plate_over_floor();
    scene.lights = {point_light({1.5f, 3.0f, 1.0f})};
    const FrameResult on = picture(scene, with({{"mode", mode}}, 4)),
                      off = picture(scene, with({{"mode", mode}}, 4, false));
    EXPECT_FALSE(on.settings.denoise);
    EXPECT_TRUE(same_bits(on.color, off.color)) << mode;
  }
}

// What the samples find is split and put together again.
TEST(DenoisedPicture, TheLightIsKept) {
  for (const Scene& scene : {under_sky(), under_lamp(), under_many_lamps()}) {
    glm::dvec4 on(0.0), off(0.0);
    const FrameResult filtered = picture(scene, with({{"mode", "raytrace"}}, 16));
    const FrameResult plain = picture(scene, with({{"mode", "raytrace"}}, 16, false));
    for (const glm::vec4& pixel : filtered.color.pixels()) on += glm::dvec4(pixel);
    for (const glm::vec4& pixel : plain.color.pixels()) off += glm::dvec4(pixel);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(on[c] / off[c], 1.0, 0.01);
    EXPECT_NEAR(on.a / off.a, 1.0, 0.003);  // the samples are in other places
  }
}

TEST(DenoisedPicture, HybridAgreesWithTheCpu) {
  for (const Scene& scene : {under_sky(), under_lamp()})
    for (const int spp : {1, 3}) {
      const FrameResult expected = picture(scene, with({{"mode", "raytrace"}}, spp));
      ASSERT_TRUE(expected.settings.denoise);
      const FrameResult on_gpu = picture(scene, with({{"mode", "hybrid"}}, spp));
      EXPECT_LT(share_off(on_gpu.color, expected.color, 0.004f), 0.003) << spp;
      if (spp == 1) continue;  // a single picture of design 2 is packed in 8 bits
      const FrameResult by_cpu = picture(scene, with({{"mode", "hybrid"}, {"design", "2"}}, spp));
      EXPECT_LT(share_off(by_cpu.color, expected.color, 0.01f), 0.003) << spp;
    }
}

TEST(DenoisedPicture, PipelinedIsSynchronous) {
  Settings settings = with({{"mode", "hybrid"}}, 3);
  settings.exchange = Exchange::sync;
  const FrameResult sync = picture(under_lamp(), settings);
  settings.exchange = Exchange::pipelined;
  EXPECT_TRUE(same_bits(picture(under_lamp(), settings).color, sync.color));
}

TEST(DenoisedPicture, TheSameBitsOnAllProcessorsAndThreads) {
  Settings settings = with({{"mode", "raytrace"}}, 2);
  settings.threads = 1;
  settings.isa = Isa::scalar;
  const FrameResult under_the_sky = picture(under_sky(), settings),
                    under_lamps = picture(under_many_lamps(), settings);
  settings.threads = 3;
  for (const Isa isa : supported_isas()) {
    settings.isa = isa;
    EXPECT_TRUE(same_bits(picture(under_sky(), settings).color, under_the_sky.color)) << isa_name(isa);
    EXPECT_TRUE(same_bits(picture(under_many_lamps(), settings).color, under_lamps.color)) << isa_name(isa);
  }
}

// One picture after the other starts again.
TEST(DenoisedPicture, ManyPicturesAreTheSingleOnes) {
  const Scene scene = under_sky();
  Camera other = first_camera(scene);
  other.eye += glm::vec3(0.5f, 0.2f, 0.0f);
  const std::vector<Camera> cameras{first_camera(scene), other, first_camera(scene)};
  Engine engine;
  Image<glm::vec4> colors({kDenoisedSize.x, 3 * kDenoisedSize.y});
  FrameArrays to;
  to.color = colors.pixels().data();
  ASSERT_TRUE(render_many(engine, scene, cameras, kDenoisedSize, with({{"mode", "raytrace"}}, 2), to));
  const Image<glm::vec4> first = picture(scene, with({{"mode", "raytrace"}}, 2)).color;
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}})
    EXPECT_EQ(
        std::memcmp(&colors[k * first.pixels().size()], first.pixels().data(), first.pixels().size_bytes()),
        0);
}

// A part is the whole picture's, to the last bit: pixels around it are traced for its filter.
TEST(DenoisedPicture, PartsAndOtherCameras) {
  Scene scene = under_sky();
  const FrameResult whole = picture(scene, with({{"mode", "raytrace"}}, 2));
  const PixelBox part{{16, 8}, {80, 64}};
  const FrameResult box = picture(scene, with({{"mode", "raytrace"}}, 2), part);
  Image<glm::vec4> same(part.size());
  for (int y = 0; y < part.size().y; ++y)
    for (int x = 0; x < part.size().x; ++x) same.at(x, y) = whole.color.at(part.lo.x + x, part.lo.y + y);
  EXPECT_TRUE(same_bits(box.color, same));
  for (const Projection projection : {Projection::orthographic, Projection::panorama}) {
    Camera camera = first_camera(scene);
    camera.projection = projection;
    camera.height = 6.0f;
    scene.cameras = {camera};
    Settings settings = with({{"mode", "raytrace"}}, 256, false);
    const FrameResult truth = picture(scene, settings);
    settings.spp = 4;
    const FrameResult plain = picture(scene, settings);
    settings.denoise = true;
    EXPECT_LT(distance(picture(scene, settings).color, truth.color),
              0.8 * distance(plain.color, truth.color));
  }
}

// Each sample's picture is shown: the mean of those so far is filtered after the samples 1, 2, 4, 8 ... How
// many will follow is not known, so that in z-order only the first four are those of a picture of as many.
void expect_shown_samples_filtered(Sequence sequence, const std::vector<int>& counts) {
  const Scene scene = under_sky();
  Engine engine;
  FrameRequest request{scene, nullptr, with({{"mode", "raytrace"}}, 1), {first_camera(scene), kDenoisedSize}};
  request.settings.sequence = sequence;
  request.settings = engine.resolve(scene, kDenoisedSize, request.settings).value();
  request.tracer = Engine::prepare(scene, request.settings);
  request.shows_samples = true;
  Image<glm::vec4> sum(kDenoisedSize), mean(kDenoisedSize), shown;
  Renderer renderer(engine, {[&](Frame& frame) { frame.read_color(shown); }, {}});
  for (int k = 0; k < 8; ++k) {
    request.view = at_sample(request.view, k);
    renderer.submit(request);
    renderer.drain();
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum[i] += shown[i];
    for (const int spp : counts)
      if (k + 1 == spp) {
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) mean[i] = sum[i] / static_cast<float>(spp);
        Settings settings = with({{"mode", "raytrace"}}, spp);
        settings.filter_textures = request.settings.filter_textures;
        settings.sequence = sequence;
        EXPECT_LT(distance(mean, picture(scene, settings).color), 1e-4) << spp;
      }
  }
}

TEST(DenoisedPicture, ShownSamplesAreFilteredFromTheFirstOn) {
  expect_shown_samples_filtered(Sequence::sobol, {1, 4, 8});
  expect_shown_samples_filtered(Sequence::z_order, {1, 2, 4});
}

// Neighbours' samples complement each other in z-order, and the filter takes their mean.
TEST(DenoisedPicture, NeighboursSamplesComplementEachOther) {
  const auto error = [](const Scene& scene, const FrameResult& truth, Sequence sequence) {
    double sum = 0.0;
    for (const int seed : {0, 1, 2, 3}) {
      Settings settings = with({{"mode", "raytrace"}}, 4);
      settings.seed = seed;
      settings.sequence = sequence;
      sum += distance_within(picture(scene, settings), truth);
    }
    return sum;
  };
  for (const Scene& scene : {under_sky(), under_lamp()}) {
    Settings settings = with({{"mode", "raytrace"}}, 4096, false);
    settings.seed = 77;
    const FrameResult truth = picture(scene, settings);
    const double z_order = error(scene, truth, Sequence::z_order);
    const double sobol = error(scene, truth, Sequence::sobol);
    std::printf("  error: z-order %.4f, Sobol %.4f\n", z_order, sobol);
    EXPECT_LT(z_order, 0.94 * sobol);
  }
}

TEST(DenoisedPicture, ContradictionsAreRefusedOrTurnItOff) {
  SceneStats stats;
  stats.environment = true;
  Settings settings;
  settings.denoise = true;
  settings.max_noise = 0.01f;
  EXPECT_FALSE(resolve(settings, stats));
  settings.denoise = Setting<bool>::by_default(true);
  EXPECT_FALSE(resolve(settings, stats)->denoise);
  settings.max_noise = 0.0f;
  EXPECT_TRUE(resolve(settings, stats)->denoise);
  EXPECT_EQ(resolve(settings, stats)->sequence, Sequence::z_order);
  settings.indirect = 1;
  EXPECT_EQ(resolve(settings, stats)->sequence, Sequence::z_order);
  settings.environment_light = EnvironmentMethod::prefiltered;
  settings.indirect = 0;
  EXPECT_FALSE(resolve(settings, stats)->denoise);
}

// N and Albedo: of the first sample, or means.
TEST(AverageLayers, AreMeansOfWhatTheSamplesSee) {
  const Scene scene = under_sky();
  Settings settings = with({{"mode", "raytrace"}}, 16, false);
  const SurfaceImages first = surfaces_of(picture(scene, settings));
  settings.average_layers = true;
  const FrameResult frame = picture(scene, settings);
  const SurfaceImages mean = surfaces_of(frame);
  EXPECT_EQ(
      std::memcmp(mean.z_eye.pixels().data(), first.z_eye.pixels().data(), first.z_eye.pixels().size_bytes()),
      0);
  int smoothed = 0;
  for (std::size_t i = 0; i < frame.ids.pixels().size(); ++i) {
    const float length = glm::length(mean.n_shading[i]);
    EXPECT_LE(length, 1.0001f);
    const float share = frame.color[i].a;  // samples that hit something
    if (share == 1.0f && glm::dot(mean.n_shading[i], first.n_shading[i]) > 0.9999f) continue;
    ++smoothed;
    if (share == 0.0f) {
      EXPECT_EQ(mean.albedo[i], glm::vec3(0.0f));
    }
  }
  EXPECT_GT(smoothed, 10);
  const FrameResult one = picture(scene, with({{"mode", "raytrace"}}, 1, false));
  EXPECT_TRUE(one.mean_normal.empty());
}

}  // namespace
}  // namespace pinocchio
