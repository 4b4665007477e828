// What a scene does not need is not traced, stored or sent, and the picture is as if it were.
#include <cmath>

#include "core/image/tonemap.h"
#include "hybrid/exchange/reflection_tiles.h"
#include "hybrid/settings/resolve.h"
#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr glm::ivec2 kSize{320, 240};

// Everything is modelled and sent whole, whatever the scene needs.
Settings full() {
  Settings s;
  s.id_bits = 32;
  s.mask_bits = 8;
  s.reflection = ReflectionFormat::half;
  s.depth = 8;
  s.reuse = false;
  s.threads = 2;
  return s;
}

Settings least(const Scene& scene, const Settings& wanted = {}, bool keeps_mask = false) {
  Settings s = resolve(wanted, analyze(scene), {.size = kSize, .keeps_mask = keeps_mask}).value();
  s.threads = 2;
  return s;
}

// A floor with a box on it, and a mirror that is a fraction of the picture's width and height.
Scene room(int casting, float mirror_share) {
  Scene scene = plate_over_floor();
  scene.cameras.clear();
  Camera camera;
  camera.eye = {0.0f, 6.0f, 6.0f};
  camera.target = {0.0f, 0.0f, 0.0f};
  scene.cameras.push_back(camera);
  for (int i = 0; i < casting; ++i)
    scene.lights.push_back(point_light({2.0f - 2.0f * static_cast<float>(i), 5.0f, 2.0f}));
  Light fill = point_light({0.0f, 8.0f, 3.0f}, false);
  fill.intensity = 0.3f;
  scene.lights.push_back(fill);
  if (mirror_share <= 0.0f) return scene;
  const CameraAxes axes = camera_axes(camera);
  MeshData mesh = *scene.mesh;
  // Something to see in it: a wall behind the camera.
  const glm::vec3 behind = camera.eye - 4.0f * axes.forward, wx = 40.0f * axes.right, wy = 40.0f * axes.up;
  add_triangle(mesh, behind - wx - wy, behind + wx - wy, behind + wx + wy);
  add_triangle(mesh, behind - wx - wy, behind + wx + wy, behind - wx + wy);
  const float half_height = std::tan(glm::radians(0.5f * camera.fov_deg)) * std::sqrt(mirror_share);
  const glm::vec3 x = axes.right * (half_height * 4.0f / 3.0f), y = axes.up * half_height;
  const glm::vec3 center = camera.eye + axes.forward;
  add_triangle(mesh, center - x - y, center + x - y, center + x + y);
  add_triangle(mesh, center - x - y, center + x + y, center - x + y);
  Material mirror;
  mirror.diffuse = mirror.ambient = glm::vec3(0.0f);
  mirror.reflectance = glm::vec3(0.9f);
  mesh.materials.push_back(mirror);
  for (std::size_t i = mesh.triangles.size() - 2; i < mesh.triangles.size(); ++i)
    mesh.triangle_materials[i] = static_cast<std::uint32_t>(mesh.materials.size() - 1);
  scene.mesh = std::make_shared<const Mesh>(std::move(mesh));
  return scene;
}

struct Drawn {
  FrameResult picture;
  FrameRecord record;
};

Drawn draw_by(const Scene& scene, Settings settings, Exchange exchange = Exchange::sync,
              glm::ivec2 size = kSize) {
  std::vector<FrameRecord> records;
  settings.exchange = exchange;
  const DrawRequest request{.size = size, .resolved = settings};
  std::vector<FrameResult> pictures = draw_all(scene, request, {first_camera(scene)}, &records);
  return {std::move(pictures.front()), records.front()};
}

// The greatest difference as a screen shows it, in steps of 8 bits.
double most_steps(const FrameResult& a, const FrameResult& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.color.pixels().size(); ++i)
    for (int c = 0; c < 3; ++c)
      most = std::max(most, 255.0 * std::abs(static_cast<double>(linear_to_srgb(a.color[i][c])) -
                                             static_cast<double>(linear_to_srgb(b.color[i][c]))));
  return most;
}

