#include "pinocchio/exr.h"

#include <sys/resource.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>

#include "bench/one_ray/passes.h"
#include "core/image/codecs/exr_bands.h"
#include "core/output/frame_exr.h"
#include "core/trace/tiles/aov.h"
#include "core/trace/view/view_params.h"
#include "tests/support/layer_images.h"
#include "tests/support/own_file.h"
#include "tests/support/scenes.h"
#include "tests/support/shade.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kPartSize{40, 30};
constexpr PixelBox kPart{{8, 4}, {33, 21}};

std::filesystem::path temporary(const std::string& name) {
  return own_file(name);
}

// A small frame with everything in it, cropped.
ExrFile small_frame(const Scene& scene, const AovSet& aovs) {
  const Tracer tracer(scene.mesh);
  Workers workers(1);
  const TraceJob job{scene, tracer, workers,
                     view_params(scene.cameras.front(), kPartSize, glm::vec2(0.0f), kPart.lo)};
  LayerImages images{.ids = Image<std::uint32_t>(kPart.size())};
  trace_visibility(job, images.ids);
  trace_shadow_mask(job, images.ids, 2, images.mask);
  shade(job, images.ids, images.mask, images.reflection, images.color);
  images.surfaces = surface_images(*scene.mesh, job.view, images.ids, 0, kPart.size().y);
  return frame_exr({.size = kPartSize,
                    .part = kPart,
                    .scene = scene,
                    .camera = scene.cameras.front(),
                    .write_lines = [&](int, int, const FrameArrays& to) { images.write(to); },
                    .plan_json = "{\"p\":1}",
                    .render_s = 1.5},
                   aovs, 0, kPart.size().y);
}

Scene lit_scene() {
  Scene scene = plate_over_floor();
  scene.lights = {point_light({-4, 4, 0}), point_light({3, 5, 3})};
  scene.lights[0].name = "left";
  return scene;
}

struct Output {
  int status;
  std::string text;
};

Output run(const std::string& command) {
  std::string text;
  FILE* const pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), n);
  return {pclose(pipe), text};
}

