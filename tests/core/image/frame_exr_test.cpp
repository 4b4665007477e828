#include "core/output/frame_exr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <type_traits>
#include <variant>

#include "core/trace/view/view_params.h"
#include "pinocchio/ray.h"
#include "tests/support/layer_images.h"
#include "tests/support/own_file.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kFrameSize{4, 3};
constexpr std::size_t kPixels = 12;

// A camera that no axis of the world lines up with.
Camera slanted_camera() {
  Camera camera;
  camera.eye = {3.0f, 2.0f, -4.0f};
  camera.target = {-1.0f, 0.5f, 2.0f};
  camera.fov_deg = 50.0f;
  return camera;
}

// x and y across the picture.
glm::vec2 ndc_of(const Camera& camera, const glm::vec3& p_world) {
  const glm::vec4 p = world_to_ndc(camera, kFrameSize) * glm::vec4(p_world, 1.0f);
  return glm::vec2(p) / p.w;
}

void expect_near(const glm::vec2& a, const glm::vec2& b) {
  EXPECT_NEAR(a.x, b.x, 1e-5f);
  EXPECT_NEAR(a.y, b.y, 1e-5f);
}

// Where the ray of a pixel's centre says: also of a camera whose axis is off the centre, its pixels not
// square.
TEST(FrameExr, NdcOfAMeasuredCameraIsItsPixels) {
  const Camera camera = with_intrinsics(slanted_camera(), {3.0, 3.5, 1.25, 0.5}, kFrameSize);
  const shared::ViewParams view = view_params(camera, kFrameSize);
  for (const glm::ivec2 pixel : {glm::ivec2(0, 0), glm::ivec2(3, 2), glm::ivec2(1, 2)}) {
    const glm::vec3 point = view.eye + 2.5f * pixel_ray(view, pixel.x, pixel.y).direction;
    expect_near(ndc_of(camera, point), (glm::vec2(pixel) + 0.5f) / glm::vec2(kFrameSize));
  }
}

// What a frame of 4 x 3 is made of, by hand: triangle i in pixel i, nothing in the last.
struct HandMade {
  Scene scene;
  Camera camera = slanted_camera();
  LayerImages images{
      .color = Image<glm::vec4>(kFrameSize, glm::vec4(0.25f, 0.5f, 2.0f, 1.0f)),
      .ids = Image<std::uint32_t>(kFrameSize),
      .mask = MaskImage(kFrameSize, 2),
      .reflection = {},
      .surfaces = {Image<float>(kFrameSize, 1.0f), Image<glm::vec3>(kFrameSize, glm::vec3(1, 2, 3)),
                   Image<glm::vec3>(kFrameSize, glm::vec3(0, 1, 0)),
                   Image<glm::vec3>(kFrameSize, glm::vec3(0.5f))}};

  HandMade() {
    for (std::size_t i = 0; i < images.ids.pixels().size(); ++i)
      images.ids[i] = static_cast<std::uint32_t>(i);
    images.ids.at(3, 2) = 0xffffffffu;
    images.surfaces.z_eye.at(3, 2) = kInfinity;
    images.mask.set_bit(1, 0, 0);
    images.mask.set_bit(2, 1, 1);
  }
  [[nodiscard]] ExrFile exr(std::optional<double> render_s) const {
    return exr(*parse_aovs("all"), render_s, [this](int, int, const FrameArrays& to) { images.write(to); });
  }
  [[nodiscard]] ExrFile exr(const AovSet& aovs, std::optional<double> render_s,
                            std::function<void(int, int, const FrameArrays&)> write_lines) const {
    return frame_exr({.size = kFrameSize,
                      .part = {{0, 0}, kFrameSize},
                      .scene = scene,
                      .camera = camera,
                      .write_lines = std::move(write_lines),
                      .plan_json = "{}",
                      .render_s = render_s},
                     aovs, 0, kFrameSize.y);
  }
};

// Component c of pixel i, in every layer; halves hold it.
float number(std::size_t i, int c) {
  return static_cast<float>(i) + 16.0f * static_cast<float>(c);
}

// Writes number() to all arrays that are wanted.
void write_numbers(const FrameArrays& to) {
  for (const LayerRow& row : kLayers)
    std::visit(
        [&](auto member) {
          if constexpr (!std::is_same_v<decltype(member), std::monostate>) {
            using Pixel = std::remove_pointer_t<std::remove_reference_t<decltype(FrameArrays{}.*member)>>;
            for (std::size_t i = 0; to.*member && i < kPixels; ++i) {
              if constexpr (std::is_arithmetic_v<Pixel>)
                (to.*member)[i] = static_cast<Pixel>(number(i, 0));
              else
                for (int c = 0; c < Pixel::length(); ++c) (to.*member)[i][c] = number(i, c);
            }
          }
        },
        row.array.values);
}

