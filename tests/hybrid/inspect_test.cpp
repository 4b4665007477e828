// The pictures of a frame's buffers, against the buffers.
#include <cmath>
#include <map>
#include <set>

#include "core/image/tonemap.h"
#include "core/trace/tiles/aov.h"
#include "hybrid/inspect/histogram_pass.h"
#include "hybrid/inspect/inspect_pass.h"
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kInspectedSize{160, 120};
constexpr float kHalfStep = 0x1p-11f;  // relative
constexpr float kDark = 0.01f, kNothingAsked = 0.18f;

bool is_grey(const glm::vec4& color, float value) {
  return glm::all(glm::lessThan(glm::abs(glm::vec3(color) - value), glm::vec3(value * kHalfStep)));
}

class InspectTest : public FramesTest {
 protected:
  void SetUp() override {
    FramesTest::SetUp();
    pass_.emplace(*engine_);
  }
  void TearDown() override {
    pass_.reset();
    FramesTest::TearDown();
  }
  // One frame of the scene, by these settings.
  void look_at(const Scene& scene, const Settings& settings, const std::function<void(Frame&)>& look) {
    draw({request(scene, settings, kInspectedSize)}, Exchange::sync, look);
  }
  Image<glm::vec4> view(const Frame& frame, Layer what, int slot = 0) {
    return read(pass_->draw(frame, what, slot));
  }

  std::optional<InspectPass> pass_;
};
INSTANTIATE_TEST_SUITE_P(Backends, InspectTest, kBackends, backend_name);

TEST_P(InspectTest, IdsHaveAColourEach) {
  const Scene scene = load_or_die(source_path("scenes/speedboat"));
  for (const int id_bits : {16, 24, 32}) {
    Settings settings = settings_for(scene);
    settings.id_bits = id_bits;
    if (id_bits == 32) settings.visibility = Processor::cpu;
    look_at(scene, settings, [&](Frame& frame) {
      const Image<std::uint32_t>& ids = frame.slot().ids;
      const Image<glm::vec4> picture = view(frame, Layer::ids);
      std::map<std::uint32_t, glm::vec4> color_of;
      std::set<std::tuple<float, float, float>> colors;
      for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        if (ids[i] == kNoTriangle) {
          ASSERT_TRUE(is_grey(picture[i], kDark));
          continue;
        }
        ASSERT_EQ(color_of.try_emplace(ids[i], picture[i]).first->second, picture[i]);
        colors.emplace(picture[i].r, picture[i].g, picture[i].b);
      }
      EXPECT_GT(color_of.size(), 100u);
      EXPECT_GT(colors.size(), color_of.size() * 99 / 100);
    });
  }
}

TEST_P(InspectTest, DepthPositionAndAlbedoAreTheTracersWithinTheirRange) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const Bounds box = scene.mesh->bounds();
  const ChannelRange near_far{glm::vec3(0.0f), glm::vec3(box.diagonal())}, sides{box.lo, box.hi};
  look_at(scene, settings_for(scene), [&](Frame& frame) {
    const FrameSlot& slot = frame.slot();
    const SurfaceImages surface = surface_images(*scene.mesh, slot.view, slot.ids, 0, slot.ids.height());
    const Image<glm::vec4> depth = read(pass_->draw(frame, Layer::depth, 0, near_far));
    const Image<glm::vec4> position = read(pass_->draw(frame, Layer::position, 0, sides));
    const Image<glm::vec4> albedo = view(frame, Layer::albedo);
    for (std::size_t i = 0; i < depth.pixels().size(); ++i) {
      if (slot.ids[i] == kNoTriangle) continue;
      ASSERT_NEAR(linear_to_srgb(depth[i].x), surface.z_eye[i] / box.diagonal(), 0.002f);
      const glm::vec3 share = (surface.p_world[i] - box.lo) / box.extent();
      for (int c = 0; c < 3; ++c) {
        ASSERT_NEAR(linear_to_srgb(position[i][c]), share[c], 0.002f);
        ASSERT_NEAR(albedo[i][c], surface.albedo[i][c], 0.002f);
      }
    }
    EXPECT_NE(legend(Layer::depth, 0, frame, near_far).find("black 0"), std::string::npos);
  });
}

TEST_P(InspectTest, ItsLightIsCountedAsThePictureHasIt) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  HistogramPass histogram(*engine_);
  look_at(scene, settings_for(scene), [&](Frame& frame) {
    const Image<glm::vec4> picture = read(frame.texture());
    histogram.start(frame.texture());
    const LightHistogram light = histogram.take();
    EXPECT_FALSE(histogram.started());
    EXPECT_EQ(light.pixels(), picture.pixels().size());
    std::size_t white = 0, black = 0;
    for (const glm::vec4& c : picture.pixels()) {
      const auto byte = linear_to_srgb8(4.0f * std::max({c.r, c.g, c.b}));
      white += byte == 255;
      black += byte == 0;
    }
    EXPECT_GT(white, 0u);
    EXPECT_EQ(light.shown_white(2.0f, ToneMap::clip), white);
    EXPECT_EQ(light.shown_black(2.0f, ToneMap::clip), black);
  });
}

