// The pictures of a frame's buffers, against the buffers.
#include <map>
#include <set>

#include "core/image/tonemap.h"
#include "core/trace/aov.h"
#include "hybrid/inspect_pass.h"
#include "hybrid/raytrace.h"
#include "tests/support/frames.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{160, 120};
constexpr float kHalfStep = 0x1p-11f;  // relative
constexpr float kDark = 0.01f, kNothingAsked = 0.18f;

bool is_grey(const glm::vec4& color, float value) {
  return glm::all(glm::lessThan(glm::abs(glm::vec3(color) - value), glm::vec3(value * kHalfStep)));
}

class InspectTest : public FramesTest {
 protected:
  void SetUp() override {
    FramesTest::SetUp();
    pass_.emplace(programs_);
  }
  void TearDown() override {
    pass_.reset();
    FramesTest::TearDown();
  }
  // One frame of the scene, by that plan.
  void look_at(const Scene& scene, const Plan& plan, const std::function<void(Flight&)>& look) {
    draw({request(prepare(scene), plan, kSize)}, Exchange::sync, look);
  }
  Image<glm::vec4> view(const Flight& frame, BufferView what, int slot = 0) {
    return read(pass_->draw(frame, what, slot));
  }

  std::optional<InspectPass> pass_;
};
INSTANTIATE_TEST_SUITE_P(Backends, InspectTest, kBackends, backend_name);

TEST_P(InspectTest, IdsHaveAColourEach) {
  const Scene scene = load_or_die(source_path("scenes/speedboat"));
  for (const int id_bits : {16, 24, 32}) {
    Plan plan = plan_of(scene);
    plan.id_bits = id_bits;
    if (id_bits == 32) plan.primary = Primary::rays;
    look_at(scene, plan, [&](Flight& frame) {
      const Image<glm::vec4> picture = view(frame, BufferView::ids);
      std::map<std::uint32_t, glm::vec4> color_of;
      std::set<std::tuple<float, float, float>> colors;
      for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        if (frame.ids[i] == kNoTriangle) {
          ASSERT_TRUE(is_grey(picture[i], kDark));
          continue;
        }
        ASSERT_EQ(color_of.try_emplace(frame.ids[i], picture[i]).first->second, picture[i]);
        colors.emplace(picture[i].r, picture[i].g, picture[i].b);
      }
      EXPECT_GT(color_of.size(), 100u);
      EXPECT_GT(colors.size(), color_of.size() * 99 / 100);
    });
  }
}

TEST_P(InspectTest, NormalsAreTheTracers) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  look_at(scene, plan_of(scene), [&](Flight& frame) {
    const Image<glm::vec4> picture = view(frame, BufferView::normals);
    const Image<glm::vec3> n = surface_images(*scene.mesh, frame.view, workers_, frame.ids).n_shading;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
      if (frame.ids[i] == kNoTriangle) continue;
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(linear_to_srgb(picture[i][c]), 0.5f * n[i][c] + 0.5f, 0.002f);
    }
  });
}

// Counts white, black and grey pixels of a mask's picture while it holds them against the mask.
glm::ivec3 check_mask(const Image<glm::vec4>& picture, const Flight& frame, int slot) {
  glm::ivec3 count(0);
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) {
      const glm::vec4& color = picture.at(x, y);
      const bool white = color.g == 1.0f, black = color.g == 0.0f;
      EXPECT_TRUE(white || black || is_grey(color, kNothingAsked));
      EXPECT_EQ(white, (frame.mask.get(x, y) >> slot & 1u) != 0);
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
  for (const int design : {1, 2})
    look_at(scene, plan_of(scene, {.design = design}), [&](Flight& frame) {
      for (int slot = 0; slot < 2; ++slot) {
        const glm::ivec3 count = check_mask(view(frame, BufferView::mask, slot), frame, slot);
        for (int c = 0; c < 3; ++c) EXPECT_GT(count[c], 50) << design << " " << slot << " " << c;
      }
    });
}

TEST_P(InspectTest, ReflectionIsTheTracedLight) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  for (const int design : {1, 2})
    look_at(scene, plan_of(scene, {.design = design}), [&](Flight& frame) {
      const Image<glm::vec4> picture = view(frame, BufferView::reflection);
      float brightest = 0.0f;
      for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
        if (frame.ids[i] == kNoTriangle) continue;
        for (int c = 0; c < 3; ++c) {
          const float light = frame.reflection[i][c];
          ASSERT_NEAR(picture[i][c], light, 2.0f * kHalfStep * light + 1e-7f);
          brightest = std::max(brightest, light);
        }
      }
      EXPECT_GT(brightest, 0.1f);
    });
}

