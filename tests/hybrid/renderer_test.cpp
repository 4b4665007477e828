// Several frames in flight: what is delivered, when, and that nothing is lost or mixed.
#include "hybrid/frame.h"

#include <stdexcept>

#include "hybrid/shader_folder.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

namespace pinocchio {
namespace {

std::vector<Camera> orbit(const Scene& scene, int frames) {
  std::vector<Camera> cameras;
  for (int i = 0; i < frames; ++i) {
    Camera camera = first_camera(scene);
    camera.eye += glm::vec3(0.05f * static_cast<float>(i), 0.02f * static_cast<float>(i % 3), 0.0f);
    cameras.push_back(camera);
  }
  return cameras;
}

TEST(Pipeline, DrawsTheSynchronousPicturesBitForBit) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    const std::vector<Camera> cameras = orbit(scene, 7);
    const std::vector<Picture> sync = draw_all(scene, {}, cameras);
    for (const gl::Mapping mapping : {gl::Mapping::each_time, gl::Mapping::persistent}) {
      const std::vector<Picture> pipelined =
          draw_all(scene, {.exchange = Exchange::pipelined, .mapping = mapping}, cameras);
      ASSERT_EQ(pipelined.size(), sync.size());
      for (std::size_t i = 0; i < sync.size(); ++i)
        EXPECT_TRUE(same_pixels(pipelined[i], sync[i])) << name << " " << i;
    }
  }
}

TEST(Pipeline, Design2TooAndTheSlidesPlans) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Camera> cameras = orbit(scene, 5);
  for (const int design : {1, 2})
    for (const bool slides : {false, true}) {
      DrawRequest request{.design = design, .slides = slides};
      const std::vector<Picture> sync = draw_all(scene, request, cameras);
      request.exchange = Exchange::pipelined;
      const std::vector<Picture> pipelined = draw_all(scene, request, cameras);
      ASSERT_EQ(pipelined.size(), sync.size());
      for (std::size_t i = 0; i < sync.size(); ++i)
        EXPECT_TRUE(same_pixels(pipelined[i], sync[i])) << "design " << design << " frame " << i;
    }
}

TEST(Reproject, OfAStillCameraIsExact) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Camera> still(5, first_camera(scene));
  const std::vector<Picture> sync = draw_all(scene, {}, {still.front()});
  const std::vector<Picture> warped = draw_all(scene, {.exchange = Exchange::reproject}, still);
  ASSERT_EQ(warped.size(), still.size());
  for (const Picture& picture : warped)
    EXPECT_TRUE(std::ranges::equal(picture.color.pixels(), sync.front().color.pixels()));
}

// Mean difference of the pictures, linear.
double mean_difference(const std::vector<Picture>& a, const std::vector<Picture>& b) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < a.size(); ++f)
    for (std::size_t i = 0; i < a[f].color.pixels().size(); ++i, ++count)
      sum += static_cast<double>(glm::length(glm::vec3(a[f].color[i]) - glm::vec3(b[f].color[i])));
  return sum / static_cast<double>(count);
}

TEST(Reproject, UnderMotionBeatsAnOldPictureAndHasNoBlackOrNan) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Camera> cameras = orbit(scene, 8);
  const std::vector<Picture> sync = draw_all(scene, {}, cameras);
  const std::vector<Picture> warped = draw_all(scene, {.exchange = Exchange::reproject}, cameras);
  std::vector<Picture> late;  // what pipelined shows meanwhile
  for (std::size_t i = 0; i < sync.size(); ++i) late.push_back(sync[i < 2 ? 0 : i - 2]);
  const double warped_error = mean_difference(warped, sync), late_error = mean_difference(late, sync);
  std::printf("  error under motion: reprojected %.5f, two frames late %.5f\n", warped_error, late_error);
  EXPECT_LT(warped_error, 0.5 * late_error);
  EXPECT_EQ(warped.front().holes, 0u);  // waited for its own
  EXPECT_GT(warped.back().holes, 0u);   // what comes into view
  EXPECT_LT(warped.back().holes, warped.back().ids.pixels().size() / 10);
  for (std::size_t f = 0; f < warped.size(); ++f)
    for (std::size_t i = 0; i < warped[f].color.pixels().size(); ++i) {
      const glm::vec4& c = warped[f].color[i];
      ASSERT_TRUE(c == c);
      if (warped[f].ids[i] != kNoTriangle) {
        ASSERT_GT(c.r + c.g + c.b, 0.0f);
      }
    }
}