// Every layer of the table by itself: what its array holds is in the file, and nothing else but the colour.
TEST(FrameExr, HoldsEachLayerOfTheTable) {
  for (const LayerRow& row : kLayers) {
    if (row.exr.channels.front().empty()) continue;
    const AovSet aovs = row.exr.name.empty() ? AovSet{} : AovSet{std::string(row.exr.name)};
    const std::filesystem::path file = own_file("layer.exr");
    write_exr(file, HandMade().exr(aovs, {}, [](int, int, const FrameArrays& to) { write_numbers(to); }));
    const ExrFile back = read_exr(file).value();
    int components = 0;
    for (const std::string_view name : row.exr.channels) {
      if (name.empty()) break;
      const ExrChannel* const channel = back.find(std::string(name));
      ASSERT_NE(channel, nullptr) << name;
      EXPECT_EQ(channel->type, row.exr.type) << name;
      ASSERT_EQ(channel->values.size() + channel->uints.size(), kPixels) << name;
      for (std::size_t i = 0; i < kPixels; ++i)
        EXPECT_EQ(row.exr.type == ExrChannel::Type::uint ? static_cast<float>(channel->uints[i])
                                                         : channel->values[i],
                  number(i, components))
            << name;
      ++components;
    }
    EXPECT_EQ(back.channels.size(), row.exr.name.empty() ? 4u : 4u + static_cast<std::size_t>(components));
  }
}

TEST(Layers, EachHasOneRowAndIsFoundByItsNames) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kLayers.size(); ++i) {
    const LayerRow& row = kLayers[i];
    EXPECT_EQ(static_cast<std::size_t>(row.layer), i);
    EXPECT_EQ(row.array.name.empty(), std::holds_alternative<std::monostate>(row.array.values));
    EXPECT_EQ(row.array.name.empty(), row.array.doc.empty());
    EXPECT_EQ(row.window.name.empty(), row.window.legend.empty());
    EXPECT_EQ(row.window.name.empty(), row.layer >= Layer::objects);  // the window shows those before it
    if (row.exr.name.empty()) continue;
    EXPECT_TRUE(names.insert(row.exr.name).second) << row.exr.name;
    const AovSet alone{std::string(row.exr.name)};
    EXPECT_EQ(*parse_aovs(std::string(row.exr.name)), alone);
    for (const std::string_view channel : row.exr.channels)
      if (!channel.empty()) {
        EXPECT_EQ(*parse_aovs(std::string(channel)), alone);
      }
    EXPECT_NE(parse_aovs("all")->contains(std::string(row.exr.name)), row.exr.by_name_only);
    EXPECT_TRUE(parse_aovs("all," + std::string(row.exr.name))->contains(std::string(row.exr.name)));
    EXPECT_NE(parse_aovs("bogus").error().message().find(std::string(row.exr.name)), std::string::npos);
  }
}

TEST(FrameExr, HoldsEachChannelInItsType) {
  const ExrFile exr = HandMade().exr({});
  const auto expect_type = [&exr](const std::vector<std::string>& names, ExrChannel::Type type) {
    for (const std::string& name : names) {
      const ExrChannel* channel = exr.find(name);
      ASSERT_NE(channel, nullptr) << name;
      EXPECT_EQ(channel->type, type) << name;
      EXPECT_EQ(channel->values.size() + channel->uints.size(), 12u) << name;
    }
  };
  expect_type({"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Albedo.R", "Albedo.G", "Albedo.B", "reflection.R",
               "reflection.G", "reflection.B"},
              ExrChannel::Type::half);
  expect_type({"Z", "P.X", "P.Y", "P.Z"}, ExrChannel::Type::real);
  expect_type({"id.triangle", "shadow.mask"}, ExrChannel::Type::uint);
  EXPECT_EQ(exr.channels.size(), 19u);
}

TEST(FrameExr, HoldsWhatEachPixelIs) {
  const ExrFile exr = HandMade().exr({});
  EXPECT_EQ(exr.find("B")->values[5], 2.0f);
  EXPECT_EQ(exr.find("P.Y")->values[5], 2.0f);
  EXPECT_EQ(exr.find("N.Y")->values[5], 1.0f);
  EXPECT_EQ(exr.find("id.triangle")->uints[5], 5u);
  EXPECT_EQ(exr.find("id.triangle")->uints[11], 0xffffffffu);
  EXPECT_EQ(exr.find("Z")->values[11], kInfinity);
  EXPECT_EQ(exr.find("shadow.mask")->uints, (std::vector<std::uint32_t>{0, 1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0}));
  EXPECT_EQ(exr.find("reflection.G")->values, std::vector<float>(12, 0.0f));  // the plan has none
}

