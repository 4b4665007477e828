// Several frames in flight: what is delivered, when, and that nothing is lost or mixed.
#include <future>
#include <stdexcept>
#include <thread>

#include "hybrid/exchange/channels.h"
#include "hybrid/frame/schedule.h"
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

// A renderer whose deliveries are kept as pictures.
class RendererTest : public FramesTest {
 protected:
  void SetUp() override {
    FramesTest::SetUp();
    renderer_.emplace(*engine_,
                      FrameSinks{[this](Frame& frame) { take(frame); },
                                 [this](const FrameRecord& record) { records_.push_back(record); }});
  }
  void TearDown() override {
    renderer_.reset();
    FramesTest::TearDown();
  }

  // Pipelined; the camera moves a little each time: no frame is the last one again.
  FrameRequest next(FrameRequest request) {
    request.settings.exchange = Exchange::pipelined;
    request.view.camera.eye.x += 1e-3f * static_cast<float>(++requests_);
    return request;
  }

  struct Delivery {
    std::uint64_t number;
    int latency;
    Image<glm::vec4> color;
  };
  std::optional<Renderer> renderer_;
  std::vector<Delivery> deliveries_;
  std::vector<FrameRecord> records_;

 private:
  void take(Frame& frame) {
    Delivery delivery{frame.record().number, frame.record().latency_frames, {}};
    frame.read_color(delivery.color);
    deliveries_.push_back(std::move(delivery));
  }
  int requests_ = 0;
};
INSTANTIATE_TEST_SUITE_P(Backends, RendererTest, kBackends, backend_name);

TEST_P(RendererTest, DeliversEachFrameOnceInOrderTwoFramesLater) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const FrameRequest request = this->request(scene, settings_for(scene), {96, 64});
  for (int i = 0; i < 10; ++i) {
    renderer_->submit(next(request));
    EXPECT_EQ(deliveries_.size(), static_cast<std::size_t>(std::max(0, i + 1 - kMostLatency)));
  }
  renderer_->drain();
  ASSERT_EQ(deliveries_.size(), 10u);
  ASSERT_EQ(records_.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(deliveries_[i].number, i);
    EXPECT_EQ(records_[i].number, i);
    EXPECT_LE(deliveries_[i].latency, kMostLatency);
    if (i < 8) {
      EXPECT_EQ(deliveries_[i].latency, kMostLatency);
    }
    EXPECT_EQ(records_[i][Channel::ids], 96u * 64 * 2);
    EXPECT_EQ(records_[i][Channel::mask], 96u / 8 * 64);
    EXPECT_GT(records_[i][Channel::reflection], 0u);
    EXPECT_LT(records_[i][Channel::reflection], 96u * 64 * 6);
    EXPECT_GT(records_[i].rays.shadow, 0u);
    EXPECT_GT(records_[i].frame.ms(), 0.0);
  }
  renderer_->drain();  // nothing left
  EXPECT_EQ(deliveries_.size(), 10u);
}

TEST_P(RendererTest, SizeCameraSceneAndSettingsMayChangeInFlight) {
  const Scene cornell = load_or_die(source_path("scenes/cornell")),
              boat = load_or_die(source_path("scenes/speedboat")), unlit = plate_over_floor();
  const std::vector<const Scene*> scenes{&cornell, &boat,    &unlit, &cornell, &unlit,  &boat,
                                         &boat,    &cornell, &boat,  &cornell, &cornell};
  std::vector<FrameRequest> requests;
  int i = 0;
  for (const Scene* scene : scenes) {
    Settings wanted;
    if (i == 6) wanted = by({{"mode", "raster"}});
    if (i == 7) wanted.id_bits = 32;
    if (i == 8) wanted = by({{"mode", "raytrace"}});
    if (i == 9) wanted = by({{"design", "2"}});
    requests.push_back(
        next(request(*scene, settings_for(*scene, wanted), {64 + 13 * (i % 4), 48 + 7 * (i % 3)})));
    requests.back().view.camera.eye.x += 0.01f * static_cast<float>(++i);
  }
  for (const FrameRequest& r : requests) renderer_->submit(r);
  renderer_->drain();
  ASSERT_EQ(deliveries_.size(), requests.size());
  const std::vector<Delivery> pipelined = std::move(deliveries_);
  for (std::size_t k = 0; k < requests.size(); ++k) {
    deliveries_.clear();
    renderer_->submit(requests[k]);
    renderer_->drain();  // alone: as if synchronous
    ASSERT_EQ(deliveries_.size(), 1u);
    EXPECT_EQ(pipelined[k].number, k);
    EXPECT_EQ(deliveries_[0].color.size(), requests[k].view.size);
    EXPECT_TRUE(same(deliveries_[0].color, pipelined[k].color)) << k;
  }
}

