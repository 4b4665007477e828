// What is drawn by each exchange beside what sync draws: the same pictures, and under motion nothing worse
// than old ones.
#include <cstdio>

#include "hybrid/frame/schedule.h"
#include "tests/support/frames.h"

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

DrawRequest by_exchange(Exchange exchange) {
  DrawRequest request;
  request.settings.exchange = exchange;
  return request;
}

TEST(Pipeline, DrawsTheSynchronousPicturesBitForBit) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    const std::vector<Camera> cameras = orbit(scene, 7);
    const std::vector<FrameResult> sync = draw_all(scene, {}, cameras);
    for (const bool persistent : {false, true}) {
      DrawRequest request = by_exchange(Exchange::pipelined);
      request.settings.persistent = persistent;
      const std::vector<FrameResult> pipelined = draw_all(scene, request, cameras);
      ASSERT_EQ(pipelined.size(), sync.size());
      for (std::size_t i = 0; i < sync.size(); ++i)
        EXPECT_TRUE(same_pixels(pipelined[i], sync[i])) << name << " " << i;
    }
  }
}

TEST(Pipeline, Design2TooAndTheSlides) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Camera> cameras = orbit(scene, 5);
  for (const char* design : {"1", "2"})
    for (const char* plan : {"auto", "slides"}) {
      DrawRequest request{.settings = by({{"design", design}, {"plan", plan}})};
      const std::vector<FrameResult> sync = draw_all(scene, request, cameras);
      request.settings.exchange = Exchange::pipelined;
      const std::vector<FrameResult> pipelined = draw_all(scene, request, cameras);
      ASSERT_EQ(pipelined.size(), sync.size());
      for (std::size_t i = 0; i < sync.size(); ++i)
        EXPECT_TRUE(same_pixels(pipelined[i], sync[i])) << "design " << design << " frame " << i;
    }
}

TEST(Reproject, OfAStillCameraIsExact) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Camera> still(5, first_camera(scene));
  const std::vector<FrameResult> sync = draw_all(scene, {}, {still.front()});
  const std::vector<FrameResult> warped = draw_all(scene, by_exchange(Exchange::reproject), still);
  ASSERT_EQ(warped.size(), still.size());
  for (const FrameResult& picture : warped) EXPECT_TRUE(same(picture.color, sync.front().color));
}

// Mean difference of the pictures, linear.
double mean_difference(const std::vector<FrameResult>& a, const std::vector<FrameResult>& b) {
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
  const std::vector<FrameResult> sync = draw_all(scene, {}, cameras);
  const std::vector<FrameResult> warped = draw_all(scene, by_exchange(Exchange::reproject), cameras);
  std::vector<FrameResult> late;  // what pipelined shows meanwhile
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

}  // namespace
}  // namespace pinocchio