TEST(Exr, ChannelsAndAttributesComeBack) {
  const Scene scene = lit_scene();
  const ExrFile written = small_frame(scene, *parse_aovs("all"));
  write_exr(temporary("frame.exr"), written);
  const Expected<ExrFile> read = read_exr(temporary("frame.exr"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->display_size, kPartSize);
  EXPECT_EQ(read->data_window, kPart);
  EXPECT_EQ(read->channels.size(), 19u);
  for (const ExrChannel& channel : written.channels) {
    const ExrChannel* back = read->find(channel.name);
    ASSERT_NE(back, nullptr) << channel.name;
    EXPECT_EQ(back->type, channel.type) << channel.name;
    if (channel.type != ExrChannel::Type::half) {
      EXPECT_EQ(back->values, channel.values) << channel.name;
    }
    EXPECT_EQ(back->uints, channel.uints) << channel.name;
  }
  EXPECT_EQ(std::get<std::string>(read->attributes.at("pinocchio.plan")), "{\"p\":1}");
  EXPECT_EQ(std::get<float>(read->attributes.at("renderTimeSeconds")), 1.5f);
  EXPECT_EQ(std::get<glm::mat4>(read->attributes.at("worldToNDC")),
            world_to_ndc(scene.cameras.front(), kPartSize));
  EXPECT_NE(std::get<std::string>(read->attributes.at("pinocchio.lights")).find("\"left\""),
            std::string::npos);
}

TEST(Exr, WhereNothingIsHit) {
  Scene scene = lit_scene();
  scene.cameras[0].target = {0, 90, 0};  // the sky
  const ExrFile exr = small_frame(scene, *parse_aovs("all"));
  EXPECT_EQ(exr.find("Z")->values[0], kInfinity);
  EXPECT_EQ(exr.find("id.triangle")->uints[0], 0xffffffffu);
  EXPECT_EQ(exr.find("shadow.mask")->uints[0], 0u);
  EXPECT_EQ(exr.find("A")->values[0], 0.0f);
}

TEST(Exr, PositionsDistancesAndMatricesAgree) {
  const Scene scene = lit_scene();
  const ExrFile exr = small_frame(scene, *parse_aovs("all"));
  const glm::mat4 to_camera = world_to_camera(scene.cameras.front()),
                  to_ndc = world_to_ndc(scene.cameras.front(), kPartSize);
  for (int y = 0; y < kPart.size().y; ++y)
    for (int x = 0; x < kPart.size().x; ++x) {
      const auto i = static_cast<std::size_t>(y * kPart.size().x + x);
      if (exr.find("id.triangle")->uints[i] == kNoTriangle) continue;
      const glm::vec4 p(exr.find("P.X")->values[i], exr.find("P.Y")->values[i], exr.find("P.Z")->values[i],
                        1.0f);
      EXPECT_NEAR((to_camera * p).z, exr.find("Z")->values[i], 1e-4f);  // left-handed: in front is positive
      const glm::vec4 ndc = to_ndc * p;
      EXPECT_NEAR(ndc.x / ndc.w * kPartSize.x, static_cast<float>(kPart.lo.x + x) + 0.5f, 1e-3f);
      EXPECT_NEAR(ndc.y / ndc.w * kPartSize.y, static_cast<float>(kPart.lo.y + y) + 0.5f, 1e-3f);
    }
}

TEST(Exr, OpenExrsOwnToolsReadIt) {
  const std::filesystem::path file = temporary("tools.exr");
  write_exr(file, small_frame(lit_scene(), *parse_aovs("all")));
  for (const std::string& tool :
       {std::string("exrheader "), std::string("exrinfo -v "), std::string("oiiotool --info -v ")}) {
    if (run("command -v " + tool.substr(0, tool.find(' '))).status != 0)
      GTEST_SKIP() << tool << "is not installed";
    const Output output = run(tool + file.string());
    // Debian 12's exrinfo leaves its exit status to chance, with any file.
    if (tool.rfind("exrinfo", 0) != 0) {
      EXPECT_EQ(output.status, 0) << output.text;
    }
    EXPECT_NE(output.text.find("id.triangle"), std::string::npos) << output.text;
    EXPECT_EQ(output.text.find("rror"), std::string::npos) << output.text;
  }
}

// Values of all kinds in 37 lines: some packings are shorter than the lines, noise is not.
ExrFile noisy(ExrCompression compression) {
  ExrFile exr;
  exr.display_size = {19, 40};
  exr.data_window = {{2, 1}, {19, 38}};
  exr.compression = compression;
  exr.channels = {{"noise", ExrChannel::Type::uint, {}, {}},
                  {"half", ExrChannel::Type::half, {}, {}},
                  {"flat", ExrChannel::Type::real, {}, {}}};
  std::uint32_t random = 1;
  for (int i = 0; i < 17 * 37; ++i) {
    exr.channels[0].uints.push_back(random = random * 1664525u + 1013904223u);
    exr.channels[1].values.push_back(static_cast<float>(i % 17) * 0.25f);
    exr.channels[2].values.push_back(3.0f);
  }
  return exr;
}

TEST(Exr, EveryPackingIsWithoutLossAndForAnyNumberOfThreads) {
  for (std::size_t c = 0; c < kExrCompressionNames.size(); ++c) {
    const ExrFile exr = noisy(static_cast<ExrCompression>(c));
    const std::filesystem::path one = temporary("one.exr"), many = temporary("many.exr");
    write_exr(one, exr);
    const Expected<ExrFile> read = read_exr(one);
    ASSERT_TRUE(read) << kExrCompressionNames[c] << ": " << read.error().message();
    for (const ExrChannel& channel : exr.channels) {
      EXPECT_EQ(read->find(channel.name)->values, channel.values) << kExrCompressionNames[c];
      EXPECT_EQ(read->find(channel.name)->uints, channel.uints) << kExrCompressionNames[c];
    }
    EXPECT_EQ(read->compression, exr.compression);
    Workers workers(4);
    write_exr(many, exr, workers, [&](int y0, int y1) {
      std::vector<ExrChannel> lines;
      for (const ExrChannel& from : exr.channels) {
        ExrChannel& to = lines.emplace_back(from.name, from.type);
        for (std::size_t i = static_cast<std::size_t>(17 * y0); i < static_cast<std::size_t>(17 * y1); ++i)
          from.uints.empty() ? to.values.push_back(from.values[i]) : to.uints.push_back(from.uints[i]);
      }
      return lines;
    });
    EXPECT_EQ(run("cmp " + one.string() + " " + many.string()).status, 0) << kExrCompressionNames[c];
  }
}

TEST(Exr, WhatIsNoExrIsAnErrorThatNamesIt) {
  std::ofstream(temporary("no.exr")) << "this is text";
  EXPECT_NE(read_exr(temporary("no.exr")).error().message().find("no.exr"), std::string::npos);
  EXPECT_FALSE(read_exr(temporary("nowhere.exr")));
  write_exr(temporary("cut.exr"), small_frame(lit_scene(), {}));
  std::filesystem::resize_file(temporary("cut.exr"), std::filesystem::file_size(temporary("cut.exr")) / 2);
  EXPECT_FALSE(read_exr(temporary("cut.exr")));
}

// One channel of 64 x 48 that packs well: its last bytes wait in a buffer until the file is closed.
ExrFile ramp() {
  ExrFile exr;
  exr.display_size = {64, 48};
  exr.data_window = {{0, 0}, {64, 48}};
  exr.channels = {{"id", ExrChannel::Type::uint, {}, {}}};
  for (std::uint32_t i = 0; i < 64 * 48; ++i) exr.channels[0].uints.push_back(i);
  return exr;
}

// No file of this process grows beyond `bytes`, as on a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(std::uintmax_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(Exr, AFullDiskIsNeverSilentAndKeepsTheOldFile) {
  const std::filesystem::path file = temporary("full.exr");
  write_exr(file, ramp());
  const std::uintmax_t whole = std::filesystem::file_size(file);
  for (std::uintmax_t bytes = 1; bytes < whole; bytes += 7) {
    bool thrown = false;
    {
      const FullDisk disk(bytes);
      try {
        write_exr(file, ramp());
      } catch (const EnvironmentError&) {
        thrown = true;
      }
    }
    ASSERT_TRUE(thrown) << bytes << " of " << whole << " bytes fit";
    ASSERT_EQ(std::filesystem::file_size(file), whole);
  }
  EXPECT_TRUE(read_exr(file));
}

