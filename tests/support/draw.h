// Pictures by the renderer, for tests.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gl/open.h"
#include "hybrid/renderer.h"
#include "tests/support/scenes.h"

namespace pinocchio {

inline Camera first_camera(const Scene& scene) {
  return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
}

struct DrawRequest {
  Mode mode = Mode::hybrid;
  int design = 1;
  bool slides = false;
  glm::ivec2 size{320, 240};
  PixelBox part{};  // empty: whole
  Exchange exchange = Exchange::sync;
  gl::Mapping mapping = gl::Mapping::each_time;
  int threads = 2;
  int spp = 1;
  std::string backend = "egl";
  std::optional<Plan> plan{};  // instead of one made for the above
};

// One picture a camera.
inline std::vector<Picture> draw_all(const Scene& scene, const DrawRequest& request,
                                     const std::vector<Camera>& cameras,
                                     std::vector<FrameRecord>* records = nullptr) {
  Workers workers(request.threads);
  const Plan plan =
      request.plan ? *request.plan
                   : make_plan(take_census(scene),
                               {.mode = request.mode, .design = request.design, .slides = request.slides})
                         .value();
  const auto context = plan.mode == Mode::raytrace ? nullptr : gl::open_context({request.backend, "", true});
  const auto prepared =
      std::make_shared<const PreparedScene>(scene, sides_of(plan), BuildOptions{}, std::optional<Isa>());
  std::vector<Picture> pictures;
  {
    Renderer renderer(prepared, plan, workers, {request.exchange, request.mapping, request.spp},
                      {[&](Picture&& picture) { pictures.push_back(std::move(picture)); },
                       [&](const FrameRecord& record) {
                         if (records) records->push_back(record);
                       }});
    const PixelBox whole{{0, 0}, request.size};
    for (const Camera& camera : cameras)
      renderer.submit({camera, request.size, request.part.empty() ? whole : request.part});
    renderer.drain();
  }
  if (context) context->throw_complaints();
  return pictures;
}

inline Picture draw_one(const Scene& scene, const DrawRequest& request) {
  return std::move(draw_all(scene, request, {first_camera(scene)}).front());
}

inline bool same_pixels(const Picture& a, const Picture& b) {
  return std::ranges::equal(a.color.pixels(), b.color.pixels()) &&
         std::ranges::equal(a.ids.pixels(), b.ids.pixels()) &&
         std::ranges::equal(a.mask.bytes(), b.mask.bytes()) &&
         std::ranges::equal(a.reflection.pixels(), b.reflection.pixels());
}

}  // namespace pinocchio
