#include "bench/stability/picture_case.h"

#include <algorithm>
#include <array>
#include <memory>

#include "bench/stability/picture_scenes.h"
#include "core/math/finite.h"
#include "hybrid/renderer.h"

namespace pinocchio::stability {
namespace {

// Darker than this is black: every surface of these scenes sends a tenth of a colour that is at least 0.2.
constexpr float kBlack = 0.01f;

std::vector<Picture> draw(const Shot& shot, const Plan& plan, Exchange exchange, int side,
                          double* seconds = nullptr) {
  const auto prepared =
      std::make_shared<const PreparedScene>(shot.scene, sides_of(plan), BuildOptions{}, std::optional<Isa>());
  Workers workers;
  std::vector<Picture> pictures;
  Renderer renderer(
      prepared, plan, workers, {.exchange = exchange},
      {[&](Picture&& picture) { pictures.push_back(std::move(picture)); }, [](const FrameRecord&) {}});
  const double begin_s = now_s();
  for (const Camera& camera : shot.cameras)
    renderer.submit({camera, glm::ivec2(side), {{0, 0}, glm::ivec2(side)}});
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

void compare(const Picture& drawn, const Picture& traced, PictureFailureCount& count) {
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

PictureFailureCount run(const Shot& shot, const DrawMethod& method, int side) {
  const Needs needs = take_census(shot.scene);
  Plan plan = make_plan(needs, {.design = method.design}).value();
  plan.reuse = false;
  Plan ray_plan = make_plan(needs, {.mode = Mode::raytrace}).value();
  PictureFailureCount count;
  const std::vector<Picture> drawn = draw(shot, plan, method.exchange, side, &count.seconds);
  const std::vector<Picture> traced = draw(shot, ray_plan, Exchange::sync, side);
  for (std::size_t i = 0; i < drawn.size(); ++i) compare(drawn[i], traced[i], count);
  count.mean_error /= static_cast<double>(std::max<std::uint64_t>(count.trials, 1));
  return count;
}

template <Shot (*make)()>
PictureFailureCount run_shot(const DrawMethod& method, int side) {
  return run(make(), method, side);
}

constexpr std::array kCases{
    PictureStressCase{"grazing triangles", run_shot<grazing_triangles>},
    PictureStressCase{"sub-pixel triangles", run_shot<sub_pixel_triangles>},
    PictureStressCase{"near-plane clipping", run_shot<near_plane>},
    PictureStressCase{"z-fighting planes", run_shot<z_fighting>},
    PictureStressCase{"camera: fast turn", run_shot<fast_turn>},
    PictureStressCase{"camera: cut", run_shot<cut>},
    PictureStressCase{"camera: object edges", run_shot<object_edges>},
};

}  // namespace

std::vector<DrawMethod> all_draw_methods() {
  return {{"design 1, pipelined", 1, Exchange::pipelined},
          {"design 1, sync", 1, Exchange::sync},
          {"design 1, reproject", 1, Exchange::reproject},
          {"design 2, pipelined", 2, Exchange::pipelined}};
}

std::span<const PictureStressCase> picture_cases() {
  return kCases;
}

}  // namespace pinocchio::stability