TEST(Exr, AHeaderOfMorePixelsThanTheFileHoldsIsAnError) {
  write_exr(temporary("bomb.exr"), ramp());
  std::ifstream in(temporary("bomb.exr"), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::array<std::int32_t, 4> window{0, 0, 199999, 199999};
  for (const std::string name : {"dataWindow", "displayWindow"}) {
    const std::size_t type = bytes.find("box2i", bytes.find(name));
    ASSERT_NE(type, std::string::npos);
    std::memcpy(&bytes[type + 6 + 4], window.data(), sizeof(window));  // after the type's 0 and the size
  }
  bytes.append(200000, '\0');  // room for the table of 12500 chunks
  std::ofstream(temporary("bomb.exr"), std::ios::binary) << bytes;
  const Expected<ExrFile> read = read_exr(temporary("bomb.exr"));
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message().find("more pixels"), std::string::npos) << read.error().message();
}

TEST(Exr, HugeValuesStayFiniteInHalf) {
  ExrFile exr;
  exr.display_size = {2, 1};
  exr.data_window = {{0, 0}, {2, 1}};
  exr.channels = {{"R", ExrChannel::Type::half, {1e9f, kInfinity}, {}}};
  write_exr(temporary("huge.exr"), exr);
  const Expected<ExrFile> read = read_exr(temporary("huge.exr"));
  EXPECT_EQ(read->channels[0].values, (std::vector<float>{65504.0f, kInfinity}));
}

TEST(Aovs, AreChosenByName) {
  EXPECT_EQ(parse_aovs("Z,id.triangle")->size(), 2u);
  EXPECT_TRUE(parse_aovs("none")->empty());
  EXPECT_FALSE(parse_aovs("Z,depth"));
  EXPECT_FALSE(parse_aovs("id.bogus"));
  EXPECT_EQ(*parse_aovs("P.X,reflection.G"), (AovSet{"P", "reflection"}));
  EXPECT_EQ(small_frame(lit_scene(), *parse_aovs("Z")).channels.size(), 5u);
}

}  // namespace
}  // namespace pinocchio