TEST_P(RendererTest, AnErrorOnTheTracingThreadSurfacesWithItsFrameAlone) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  for (const char* mode : {"hybrid", "raytrace"}) {
    deliveries_.clear();
    const FrameRequest sound = request(scene, settings_for(scene, by({{"mode", mode}})), {64, 48});
    FrameRequest broken = sound;
    broken.tracer = nullptr;  // has no tree to trace
    std::vector<std::uint64_t> numbers;
    int lost = 0;
    for (int i = 0; i < 8; ++i) {
      try {
        renderer_->submit(next(i == 3 ? broken : sound));
      } catch (const std::exception&) {
        ++lost;
      }
    }
    renderer_->drain();
    EXPECT_EQ(lost, 1);
    ASSERT_EQ(deliveries_.size(), 7u);
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_EQ(deliveries_[i].number - deliveries_[0].number, i < 3 ? i : i + 1);
  }
}

TEST_P(RendererTest, MayEndWithFramesInFlight) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const FrameRequest request = this->request(scene, settings_for(scene), {320, 240});
  for (int frames = 1; frames <= 3; ++frames) {
    Renderer renderer(*engine_, {});
    for (int i = 0; i < frames; ++i) {
      FrameRequest moved = next(request);
      moved.view.camera.eye.x += 0.1f * static_cast<float>(i);
      renderer.submit(moved);
    }
  }
}

TEST_P(RendererTest, Design2IsOneFrameLate) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const FrameRequest request = this->request(scene, settings_for(scene, by({{"design", "2"}})), {96, 64});
  for (int i = 0; i < 6; ++i) {
    renderer_->submit(next(request));
    EXPECT_EQ(deliveries_.size(), static_cast<std::size_t>(i));
  }
  renderer_->drain();
  ASSERT_EQ(records_.size(), 6u);
  EXPECT_EQ(records_[0].latency_frames, 1);
}

TEST_P(RendererTest, WhatNeedsNoCpuIsDeliveredAtOnce) {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({1, 5, 1}, false)};
  renderer_->submit(next(request(scene, settings_for(scene), {32, 24})));
  ASSERT_EQ(deliveries_.size(), 1u);
  EXPECT_EQ(deliveries_[0].latency, 0);
  renderer_->drain();
  EXPECT_EQ(records_[0].bytes_to_cpu() + records_[0].bytes_to_gpu(), 0u);
}

TEST_P(RendererTest, SinksMayBeLeftOut) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  for (const Settings& way : {by({{"mode", "hybrid"}}), by({{"design", "2"}}), by({{"mode", "raytrace"}}),
                              by({{"mode", "raster"}})})
    for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
      Settings wanted = way;
      if (exchange == Exchange::reproject && wanted.composite == Processor::cpu) continue;
      wanted.exchange = exchange;
      FrameRequest request = this->request(scene, settings_for(scene, wanted), {48, 32});
      std::size_t frames = 0, records = 0;
      const auto frame = [&](Frame&) { ++frames; };
      const auto record = [&](const FrameRecord&) { ++records; };
      for (const FrameSinks& sinks : {FrameSinks{}, FrameSinks{frame, {}}, FrameSinks{{}, record}}) {
        Renderer renderer(*engine_, sinks);
        for (int i = 0; i < 6; ++i) {
          if (i != 4) request.view.camera.eye.x += 1e-3f;  // once the same again
          renderer.submit(request);
        }
        renderer.drain();
      }
      EXPECT_EQ(frames, 6u);
      EXPECT_EQ(records, 6u);
    }
}

// The tracing thread waits from here until it is let go, so that no frame is done before it is asked for.
class HeldTracing {
 public:
  explicit HeldTracing(Engine& engine)
      : held_(engine.parts().tracing.post([go = go_.get_future().share()] { go.wait(); })) {}
  ~HeldTracing() {
    go_.set_value();
    held_.wait();
  }
  HeldTracing(const HeldTracing&) = delete;
  HeldTracing& operator=(const HeldTracing&) = delete;