TEST_P(InspectTest, AtLowerResolutionsItShowsWhatTheCompositeReads) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Plan plan = plan_of(scene);
  plan.mask_scale = plan.reflection_scale = 2;
  plan.tiles = true;
  look_at(scene, plan, [&](Flight& frame) {
    const Image<glm::vec4> mask = view(frame, BufferView::mask), light = view(frame, BufferView::reflection);
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
  const auto prepared = prepare(scene);
  std::vector<FrameRequest> moving;
  for (int i = 0; i < 6; ++i) {
    moving.push_back(request(prepared, plan_of(scene), kSize));
    moving.back().camera.eye.x += 0.1f * static_cast<float>(i);
  }
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
    std::size_t aged = 0, holes = 0;
    draw(moving, exchange, [&](Flight& frame) {
      const Image<glm::vec4> age = view(frame, BufferView::age), picture = read(frame.picture.target);
      aged += frame.record.age_frames > 0;
      for (std::size_t i = 0; i < age.pixels().size(); ++i) {
        const bool hole = picture[i].a > 0.0f && picture[i].a < 1.0f;
        const glm::vec3 c(age[i]);
        if (picture[i].a == 0.0f) {
          ASSERT_TRUE(is_grey(age[i], kDark));
        } else if (hole) {
          ASSERT_TRUE(c.b > c.g && c.r > c.b);  // pink
        } else if (frame.record.age_frames == 0) {
          ASSERT_TRUE(c.g > c.r && c.g > c.b);  // green
        } else {
          ASSERT_TRUE(c.r > c.g && c.g >= c.b);  // yellow to red
        }
        holes += hole;
      }
      EXPECT_FALSE(legend(BufferView::age, 0, frame).empty());
    });
    EXPECT_EQ(aged > 0, exchange == Exchange::reproject);
    EXPECT_EQ(holes > 0, exchange == Exchange::reproject);
  }
}

TEST_P(InspectTest, OfAPictureByTheCpuAloneToo) {
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const auto prepared = prepare(scene);
  FrameRequest by_cpu = request(prepared, plan_of(scene, {.mode = Mode::raytrace}), kSize);
  Picture picture;
  (void)raytrace(by_cpu, workers_, picture);
  draw({request(prepared, plan_of(scene), kSize)}, Exchange::sync, [&](Flight& frame) {
    for (const BufferView what :
         {BufferView::ids, BufferView::normals, BufferView::mask, BufferView::reflection}) {
      const Image<glm::vec4> hybrid = view(frame, what), cpu = read(pass_->draw(by_cpu, picture, what, 0));
      std::size_t other = 0;
      for (std::size_t i = 0; i < hybrid.pixels().size(); ++i)
        other += glm::distance(hybrid[i], cpu[i]) > 0.002f * (1.0f + glm::length(hybrid[i]));
      EXPECT_LT(other, hybrid.pixels().size() / 200) << kBufferViewNames[static_cast<std::size_t>(what)];
    }
  });
  EXPECT_NE(missing(BufferView::age, 0, by_cpu.plan), "");
}

// A reprojected frame's mask is the older one's where its points were then: what the picture shows.
TEST_P(InspectTest, AReprojectedMaskFollowsThePicture) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  const std::vector<FrameRequest> still(4, request(prepare(scene), plan_of(scene), kSize));
  std::vector<FrameRequest> jittered = still;
  for (std::size_t i = 0; i < jittered.size(); ++i) jittered[i].jitter.x = 1e-4f * static_cast<float>(i);
  Image<glm::vec4> own;
  int delivered = 0;
  draw(jittered, Exchange::reproject, [&](Flight& frame) {
    const Image<glm::vec4> mask = view(frame, BufferView::mask);
    if (delivered++ == 0) own = mask;
    std::size_t other = 0;
    for (std::size_t i = 0; i < mask.pixels().size(); ++i) other += mask[i] != own[i];
    EXPECT_LT(other, mask.pixels().size() / 200);
  });
  EXPECT_EQ(delivered, 4);
}

TEST_P(InspectTest, WhatAPlanHasNotIsSaidAndGrey) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  look_at(scene, plan_of(scene, {.mode = Mode::raster}), [&](Flight& frame) {
    for (const BufferView what : {BufferView::mask, BufferView::reflection, BufferView::age}) {
      EXPECT_NE(missing(what, 0, frame.request.plan), "");
      const Image<glm::vec4> picture = view(frame, what);
      for (std::size_t i = 0; i < picture.pixels().size(); ++i)
        if (frame.ids.empty() || frame.ids[i] != kNoTriangle) {
          ASSERT_TRUE(is_grey(picture[i], kNothingAsked) || is_grey(picture[i], kDark));
        }
    }
    for (const BufferView what : {BufferView::picture, BufferView::ids, BufferView::normals})
      EXPECT_EQ(missing(what, 0, frame.request.plan), "");
    EXPECT_EQ(&pass_->draw(frame, BufferView::picture, 0), &frame.picture.target);
  });
  const Plan plan = plan_of(scene);
  EXPECT_EQ(missing(BufferView::mask, 0, plan), "");
  EXPECT_NE(missing(BufferView::mask, 1, plan), "");  // its other light does not cast
}

}  // namespace
}  // namespace pinocchio
