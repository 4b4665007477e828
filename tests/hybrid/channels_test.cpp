// What travels, to the byte: the table's numbers, and that frames keep to them.
#include "hybrid/exchange/channels.h"

#include "tests/support/frames.h"

namespace pinocchio {
namespace {

std::size_t bytes_of(const std::vector<ChannelLayout>& layout, Channel channel) {
  for (const ChannelLayout& c : layout)
    if (c.channel == channel) return c.most_bytes;
  return 0;
}

TEST(Channels, TheSlidesMoveTheirBytes) {
  for (const bool mirrors : {false, true}) {  // whatever the scene needs
    const SceneStats stats = analyze(plate_with_lights(1, 1, mirrors));
    const TrafficBytes one =
        traffic_of(*resolve(by({{"design", "1"}, {"plan", "slides"}}), stats), {800, 600});
    EXPECT_EQ(one.to_cpu, 2'880'000u);
    EXPECT_EQ(one.to_gpu, 1'920'000u);
    const TrafficBytes two =
        traffic_of(*resolve(by({{"design", "2"}, {"plan", "slides"}}), stats), {800, 600});
    EXPECT_EQ(two.to_cpu, 9'120'000u);
    EXPECT_EQ(two.to_gpu, 1'440'000u);
  }
}

TEST(Channels, WhatASceneDoesNotNeedIsNotSent) {
  const auto traffic = [](int casting, bool mirror) {
    return traffic_of(*resolve({}, analyze(plate_with_lights(casting, 1, mirror))), {800, 600});
  };
  EXPECT_EQ(traffic(0, false).to_cpu + traffic(0, false).to_gpu, 0u);
  EXPECT_EQ(traffic(1, false).to_gpu, 60'000u);  // one bit a pixel
  EXPECT_EQ(traffic(8, false).to_gpu, 480'000u);
  const std::size_t tiles = 100 * 75;  // of 8 x 8 pixels, each with four bytes to say where it is
  EXPECT_EQ(traffic(0, true).to_gpu, tiles * (4 + 8 * 8 * 6));  // half RGB, at most
  EXPECT_EQ(traffic(1, true).to_cpu, 960'000u);                 // 16-bit ids
}

TEST(Channels, OneProcessorAloneSendsNothing) {
  const SceneStats stats = analyze(plate_with_lights(1, 1, true));
  EXPECT_TRUE(channels_of(*resolve(by({{"mode", "raytrace"}}), stats), {800, 600}).empty());
  EXPECT_TRUE(channels_of(*resolve(by({{"mode", "raster"}}), stats), {800, 600}).empty());
}

class ChannelsTest : public FramesTest {
 protected:
  FrameRecord record_of(const Settings& settings, glm::ivec2 size) {
    request_.settings = settings;
    request_.view.size = size;
    FrameRecord record;
    Renderer renderer(*engine_, {{}, [&](const FrameRecord& of) { record = of; }});
    renderer.submit(request_);
    renderer.drain();
    return record;
  }
  // Every channel's bytes; of the reflection in tiles no more than those.
  void expect_as_in_the_table(const Settings& wanted, glm::ivec2 size) {
    const Settings settings = settings_for(scene_, wanted);
    const FrameRecord record = record_of(settings, size);
    const std::vector<ChannelLayout> layout = channels_of(settings, size);
    for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
      const auto channel = static_cast<Channel>(i);
      const std::size_t most = bytes_of(layout, channel);
      if (channel == Channel::reflection && settings.tiles) {
        EXPECT_LE(record[channel], most);
        EXPECT_GT(record[channel], 0u);
      } else {
        EXPECT_EQ(record[channel], most) << kChannelNames[i];
      }
    }
    const TrafficBytes most = traffic_of(settings, size);
    EXPECT_EQ(record.bytes_to_cpu(), most.to_cpu);
    EXPECT_LE(record.bytes_to_gpu(), most.to_gpu);
  }

  const Scene scene_ = load_or_die(source_path("scenes/cornell"));
  FrameRequest request_ = request(scene_, {}, {});
};
INSTANTIATE_TEST_SUITE_P(Backends, ChannelsTest, kBackends, backend_name);

TEST_P(ChannelsTest, FramesKeepToTheTable) {
  for (const Processor visibility : {Processor::cpu, Processor::gpu})
    for (const Processor composite : {Processor::cpu, Processor::gpu})
      for (const char* plan : {"auto", "slides"})
        for (const bool tiles : {false, true}) {
          if (tiles && composite == Processor::cpu) continue;  // no tiles are sent
          for (const ReflectionFormat format : {ReflectionFormat::rgb8, ReflectionFormat::rgb9e5,
                                                ReflectionFormat::half, ReflectionFormat::full}) {
            Settings wanted;
            wanted.visibility = visibility;
            wanted.composite = composite;
            ASSERT_TRUE(apply_preset("plan", plan, wanted));
            wanted.tiles = tiles;
            wanted.reflection = format;
            expect_as_in_the_table(wanted, {83, 61});
          }
        }
}

TEST_P(ChannelsTest, AtEveryScaleAndDepthOfId) {
  for (const int scale : {1, 2, 4})
    for (const int id_bits : {16, 24, 32}) {
      Settings wanted;
      wanted.mask_scale = wanted.reflection_scale = scale;
      wanted.id_bits = id_bits;
      expect_as_in_the_table(wanted, {83, 61});
    }
}

TEST_P(ChannelsTest, TheSlidesFramesToTheByte) {
  const auto drawn = [&](const char* design) {
    return record_of(settings_for(scene_, by({{"design", design}, {"plan", "slides"}})), {800, 600});
  };
  const FrameRecord one = drawn("1"), two = drawn("2");
  EXPECT_EQ(one.bytes_to_cpu(), 2'880'000u);
  EXPECT_EQ(one.bytes_to_gpu(), 1'920'000u);
  EXPECT_EQ(two.bytes_to_cpu(), 9'120'000u);
  EXPECT_EQ(two.bytes_to_gpu(), 1'440'000u);
}

}  // namespace
}  // namespace pinocchio