TEST_P(InspectTest, NormalsAreTheTracers) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  Workers workers(2);
  look_at(scene, settings_for(scene), [&](Frame& frame) {
    const FrameSlot& slot = frame.slot();
    const Image<glm::vec4> picture = view(frame, Layer::normals);
    const Image<glm::vec3> n =
        surface_images(*scene.mesh, slot.view, slot.ids, 0, slot.ids.height()).n_shading;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
      if (slot.ids[i] == kNoTriangle) continue;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(linear_to_srgb(picture[i][c]), 0.5f * n[i][c] + 0.5f, 0.002f);
    }
  });
}

// Counts white, black and grey pixels of a mask's picture while it holds them against the mask.
glm::ivec3 check_mask(const Image<glm::vec4>& picture, const FrameSlot& frame, int slot) {
  glm::ivec3 count(0);
  for (int y = 0; y < kInspectedSize.y; ++y)
    for (int x = 0; x < kInspectedSize.x; ++x) {
      const glm::vec4& color = picture.at(x, y);
      const bool white = color.g == 1.0f, black = color.g == 0.0f;
      EXPECT_TRUE(white || black || is_grey(color, kNothingAsked));
      EXPECT_EQ(white, (frame.mask.get(x, y, slot / 32 * 32) >> slot % 32 & 1u) != 0);
      if (frame.ids.at(x, y) == kNoTriangle) {
        EXPECT_TRUE(is_grey(color, kNothingAsked));
      }
      ++count[white ? 0 : black ? 1 : 2];
    }
  return count;
}

TEST_P(InspectTest, MasksAreWhiteWhereLitBlackInShadowGreyWhereNotAsked) {
  Scene scene = load_or_die(source_path("scenes/two-lights"));
  for (Light& light : scene.lights) light.casts_shadow = true;
  for (const char* design : {"1", "2"})
    look_at(scene, settings_for(scene, by({{"design", design}})), [&](Frame& frame) {
      for (int slot = 0; slot < 2; ++slot) {
        const glm::ivec3 count = check_mask(view(frame, Layer::mask, slot), frame.slot(), slot);
        for (int c = 0; c < 3; ++c) EXPECT_GT(count[c], 50) << design << " " << slot << " " << c;
      }
    });
}

TEST_P(InspectTest, ReflectionIsTheTracedLight) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  for (const char* design : {"1", "2"})
    look_at(scene, settings_for(scene, by({{"design", design}})), [&](Frame& frame) {
      const Image<glm::vec4> picture = view(frame, Layer::reflection);
      float brightest = 0.0f;
      for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        if (frame.slot().ids[i] == kNoTriangle) continue;
        for (int c = 0; c < 3; ++c) {
          const float light = frame.slot().reflection[i][c];
          ASSERT_NEAR(picture[i][c], light, 2.0f * kHalfStep * light + 1e-7f);
          brightest = std::max(brightest, light);
        }
      }
      EXPECT_GT(brightest, 0.1f);
    });
}

TEST_P(InspectTest, AtLowerResolutionsItShowsWhatTheCompositeReads) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Settings settings = settings_for(scene);
  settings.mask_scale = settings.reflection_scale = 2;
  settings.tiles = true;
  look_at(scene, settings, [&](Frame& frame) {
    const Image<glm::vec4> mask = view(frame, Layer::mask), light = view(frame, Layer::reflection);
    bool half_lit = false;
    float brightest = 0.0f;
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) {
      half_lit = half_lit || (mask[i].g > 0.3f && mask[i].g < 0.7f);
      ASSERT_GE(mask[i].g, 0.0f);
      ASSERT_LE(mask[i].g, 1.0f);
      brightest = std::max(brightest, light[i].g);
    }
    EXPECT_TRUE(half_lit);
    EXPECT_GT(brightest, 0.1f);
  });
}

TEST_P(InspectTest, AgeIsFlatUnlessReprojectedAndThenTellsHoles) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  std::vector<FrameRequest> moving(6, request(scene, settings_for(scene), kInspectedSize));
  for (int i = 0; i < 6; ++i) {
    moving[static_cast<std::size_t>(i)].view.camera.eye.x += 0.1f * static_cast<float>(i);
  }
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
    std::size_t aged = 0, holes = 0;
    draw(moving, exchange, [&](Frame& frame) {
      const Image<glm::vec4> age = view(frame, Layer::delay), picture = read(frame.texture());
      aged += frame.record().age_frames > 0;
      for (std::size_t i = 0; i < age.pixels().size(); ++i) {
        const bool hole = picture[i].a > 0.0f && picture[i].a < 1.0f;
        const glm::vec3 c(age[i]);
        if (picture[i].a == 0.0f) {
          ASSERT_TRUE(is_grey(age[i], kDark));
        } else if (hole) {
          ASSERT_TRUE(c.b > c.g && c.r > c.b);  // pink
        } else if (frame.record().age_frames == 0) {
          ASSERT_TRUE(c.g > c.r && c.g > c.b);  // green
        } else {
          ASSERT_TRUE(c.r > c.g && c.g >= c.b);  // yellow to red
        }
        holes += hole;
      }
      EXPECT_FALSE(legend(Layer::delay, 0, frame).empty());
    });
    EXPECT_EQ(aged > 0, exchange == Exchange::reproject);
    EXPECT_EQ(holes > 0, exchange == Exchange::reproject);
  }
}