// A loop whose deliveries are kept as pictures.
class LoopTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    loop_.emplace(workers_, shader_folder(), Exchange::pipelined, gl::Mapping::each_time,
                  FrameLoop::Sinks{[this](Flight& frame) { take(frame); },
                                   [this](const FrameRecord& record) { records_.push_back(record); }});
  }
  void TearDown() override {
    loop_.reset();
    scenes_.clear();
    GlTest::TearDown();
  }

  std::shared_ptr<const PreparedScene> prepare(const Scene& scene, const Plan& plan) {
    scenes_.push_back(
        std::make_shared<const PreparedScene>(scene, sides_of(plan), BuildOptions{}, std::optional<Isa>()));
    return scenes_.back();
  }
  // The camera moves a little each time: no frame is the last one again.
  FrameRequest request(const std::shared_ptr<const PreparedScene>& scene, const Plan& plan, glm::ivec2 size) {
    FrameRequest next{scene, plan, first_camera(scene->scene), size, {{0, 0}, size}, glm::vec2(0.0f)};
    next.camera.eye.x += 1e-3f * static_cast<float>(++requests_);
    return next;
  }

  struct Delivery {
    std::uint64_t number;
    int latency;
    Image<glm::vec4> color;
  };
  Workers workers_{2};
  std::optional<FrameLoop> loop_;
  std::vector<Delivery> deliveries_;
  std::vector<FrameRecord> records_;

 private:
  void take(Flight& frame) {
    Delivery delivery{frame.record.number, frame.record.latency_frames, {}};
    FrameLoop::read_picture(frame, delivery.color);
    deliveries_.push_back(std::move(delivery));
  }
  std::vector<std::shared_ptr<const PreparedScene>> scenes_;
  int requests_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Backends, LoopTest, kBackends, backend_name);

Plan auto_plan(const Scene& scene) {
  return *make_plan(take_census(scene), {});
}

TEST_P(LoopTest, DeliversEachFrameOnceInOrderTwoFramesLater) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Plan plan = auto_plan(scene);
  const auto prepared = prepare(scene, plan);
  for (int i = 0; i < 10; ++i) {
    loop_->submit(request(prepared, plan, {96, 64}));
    EXPECT_EQ(deliveries_.size(), static_cast<std::size_t>(std::max(0, i + 1 - kLatencyFrames)));
  }
  loop_->drain();
  ASSERT_EQ(deliveries_.size(), 10u);
  ASSERT_EQ(records_.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(deliveries_[i].number, i);
    EXPECT_EQ(records_[i].number, i);
    EXPECT_LE(deliveries_[i].latency, kLatencyFrames);
    if (i < 8) {
      EXPECT_EQ(deliveries_[i].latency, kLatencyFrames);
    }
    EXPECT_EQ(records_[i][Transfer::ids], 96u * 64 * 2);
    EXPECT_EQ(records_[i][Transfer::mask], 96u / 8 * 64);
    EXPECT_GT(records_[i][Transfer::reflection], 0u);
    EXPECT_LT(records_[i][Transfer::reflection], 96u * 64 * 6);
    EXPECT_GT(records_[i].rays.shadow, 0u);
    EXPECT_GT(records_[i].frame.ms(), 0.0);
  }
  loop_->drain();  // nothing left
  EXPECT_EQ(deliveries_.size(), 10u);
}