TEST(FrameExr, HasAMaskChannelForEach32CastingLights) {
  for (const int lights : {8, 9, 32, 33, 70}) {
    HandMade made;
    made.scene.lights.resize(static_cast<std::size_t>(lights));
    made.scene.lights.emplace_back().casts_shadow = false;
    made.images.mask = MaskImage(kFrameSize, MaskImage::bits_for(lights));
    made.images.mask.set_bit(2, 1, lights - 1);
    made.images.mask.set_bit(2, 1, 1);
    const ExrFile exr = made.exr({});
    std::vector<std::uint32_t> words;
    for (int k = 0;; ++k) {
      const ExrChannel* const channel = exr.find("shadow.mask" + (k == 0 ? "" : std::to_string(k)));
      if (!channel) break;
      EXPECT_EQ(channel->type, ExrChannel::Type::uint);
      words.push_back(channel->uints[6]);
    }
    std::vector<std::uint32_t> expected(static_cast<std::size_t>((lights + 31) / 32));
    expected.front() |= 2u;
    expected.back() |= 1u << (lights - 1) % 32;
    EXPECT_EQ(words, expected) << lights;
  }
  EXPECT_EQ(*parse_aovs("shadow.mask2"), *parse_aovs("shadow"));
  EXPECT_FALSE(parse_aovs("shadow.maskx"));
}

TEST(FrameExr, RenderTimeIsThereOnlyIfGiven) {
  EXPECT_EQ(HandMade().exr({}).attributes.count("renderTimeSeconds"), 0u);
  EXPECT_EQ(std::get<float>(HandMade().exr(2.5).attributes.at("renderTimeSeconds")), 2.5f);
}

TEST(FrameExr, CameraSpaceIsLeftHandedAndLooksAlongZ) {
  const Camera camera = slanted_camera();
  const CameraAxes axes = camera_axes(camera);
  const glm::mat4 to_camera = world_to_camera(camera);
  const auto expect_at = [&](const glm::vec3& p_world, const glm::vec3& expected) {
    const glm::vec4 p = to_camera * glm::vec4(p_world, 1.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(p[c], expected[c], 1e-5f);
  };
  expect_at(camera.eye, {0, 0, 0});
  expect_at(camera.eye + 2.0f * axes.forward, {0, 0, 2});
  expect_at(camera.eye + axes.right + axes.forward, {1, 0, 1});
  expect_at(camera.eye + axes.up + axes.forward, {0, 1, 1});
  EXPECT_LT(glm::determinant(glm::mat3(to_camera)), 0.0f);
}

TEST(FrameExr, NdcRunsFromTheTopLeftCornerToTheBottomRight) {
  const Camera camera = slanted_camera();
  const CameraAxes axes = camera_axes(camera);
  const float half_height = std::tan(glm::radians(camera.fov_deg) * 0.5f);
  const glm::vec3 up = axes.up * half_height,
                  right = axes.right *
                          (half_height * static_cast<float>(kFrameSize.x) / static_cast<float>(kFrameSize.y));
  for (const float z_eye : {0.5f, 1.0f, 40.0f}) {
    const auto ndc = [&](const glm::vec3& direction) {
      return ndc_of(camera, camera.eye + z_eye * direction);
    };
    expect_near(ndc(axes.forward), {0.5f, 0.5f});
    expect_near(ndc(axes.forward - right + up), {0.0f, 0.0f});
    expect_near(ndc(axes.forward + right + up), {1.0f, 0.0f});
    expect_near(ndc(axes.forward + right - up), {1.0f, 1.0f});
  }
}

TEST(FrameExr, NdcAgreesWithThePixelsRays) {
  const Camera camera = slanted_camera();
  const shared::ViewParams view = view_params(camera, kFrameSize);
  for (int y = 0; y < kFrameSize.y; ++y)
    for (int x = 0; x < kFrameSize.x; ++x) {
      const glm::vec2 pixel(static_cast<float>(x), static_cast<float>(y));
      const glm::vec3 p_world = view.eye + 7.0f * shared::pixel_direction(view, pixel);
      expect_near(ndc_of(camera, p_world), (pixel + 0.5f) / glm::vec2(kFrameSize));
    }
}

}  // namespace
}  // namespace pinocchio