// The table of docs/measurements.md, "What a scene needs".
TEST(Economy, ASceneCostsWhatItNeedsAndThePictureIsTheWholes) {
  struct Row {
    const char* name;
    int casting;
    float mirror;
    std::size_t mask_bytes;
  };
  constexpr glm::ivec2 kLarge{800, 600};
  const std::size_t pixels = 800 * 600;
  for (const Row& row :
       {Row{"no casting light, no mirror", 0, 0.0f, 0}, Row{"one casting light", 1, 0.0f, pixels / 8},
        Row{"two casting lights", 2, 0.0f, pixels / 4}, Row{"three casting lights", 3, 0.0f, pixels / 2},
        Row{"a mirror on 5 % of the picture", 1, 0.05f, pixels / 8},
        Row{"a mirror on half of it, no casting light", 0, 0.5f, 0}}) {
    SCOPED_TRACE(row.name);
    const Scene scene = room(row.casting, row.mirror);
    const Drawn whole_one = draw_by(scene, full(), Exchange::sync, kLarge),
                least_one = draw_by(scene, least(scene), Exchange::sync, kLarge);
    const FrameRecord& r = least_one.record;
    std::printf("  %-42s %7zu up %7zu down, %6llu shadow %6llu reflection rays\n", row.name, r.bytes_to_cpu(),
                r.bytes_to_gpu(), static_cast<unsigned long long>(r.rays.shadow),
                static_cast<unsigned long long>(r.rays.reflection));
    EXPECT_LE(most_steps(whole_one.picture, least_one.picture), 0.5);
    EXPECT_EQ(r[Channel::mask], row.mask_bytes);
    if (row.casting == 0 && row.mirror == 0.0f) {
      EXPECT_EQ(r.bytes_to_cpu() + r.bytes_to_gpu(), 0u);
      EXPECT_EQ(r.rays.shadow + r.rays.reflection + r.rays.primary, 0u);
    }
    const double share = static_cast<double>(row.mirror);
    const double whole = static_cast<double>(pixels) * 6.0;
    EXPECT_LE(static_cast<double>(r[Channel::reflection]), 1.6 * share * whole + 0.01 * whole);
    EXPECT_LE(static_cast<double>(r.rays.reflection), 1.05 * share * static_cast<double>(pixels));
    EXPECT_GE(static_cast<double>(r.rays.reflection), 0.95 * share * static_cast<double>(pixels));
  }
}

TEST(Economy, TilesAreTheSamePixels) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    Settings settings = least(scene);
    settings.tiles = false;
    const Drawn whole = draw_by(scene, settings);
    settings.tiles = true;
    const Drawn tiles = draw_by(scene, settings);
    EXPECT_TRUE(same_pixels(whole.picture, tiles.picture)) << name;
    EXPECT_LT(tiles.record[Channel::reflection], 1.03 * whole.record[Channel::reflection]) << name;
  }
}

TEST(Economy, NoShadowRayForWhatHalfAStepDoesNotShow) {
  Scene scene = room(2, 0.0f);
  for (MeshEdit mesh(scene); Material & m : mesh->materials) m.diffuse = m.specular = glm::vec3(0.0f);
  Settings settings = least(scene);
  EXPECT_EQ(draw_by(scene, settings).record.rays.shadow, 0u);
  settings.light_cutoff = 0.0f;  // where the mask itself is wanted
  EXPECT_GT(draw_by(scene, settings).record.rays.shadow, 0u);
  for (const std::string& name : own_scenes()) {
    const Scene own = load_or_die(source_path(name));
    Settings every = least(own);
    const Drawn few = draw_by(own, every);
    every.light_cutoff = 0.0f;
    const Drawn all = draw_by(own, every);
    EXPECT_LE(few.record.rays.shadow, all.record.rays.shadow);
    EXPECT_LE(most_steps(few.picture, all.picture), 0.5) << name;
  }
}

TEST(Economy, FormatsKeepTheirPromise) {
  const Scene scene = load_or_die(source_path("scenes/speedboat.glb"));
  Settings settings = least(scene);
  settings.reflection = ReflectionFormat::full;
  const Drawn exact = draw_by(scene, settings);
  const auto steps_of = [&](ReflectionFormat format) {
    settings.reflection = format;
    return most_steps(draw_by(scene, settings).picture, exact.picture);
  };
  const double half = steps_of(ReflectionFormat::half), shared = steps_of(ReflectionFormat::rgb9e5),
               srgb = steps_of(ReflectionFormat::rgb8);
  std::printf("  steps of 255 off float: half %.3f, shared exponent %.3f, sRGB bytes %.3f\n", half, shared,
              srgb);
  EXPECT_LT(half, 0.25);
  EXPECT_LT(shared, 4.0);
  EXPECT_LT(srgb, 1.5);
}

TEST(Economy, FewerSamplesAreNearThePictureAndCostTheirShare) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    Settings settings = least(scene);
    const Drawn all = draw_by(scene, settings);
    double last = 0.0;
    for (const int scale : {2, 4}) {
      settings.mask_scale = settings.reflection_scale = scale;
      const Drawn few = draw_by(scene, settings);
      double sum = 0.0;
      for (std::size_t i = 0; i < few.picture.color.pixels().size(); ++i) {
        const glm::vec3 difference = glm::vec3(few.picture.color[i]) - glm::vec3(all.picture.color[i]);
        ASSERT_TRUE(difference == difference) << "NaN";
        sum += static_cast<double>(glm::length(difference));
      }
      const double mean = sum / static_cast<double>(few.picture.color.pixels().size());
      EXPECT_LT(mean, 0.05) << name << " " << scale;
      EXPECT_GT(mean, last) << name << " " << scale;
      last = mean;
      const double share = static_cast<double>(few.record.rays.shadow) /
                           static_cast<double>(std::max<std::uint64_t>(all.record.rays.shadow, 1));
      EXPECT_NEAR(share * scale * scale, 1.0, 0.1) << name << " " << scale;
      EXPECT_EQ(few.picture.mask.size(), kSize);
    }
  }
}