TEST_P(LoopTest, SizeCameraSceneAndPlanMayChangeInFlight) {
  const Scene cornell = load_or_die(source_path("scenes/cornell")),
              boat = load_or_die(source_path("scenes/speedboat"));
  Scene unlit = plate_over_floor();
  std::vector<FrameRequest> requests;
  int i = 0;
  const std::vector<const Scene*> scenes{&cornell, &boat, &unlit, &cornell, &unlit, &boat, &boat, &cornell};
  for (const Scene* scene : scenes) {
    Plan plan = auto_plan(*scene);
    if (i == 6) plan = *make_plan(take_census(*scene), {.mode = Mode::raster});
    if (i == 7) plan.id_bits = 32;
    requests.push_back(request(prepare(*scene, plan), plan, {64 + 13 * (i % 4), 48 + 7 * (i % 3)}));
    requests.back().camera.eye.x += 0.01f * static_cast<float>(++i);
  }
  for (const FrameRequest& r : requests) loop_->submit(r);
  loop_->drain();
  ASSERT_EQ(deliveries_.size(), requests.size());
  const std::vector<Delivery> pipelined = std::move(deliveries_);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    deliveries_.clear();
    loop_->submit(requests[k]);
    loop_->drain();  // alone: as if synchronous
    ASSERT_EQ(deliveries_.size(), 1u);
    EXPECT_EQ(deliveries_[0].color.size(), requests[k].part.size());
    EXPECT_TRUE(std::ranges::equal(deliveries_[0].color.pixels(), pipelined[k].color.pixels())) << k;
  }
}

TEST_P(LoopTest, AnErrorOnATracingThreadSurfacesWithItsFrameAlone) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Plan plan = auto_plan(scene);
  const auto sound = prepare(scene, plan);
  const auto broken =
      prepare(scene, *make_plan(take_census(scene), {.mode = Mode::raster}));  // has no tree to trace
  int lost = 0;
  for (int i = 0; i < 8; ++i) {
    try {
      loop_->submit(request(i == 3 ? broken : sound, plan, {64, 48}));
    } catch (const std::exception&) {
      ++lost;
    }
  }
  loop_->drain();
  EXPECT_EQ(lost, 1);
  ASSERT_EQ(deliveries_.size(), 7u);
  for (const Delivery& delivery : deliveries_) EXPECT_NE(delivery.number, 3u);
}

TEST_P(LoopTest, MayEndWithFramesInFlight) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Plan plan = auto_plan(scene);
  const auto prepared = prepare(scene, plan);
  for (int frames = 1; frames <= 3; ++frames) {
    FrameLoop loop(workers_, shader_folder(), Exchange::pipelined, gl::Mapping::each_time,
                   {[](Flight&) {}, [](const FrameRecord&) {}});
    for (int i = 0; i < frames; ++i) {
      FrameRequest moved = request(prepared, plan, {320, 240});
      moved.camera.eye.x += 0.1f * static_cast<float>(i);
      loop.submit(moved);
    }
  }
}

TEST_P(LoopTest, Design2IsOneFrameLate) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Plan plan = *make_plan(take_census(scene), {.design = 2});
  const auto prepared = prepare(scene, plan);
  for (int i = 0; i < 6; ++i) {
    loop_->submit(request(prepared, plan, {96, 64}));
    EXPECT_EQ(deliveries_.size(), static_cast<std::size_t>(i));
  }
  loop_->drain();
  ASSERT_EQ(records_.size(), 6u);
  EXPECT_EQ(records_[0].latency_frames, kLatencyFramesDesign2);
}

TEST_P(LoopTest, RecordsHoldTheBytesOfThePlan) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  for (const int design : {1, 2})
    for (const bool slides : {false, true}) {
      Plan plan = *make_plan(take_census(scene), {.design = design, .slides = slides});
      plan.tiles = false;  // whose bytes depend on the picture (economy_test)
      records_.clear();
      loop_->submit(request(prepare(scene, plan), plan, {80, 60}));
      loop_->drain();
      ASSERT_EQ(records_.size(), 1u);
      EXPECT_EQ(records_[0].bytes_to_cpu(), traffic_of(plan, {80, 60}).to_cpu);
      EXPECT_EQ(records_[0].bytes_to_gpu(), traffic_of(plan, {80, 60}).to_gpu);
    }
}

TEST_P(LoopTest, WhatNeedsNoCpuIsDeliveredAtOnce) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 5, 1}, false)};
  const Plan plan = auto_plan(scene);
  loop_->submit(request(prepare(scene, plan), plan, {32, 24}));
  ASSERT_EQ(deliveries_.size(), 1u);
  EXPECT_EQ(deliveries_[0].latency, 0);
  loop_->drain();
  EXPECT_EQ(records_[0].bytes_to_cpu() + records_[0].bytes_to_gpu(), 0u);
}

}  // namespace
}  // namespace pinocchio
