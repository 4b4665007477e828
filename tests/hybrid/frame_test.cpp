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
        std::make_shared<const PreparedScene>(scene, plan, BuildOptions{}, std::optional<Isa>()));
    return scenes_.back();
  }
  static FrameRequest request(const std::shared_ptr<const PreparedScene>& scene, const Plan& plan,
                              glm::ivec2 size) {
    return {scene, plan, first_camera(scene->scene), size, {{0, 0}, size}, glm::vec2(0.0f)};
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
    loop_->steps().read_picture(frame, delivery.color);
    deliveries_.push_back(std::move(delivery));
  }
  std::vector<std::shared_ptr<const PreparedScene>> scenes_;
};
INSTANTIATE_TEST_SUITE_P(Backends, LoopTest, kBackends, backend_name);

Plan auto_plan(const Scene& scene) {
  return *make_plan(take_census(scene), Mode::hybrid, 8);
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
    EXPECT_EQ(records_[i].id_bytes, 96u * 64 * 2);
    EXPECT_EQ(records_[i].mask_bytes, 96u / 8 * 64);
    EXPECT_EQ(records_[i].reflection_bytes, 96u * 64 * 6);
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
    if (i == 6) plan = *make_plan(take_census(*scene), Mode::raster, 8);
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
      prepare(scene, *make_plan(take_census(scene), Mode::raster, 8));  // has no tree to trace
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

TEST_P(LoopTest, WhatNeedsNoCpuIsDeliveredAtOnce) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 5, 1}, false)};
  const Plan plan = auto_plan(scene);
  loop_->submit(request(prepare(scene, plan), plan, {32, 24}));
  ASSERT_EQ(deliveries_.size(), 1u);
  EXPECT_EQ(deliveries_[0].latency, 0);
  loop_->drain();
  EXPECT_EQ(records_[0].id_bytes + records_[0].mask_bytes + records_[0].reflection_bytes, 0u);
}

}  // namespace
}  // namespace pinocchio
