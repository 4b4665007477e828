// A still camera's samples, against the renderer's.
#include "hybrid/inspect/accumulator.h"

#include "core/trace/view/jitter.h"
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kGatheredSize{160, 120};

class AccumulatorTest : public FramesTest {
 protected:
  void SetUp() override {
    FramesTest::SetUp();
    accumulator_.emplace(*engine_);
  }
  void TearDown() override {
    accumulator_.reset();
    FramesTest::TearDown();
  }
  static std::vector<FrameRequest> samples_of(FrameRequest request, int count) {
    std::vector<FrameRequest> samples;
    for (int k = 0; k < count; ++k) {
      request.view.jitter = jitter_of(k);
      samples.push_back(request);
    }
    return samples;
  }

  std::optional<Accumulator> accumulator_;
};
INSTANTIATE_TEST_SUITE_P(Backends, AccumulatorTest, kBackends, backend_name);

TEST_P(AccumulatorTest, IsTheRenderersMeanOfAsManySamples) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  constexpr int kSamples = 8;
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined}) {
    accumulator_->reset();
    draw(samples_of(request(scene, settings_for(scene), kGatheredSize), kSamples), exchange,
         [&](Frame& frame) { accumulator_->add(frame); });
    ASSERT_EQ(accumulator_->samples(), kSamples);
    Image<glm::vec4> mean;
    accumulator_->read_average(mean);
    DrawRequest whole{.size = kGatheredSize, .backend = GetParam()};
    whole.settings.spp = kSamples;
    const FrameResult rendered = draw_one(scene, whole);
    float largest = 0.0f;
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
      for (int c = 0; c < 4; ++c)
        largest = std::max(
            largest, std::abs(mean[i][c] - rendered.color[i][c]) / std::max(rendered.color[i][c], 1e-3f));
    std::printf("  at most %.2g apart, relative\n", static_cast<double>(largest));
    EXPECT_LT(largest, 0x1p-11f);
  }
}

// Light that is brighter than white, which design 2's bytes cut off, is kept.
TEST_P(AccumulatorTest, IsTheRenderersMeanWhereThePictureTravelsInBytes) {
  Scene scene = load_or_die(source_path("scenes/cornell"));
  for (Light& light : scene.lights) light.intensity *= 4.0f;
  constexpr int kSamples = 8;
  const Settings two = by({{"design", "2"}});
  draw(samples_of(request(scene, settings_for(scene, two), kGatheredSize), kSamples), Exchange::pipelined,
       [&](Frame& frame) { accumulator_->add(frame); });
  Image<glm::vec4> mean;
  accumulator_->read_average(mean);
  DrawRequest whole{.settings = two, .size = kGatheredSize, .backend = GetParam()};
  whole.settings.spp = kSamples;
  const FrameResult rendered = draw_one(scene, whole);
  float brightest = 0.0f;
  for (std::size_t i = 0; i < mean.pixels().size(); ++i) {
    brightest = std::max(brightest, mean[i].r);
    for (int c = 0; c < 4; ++c)
      ASSERT_NEAR(mean[i][c], rendered.color[i][c], 1e-4f * std::max(rendered.color[i][c], 1.0f));
  }
  EXPECT_GT(brightest, 1.5f);
}

TEST_P(AccumulatorTest, BeginsAnewWhereTheViewChangesAndCountsNoSampleTwice) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  std::vector<FrameRequest> requests = samples_of(request(scene, settings_for(scene), kGatheredSize), 4);
  requests.push_back(requests.back());  // the same once more
  FrameRequest moved = requests.front();
  moved.view.camera.eye.x += 0.1f;
  const std::vector<FrameRequest> of_moved = samples_of(moved, 3);
  requests.insert(requests.end(), of_moved.begin(), of_moved.end());
  FrameRequest smaller = moved;
  smaller.view.size = kGatheredSize / 2;
  requests.push_back(smaller);
  const std::vector<int> expected{1, 2, 3, 4, 4, 1, 2, 3, 1};
  std::vector<int> counts;
  draw(requests, Exchange::pipelined, [&](Frame& frame) {
    accumulator_->add(frame);
    counts.push_back(accumulator_->samples());
    EXPECT_EQ(accumulator_->average().size(), frame.request().view.size);
    if (accumulator_->samples() > 1) return;
    Image<glm::vec4> mean;  // the first sample is the frame's own picture
    accumulator_->read_average(mean);
    EXPECT_TRUE(std::ranges::equal(mean.pixels(), read(frame.texture()).pixels()));
  });
  EXPECT_EQ(counts, expected);
}

TEST_P(AccumulatorTest, TakesNoAnswerOfAnotherView) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  FrameRequest moving = request(scene, settings_for(scene), kGatheredSize);
  std::vector<FrameRequest> requests;
  for (int i = 0; i < 4; ++i) {
    moving.view.camera.eye.x += 0.05f;
    requests.push_back(moving);
  }
  const std::vector<FrameRequest> still = samples_of(moving, 5);
  requests.insert(requests.end(), still.begin() + 1, still.end());
  int aged = 0;
  draw(requests, Exchange::reproject, [&](Frame& frame) {
    accumulator_->add(frame);
    const bool moves = frame.slot().answer_of->request.view.camera != frame.request().view.camera;
    aged += moves;
    EXPECT_EQ(accumulator_->samples() == 0, moves);
  });
  EXPECT_GT(aged, 2);
  EXPECT_GT(accumulator_->samples(), 2);
}

TEST_P(AccumulatorTest, StaysPreciseOverManySamples) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 5, 1})};
  FrameRequest one = request(scene, settings_for(scene), {8, 6});
  Image<glm::vec4> first, mean;
  Renderer renderer(*engine_, {[&](Frame& frame) {
                                 accumulator_->add(frame);
                                 if (accumulator_->samples() == 1) first = read(frame.texture());
                               },
                               {}});
  constexpr int kSamples = 3000;
  for (int k = 0; k < kSamples; ++k) {
    one.view.jitter = 1e-6f * jitter_of(k);  // as good as the same picture each time
    renderer.submit(one);
  }
  renderer.drain();
  ASSERT_EQ(accumulator_->samples(), kSamples);
  accumulator_->read_average(mean);
  for (std::size_t i = 0; i < mean.pixels().size(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[i][c], first[i][c], 0.002f * first[i][c] + 1e-5f);
}

}  // namespace
}  // namespace pinocchio