 private:
  std::promise<void> go_;
  std::future<void> held_;
};

// A window's: nothing is begun while the CPU draws by itself, nothing is lost, and the order stays.
TEST_P(RendererTest, TryingNeverWaitsForTheCpu) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const FrameRequest alone = request(scene, settings_for(scene, by({{"mode", "raytrace"}})), {160, 120}),
                     hybrid = request(scene, settings_for(scene), {160, 120});
  EXPECT_FALSE(renderer_->is_tracing());
  const FrameRequest first = next(alone), second = next(alone);
  std::optional<HeldTracing> held(std::in_place, *engine_);
  ASSERT_TRUE(renderer_->try_submit(first));
  EXPECT_TRUE(renderer_->is_tracing());
  EXPECT_FALSE(renderer_->try_submit(second));
  EXPECT_TRUE(deliveries_.empty());
  std::size_t delivered = 0;
  for (const FrameRequest& request : {second, next(hybrid), next(alone)}) {
    held.reset();
    while (renderer_->is_tracing()) std::this_thread::yield();
    held.emplace(*engine_);
    EXPECT_TRUE(renderer_->try_submit(request));
    EXPECT_EQ(deliveries_.size(), ++delivered);  // what was in flight, and no more
  }
  held.reset();
  renderer_->submit(next(hybrid));  // who waits
  renderer_->drain();
  ASSERT_EQ(deliveries_.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(deliveries_[i].number, i);
  const std::vector<Delivery> tried = std::move(deliveries_);
  deliveries_.clear();
  renderer_->submit(first);
  renderer_->submit(second);
  ASSERT_EQ(deliveries_.size(), 2u);
  EXPECT_TRUE(same(deliveries_[0].color, tried[0].color));
  EXPECT_TRUE(same(deliveries_[1].color, tried[1].color));
}

// Frames of all kinds, one after another, by every exchange: each delivered once and in order, and the same
// however a window asks for it.
TEST_P(RendererTest, SchedulesMayFollowEachOther) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<Settings> ways{settings_for(scene), settings_for(scene, by({{"mode", "raytrace"}})),
                                   settings_for(scene, by({{"mode", "raster"}})),
                                   settings_for(scene, by({{"design", "2"}}))};
  std::vector<FrameRequest> requests;
  FrameRequest any = request(scene, ways[0], {40, 30});
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject})
    for (std::size_t i = 0; i < ways.size() * ways.size(); ++i)
      for (const std::size_t k : {i / ways.size(), i % ways.size()}) {
        if (exchange == Exchange::reproject && k == 3) continue;
        any.settings = ways[k];
        requests.push_back(next(any));
        requests.back().settings.exchange = exchange;
      }
  std::vector<Delivery> waited;
  for (const bool tries : {false, true}) {
    waited = std::move(deliveries_);
    deliveries_.clear();
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (tries && i % 3 != 0) {
        while (!renderer_->try_submit(requests[i])) std::this_thread::yield();
      } else {
        renderer_->submit(requests[i]);
      }
    }
    renderer_->drain();
    ASSERT_EQ(deliveries_.size(), requests.size());
    for (std::size_t i = 0; i < requests.size(); ++i) {
      EXPECT_EQ(deliveries_[i].number - deliveries_[0].number, i);
      for (const glm::vec4& c : deliveries_[i].color.pixels()) ASSERT_TRUE(c == c);
      if (tries && requests[i].settings.exchange != Exchange::reproject) {
        EXPECT_TRUE(same(deliveries_[i].color, waited[i].color)) << i;
      }
    }
  }
}

// The samples of a picture lie in other places of their pixels: each has its own answer.
TEST_P(RendererTest, SamplesOfAPictureAreNotReprojected) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  DrawRequest many{.settings = by({{"design", "1"}}), .size = {80, 60}};
  many.settings.spp = 4;
  many.settings.visibility = Processor::gpu;
  many.settings.exchange = Exchange::sync;
  const FrameResult truth = draw_one(scene, many);
  many.settings.exchange = Exchange::reproject;
  EXPECT_TRUE(same(draw_one(scene, many).color, truth.color));
}

