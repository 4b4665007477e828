// Pictures by the renderer, for tests.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hybrid/frame/samples.h"
#include "pinocchio/engine.h"
#include "tests/support/scenes.h"

namespace pinocchio {

inline Camera first_camera(const Scene& scene) {
  return scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
}

// Settings by presets, applied in this order: {{"mode", "raytrace"}}.
inline Settings by(std::initializer_list<std::pair<std::string_view, std::string_view>> presets) {
  Settings settings;
  for (const auto& [option, value] : presets)
    if (!apply_preset(option, value, settings)) throw std::logic_error("no such preset");
  return settings;
}

struct DrawRequest {
  Settings settings{};  // resolved for the scene; two threads where they name none
  glm::ivec2 size{320, 240};
  PixelBox part{};  // empty: whole
  std::string backend = "egl";
  std::optional<Settings> resolved{};  // instead of those: as they are
};

// The engine of a backend, made once in a process: making a context and its programs takes longer than
// drawing a small picture. It is never destroyed: when a process exits, Mesa is destroyed first.
inline Engine& engine_of(const std::string& backend) {
  static auto& engines = *new std::map<std::string, Engine>;
  return engines.try_emplace(backend, EngineOptions{.backend = backend, .gl_debug = true}).first->second;
}

// One picture a camera.
inline std::vector<FrameResult> draw_all(const Scene& scene, const DrawRequest& request,
                                         const std::vector<Camera>& cameras,
                                         std::vector<FrameRecord>* records = nullptr) {
  Engine& engine = engine_of(request.backend);
  FrameRequest frame{scene, nullptr, request.settings, {{}, request.size, request.part}};
  frame.settings.threads.fill(2);
  frame.settings = request.resolved ? *request.resolved
                                    : engine.resolve(scene, frame.view.box().size(), frame.settings).value();
  frame.tracer = Engine::prepare(scene, frame.settings);
  std::vector<FrameResult> pictures;
  SampleMean mean(frame.settings, [&](FrameResult&& picture) { pictures.push_back(std::move(picture)); });
  {
    Renderer renderer(engine, {[&](Frame& delivered) { mean.add(delivered); },
                               [&](const FrameRecord& record) {
                                 if (records) records->push_back(record);
                               }});
    for (const Camera& camera : cameras) {
      frame.view.camera = camera;
      submit_samples(renderer, frame, &mean);
    }
    renderer.drain();
  }
  engine.throw_gl_complaints();
  return pictures;
}

inline FrameResult draw_one(const Scene& scene, const DrawRequest& request) {
  return std::move(draw_all(scene, request, {first_camera(scene)}).front());
}

template <class T>
bool same(const Image<T>& a, const Image<T>& b) {
  return a.size() == b.size() && std::ranges::equal(a.pixels(), b.pixels());
}

inline bool same_pixels(const FrameResult& a, const FrameResult& b) {
  return same(a.color, b.color) && same(a.ids, b.ids) && std::ranges::equal(a.mask.bytes(), b.mask.bytes()) &&
         same(a.reflection, b.reflection);
}

}  // namespace pinocchio