TEST(Economy, PrimaryRaysSeeWhatTheRaytracerSees) {
  for (const std::string& name : own_scenes()) {
    const Scene scene = load_or_die(source_path(name));
    Settings settings = least(scene);
    settings.visibility = Processor::cpu;
    const Drawn rays = draw_by(scene, settings);
    const FrameResult traced = draw_one(scene, {.settings = by({{"mode", "raytrace"}}), .size = kSize});
    EXPECT_TRUE(std::ranges::equal(rays.picture.ids.pixels(), traced.ids.pixels())) << name;
    EXPECT_LE(most_steps(rays.picture, traced), 0.5) << name;
    EXPECT_EQ(rays.record.bytes_to_cpu(), 0u);
    EXPECT_EQ(rays.record.rays.primary, 320u * 240u);
    const Drawn pipelined = draw_by(scene, settings, Exchange::pipelined);
    EXPECT_TRUE(same_pixels(pipelined.picture, rays.picture));
    EXPECT_TRUE(same_pixels(draw_by(scene, settings, Exchange::reproject).picture, rays.picture));
  }
}

TEST(Economy, AStillCameraCostsNoRays) {
  const Scene scene = load_or_die(source_path("scenes/two-lights"));
  std::vector<Camera> cameras(6, first_camera(scene));
  cameras.back().eye.x += 0.1f;  // and then it moves
  const auto draw = [&](Settings settings, Exchange exchange, std::vector<FrameRecord>* records = nullptr) {
    settings.exchange = exchange;
    return draw_all(scene, {.size = kSize, .resolved = settings}, cameras, records);
  };
  for (const Processor visibility : {Processor::gpu, Processor::cpu})
    for (const Processor composite : {Processor::gpu, Processor::cpu}) {
      Settings way;
      way.visibility = visibility;
      way.composite = composite;
      const Settings settings = least(scene, way, true);
      Settings anew = settings;
      anew.reuse = false;
      const std::vector<FrameResult> wanted = draw(anew, Exchange::sync);
      for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
        Settings asked = settings;
        asked.exchange = exchange;
        if (broken_rule(asked)) continue;  // design 2 sends nothing to warp
        std::vector<FrameRecord> records;
        const std::vector<FrameResult> pictures = draw(settings, exchange, &records);
        ASSERT_EQ(pictures.size(), cameras.size());
        ASSERT_EQ(records.size(), cameras.size());
        EXPECT_GT(records.front().rays.shadow, 0u);
        for (std::size_t i = 0; i < records.size(); ++i) {
          EXPECT_EQ(records[i].number, i);
          const bool moved = i == 0 || i + 1 == records.size();
          SCOPED_TRACE(std::string(name_of(kProcessorNames, visibility)) + " " +
                       std::string(name_of(kProcessorNames, composite)) + " " +
                       std::string(name_of(kExchangeNames, exchange)) + " " + std::to_string(i));
          if (!moved) {
            EXPECT_EQ(records[i].rays.primary + records[i].rays.shadow + records[i].rays.reflection, 0u);
            EXPECT_EQ(records[i].bytes_to_cpu() + records[i].bytes_to_gpu(), 0u);
          }
          if (!moved || exchange != Exchange::reproject) {
            EXPECT_TRUE(std::ranges::equal(pictures[i].color.pixels(), wanted[i].color.pixels()))
                << "another picture";
          }
        }
        EXPECT_FALSE(std::ranges::equal(pictures[4].color.pixels(), pictures[5].color.pixels()));
      }
    }
}

TEST(ReflectionTiles, OnlyThoseWithLight) {
  Workers workers(2);
  Image<glm::vec3> image(glm::ivec2(26, 10));  // 4 x 2 tiles, the last ones cut
  image.at(9, 3) = glm::vec3(1.0f, 2.0f, 3.0f);
  image.at(25, 9) = glm::vec3(0.5f);
  std::vector<std::uint32_t> index;
  std::vector<std::byte> bytes(most_tile_bytes(image.size(), ReflectionFormat::full));
  ASSERT_EQ(pack_tiles(image, {}, ReflectionFormat::full, workers, index, bytes), 2u);
  EXPECT_EQ(index, (std::vector<std::uint32_t>{kNoTile, 0, kNoTile, kNoTile, kNoTile, kNoTile, kNoTile, 1}));
  // Two tiles side by side in the texture's first, incomplete row.
  const std::span<const std::byte> sent_index = std::as_bytes(std::span(index));
  EXPECT_TRUE(std::equal(sent_index.begin(), sent_index.end(), bytes.begin()));
  const auto* light = reinterpret_cast<const glm::vec3*>(bytes.data() + sent_index.size());
  EXPECT_EQ(light[3 * 2 * kReflectionTile + 1], glm::vec3(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(light[1 * 2 * kReflectionTile + kReflectionTile + 1], glm::vec3(0.5f));
  const std::vector<std::uint8_t> black{1};  // of the tracer's one tile: the picture is not looked at
  EXPECT_EQ(pack_tiles(image, black, ReflectionFormat::full, workers, index, bytes), 0u);
}

}  // namespace
}  // namespace pinocchio