TEST_P(InspectTest, OfAPictureByTheCpuAloneToo) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Settings alone = settings_for(scene, by({{"mode", "raytrace"}}));
  std::map<Layer, Image<glm::vec4>> by_cpu;
  constexpr std::array kViews{Layer::ids, Layer::normals, Layer::mask, Layer::reflection, Layer::picture};
  look_at(scene, alone, [&](Frame& frame) {
    for (const Layer what : kViews) by_cpu[what] = view(frame, what);
  });
  look_at(scene, settings_for(scene), [&](Frame& frame) {
    for (const Layer what : kViews) {
      const Image<glm::vec4> hybrid = view(frame, what), &cpu = by_cpu[what];
      std::size_t other = 0;
      for (std::size_t i = 0; i < hybrid.pixels().size(); ++i)
        other += glm::distance(hybrid[i], cpu[i]) > 0.002f * (1.0f + glm::length(hybrid[i]));
      EXPECT_LT(other, hybrid.pixels().size() / 200) << layer_row(what).window.name;
    }
  });
  EXPECT_NE(missing(Layer::delay, 0, alone), "");
}

// Also slots that only the CPU has.
TEST_P(InspectTest, EverySlotOfManyLights) {
  Scene scene = plate_over_floor();
  for (int i = 0; i < 70; ++i)
    scene.lights.push_back(point_light({4.0f * std::cos(0.3f * static_cast<float>(i)), 5.0f,
                                        4.0f * std::sin(0.3f * static_cast<float>(i))}));
  for (const char* design : {"1", "2"})
    look_at(scene, settings_for(scene, by({{"design", design}})), [&](Frame& frame) {
      for (const int slot : {0, 9, 31, 32, 63, 64, 69}) {
        EXPECT_GT(check_mask(view(frame, Layer::mask, slot), frame.slot(), slot).x, 0) << slot;
        EXPECT_NE(legend(Layer::mask, slot, frame).find("slot " + std::to_string(slot)), std::string::npos);
      }
      EXPECT_NE(legend(Layer::mask, 70, frame).find("the mask has 70 slot(s)"), std::string::npos);
    });
}

// A reprojected frame's mask is the older one's where its points were then: what the picture shows.
TEST_P(InspectTest, AReprojectedMaskFollowsThePicture) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  std::vector<FrameRequest> jittered(4, request(scene, settings_for(scene), kInspectedSize));
  for (std::size_t i = 0; i < jittered.size(); ++i) jittered[i].view.jitter.x = 1e-4f * static_cast<float>(i);
  Image<glm::vec4> own;
  int delivered = 0;
  draw(jittered, Exchange::reproject, [&](Frame& frame) {
    const Image<glm::vec4> mask = view(frame, Layer::mask);
    if (delivered++ == 0) own = mask;
    std::size_t other = 0;
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) other += mask[i] != own[i];
    EXPECT_LT(other, mask.pixels().size() / 200);
  });
  EXPECT_EQ(delivered, 4);
}

TEST_P(InspectTest, WhatAFrameHasNotIsSaidAndGrey) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  look_at(scene, settings_for(scene, by({{"mode", "raster"}})), [&](Frame& frame) {
    const Image<std::uint32_t>& ids = frame.slot().ids;
    for (const Layer what : {Layer::mask, Layer::reflection, Layer::delay}) {
      EXPECT_NE(missing(what, 0, frame.request().settings), "");
      const Image<glm::vec4> picture = view(frame, what);
      for (std::size_t i = 0; i < picture.pixels().size(); ++i)
        if (ids.empty() || ids[i] != kNoTriangle) {
          ASSERT_TRUE(is_grey(picture[i], kNothingAsked) || is_grey(picture[i], kDark));
        }
    }
    for (const Layer what : {Layer::picture, Layer::ids, Layer::normals})
      EXPECT_EQ(missing(what, 0, frame.request().settings), "");
    EXPECT_EQ(&pass_->draw(frame, Layer::picture, 0), &frame.texture());
  });
  const Settings settings = settings_for(scene);
  EXPECT_EQ(missing(Layer::mask, 0, settings), "");
  EXPECT_NE(missing(Layer::mask, 1, settings), "");  // its other light does not cast
}

}  // namespace
}  // namespace pinocchio