// What the tracing thread answered for the CPU's own picture is not on the GPU to be warped.
TEST_P(RendererTest, ReprojectsNoAnswerThatTheCpuKept) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  FrameRequest alone = request(scene, settings_for(scene, by({{"mode", "raytrace"}})), {80, 60}),
               hybrid = request(scene, settings_for(scene), {80, 60});
  hybrid.settings.tiles = false;
  alone.settings.exchange = hybrid.settings.exchange = Exchange::reproject;
  hybrid.settings.id_bits = alone.settings.id_bits;
  renderer_->submit(alone);
  renderer_->submit(hybrid);
  renderer_->drain();
  hybrid.settings.exchange = Exchange::sync;
  renderer_->submit(hybrid);
  ASSERT_EQ(deliveries_.size(), 3u);
  EXPECT_TRUE(same(deliveries_[1].color, deliveries_[2].color));
}

// A slot keeps no buffer that its newest frame's settings do not use.
TEST_P(RendererTest, LetsGoOfWhatOtherSettingsNeeded) {
  constexpr glm::ivec2 kSize{40, 30};
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  std::vector<FrameRequest> requests;
  for (const auto& [option, value] : std::vector<std::pair<const char*, const char*>>{{"mode", "raytrace"},
                                                                                      {"plan", "slides"},
                                                                                      {"design", "2"},
                                                                                      {"mode", "raytrace"},
                                                                                      {"mode", "raster"}})
    for (int i = 0; i < kFramesInFlight; ++i) {
      requests.push_back(request(scene, settings_for(scene, by({{option, value}})), kSize));
      requests.back().view.camera.eye.x += 0.01f * static_cast<float>(i);
    }
  std::size_t delivered = 0;
  draw(requests, Exchange::sync, [&](Frame& frame) {
    (void)frame.texture();
    const FrameSlot& slot = frame.slot();
    const Settings& s = frame.request().settings;
    const bool alone = !s.uses_gpu(), packs = !alone && s.composite == Processor::cpu;
    EXPECT_EQ(slot.color.size() == kSize, alone);
    EXPECT_EQ(slot.shown.size() == kSize, alone);
    EXPECT_EQ(slot.picture.size() == kSize, !alone);
    EXPECT_EQ(slot.unpacked.size() == kSize, packs);
    EXPECT_EQ(slot[Channel::ids].target.size() == kSize, !alone);
    EXPECT_EQ(slot[Channel::phong].target.size() == kSize, packs);
    for (const Channel channel : {Channel::normals, Channel::gbuffer, Channel::phong}) {
      const bool travels =
          std::ranges::find(slot.layout, channel, &ChannelLayout::channel) != slot.layout.end();
      EXPECT_EQ(slot[channel].target.size() == kSize, travels);
    }
    ++delivered;
  });
  EXPECT_EQ(delivered, requests.size());
}

TEST_P(RendererTest, TwoRenderersShareAnEngine) {
  const Scene cornell = load_or_die(source_path("scenes/cornell")),
              lights = load_or_die(source_path("scenes/two-lights"));
  const FrameRequest a = request(cornell, settings_for(cornell), {96, 64}),
                     b = request(lights, settings_for(lights, by({{"design", "2"}})), {80, 60});
  std::vector<Image<glm::vec4>> other;
  Renderer second(*engine_, {[&](Frame& frame) { frame.read_color(other.emplace_back()); }, {}});
  std::vector<FrameRequest> of_first, of_second;
  for (int i = 0; i < 5; ++i) {
    renderer_->submit(of_first.emplace_back(next(a)));
    second.submit(of_second.emplace_back(next(b)));
  }
  second.drain();
  renderer_->drain();
  ASSERT_EQ(deliveries_.size(), 5u);
  ASSERT_EQ(other.size(), 5u);
  const std::vector<Delivery> shared = std::move(deliveries_);
  deliveries_.clear();
  for (const FrameRequest& r : of_first) renderer_->submit(r);
  for (const FrameRequest& r : of_second) renderer_->submit(r);
  renderer_->drain();
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(same(deliveries_[i].color, shared[i].color)) << i;
    EXPECT_TRUE(same(deliveries_[5 + i].color, other[i])) << i;
  }
}

}  // namespace
}  // namespace pinocchio
