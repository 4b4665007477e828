#include "bench/stability/picture_case.h"

#include <algorithm>
#include <array>

#include "bench/stability/picture_scenes.h"
#include "core/base/clock.h"
#include "core/math/finite.h"

namespace pinocchio::stability {
namespace {

// Darker pixels count as black: every surface of these scenes reflects a tenth of a colour of at least 0.2.
constexpr float kBlack = 0.01f;

std::vector<FrameResult> draw(Engine& engine, const Shot& shot, const Settings& settings, int side,
                              double* seconds = nullptr) {
  std::vector<FrameResult> pictures;
  Renderer renderer(engine, {[&](Frame& frame) { pictures.push_back(frame.read()); }, {}});
  FrameRequest request{shot.scene, Engine::prepare(shot.scene, settings), settings, {}};
  const double begin_s = now_s();
  for (const Camera& camera : shot.cameras) {
    request.view = {camera, glm::ivec2(side)};
    renderer.submit(request);
  }
  renderer.drain();
  if (seconds) *seconds = now_s() - begin_s;
  return pictures;
}

bool is_lit(const glm::vec4& color) {
  return is_finite(glm::vec3(color)) && std::max({color.r, color.g, color.b}) >= kBlack;
}

double difference(const glm::vec4& a, const glm::vec4& b) {
  const glm::vec3 apart = glm::abs(glm::vec3(a) - glm::vec3(b));
  return static_cast<double>(std::max({apart.r, apart.g, apart.b}));
}

void compare(const FrameResult& drawn, const FrameResult& traced, PictureFailureCount& count) {
  for (std::size_t i = 0; i < drawn.color.pixels().size(); ++i) {
    ++count.trials;
    if (!is_lit(drawn.color[i])) {
      ++count.failures;
      continue;
    }
    const double error = difference(drawn.color[i], traced.color[i]);
    count.mean_error += error;
    if (drawn.ids[i] == traced.ids[i]) continue;
    ++count.other_ids;
    count.worst_there = std::max(count.worst_there, error);
  }
  count.holes += drawn.holes;
}

PictureFailureCount run(Engine& engine, const Shot& shot, const DrawMethod& method, int side) {
  Settings wanted, rays;
  wanted.visibility = Processor::gpu;
  wanted.composite = method.composite;
  wanted.exchange = method.exchange;
  wanted.reuse = false;
  rays.visibility = rays.composite = Processor::cpu;
  const auto resolved = [&](const Settings& s) {
    return engine.resolve(shot.scene, glm::ivec2(side), s).value();
  };
  PictureFailureCount count;
  const std::vector<FrameResult> drawn = draw(engine, shot, resolved(wanted), side, &count.seconds);
  const std::vector<FrameResult> traced = draw(engine, shot, resolved(rays), side);
  for (std::size_t i = 0; i < drawn.size(); ++i) compare(drawn[i], traced[i], count);
  count.mean_error /= static_cast<double>(std::max<std::uint64_t>(count.trials, 1));
  return count;
}

template <Shot (*make)()>
PictureFailureCount run_shot(Engine& engine, const DrawMethod& method, int side) {
  return run(engine, make(), method, side);
}

constexpr std::array kPictureCases{
    PictureStressCase{"grazing triangles", run_shot<grazing_triangles>},
    PictureStressCase{"sub-pixel triangles", run_shot<sub_pixel_triangles>},
    PictureStressCase{"near-plane clipping", run_shot<near_plane>},
    PictureStressCase{"leaves with holes", run_shot<foliage>},
    PictureStressCase{"z-fighting planes", run_shot<z_fighting>},
    PictureStressCase{"ball of light through a wall", run_shot<ball_touches_wall>},
    PictureStressCase{"ball of light around all", run_shot<ball_around_room>},
    PictureStressCase{"ball of light in a mesh", run_shot<ball_inside_mesh>},
    PictureStressCase{"rough mirrors, grazing panel", run_shot<rough_mirrors>},
    PictureStressCase{"camera: fast turn", run_shot<fast_turn>},
    PictureStressCase{"camera: cut", run_shot<cut>},
    PictureStressCase{"camera: object edges", run_shot<object_edges>},
};

}  // namespace

std::vector<DrawMethod> all_draw_methods() {
  return {{"design 1, pipelined", Processor::gpu, Exchange::pipelined},
          {"design 1, sync", Processor::gpu, Exchange::sync},
          {"design 1, reproject", Processor::gpu, Exchange::reproject},
          {"design 2, pipelined", Processor::cpu, Exchange::pipelined}};
}

std::span<const PictureStressCase> picture_cases() {
  return kPictureCases;
}

}  // namespace pinocchio::stability
