#include "app/window/model/pixel_report.h"

#include "app/window/model/model.h"
#include "core/trace/tiles/aov.h"
#include "core/trace/view/jitter.h"
#include "core/trace/view/view_params.h"
#include "hybrid/frame/samples.h"

namespace pinocchio::app {
namespace {

// The window's settings, exact. traced: with mirrored light.
Settings settings_for(Settings s, bool traced, int depth) {
  apply_preset("mode", "raytrace", s);
  s.exchange = Exchange::sync;
  s.depth = depth;
  s.reflection = traced && depth > 0 ? ReflectionFormat::full : ReflectionFormat::none;
  if (!traced) s.indirect = 0;
  s.mask_scale = 1;
  s.reflection_scale = 1;
  s.spp = 1;
  s.tiles = s.reuse = false;
  s.denoise = false;
  s.light_cutoff = 0.0f;
  s.threads = 1;
  return s;
}

std::uint64_t bounced(const RayCounts& rays) {
  return rays.reflection + rays.refraction;
}

}  // namespace

FrameResult PixelInspector::draw(const FrameRequest& request) {
  FrameResult result;
  if (!engine_) engine_ = std::make_unique<Engine>();
  Renderer renderer(*engine_, {[&](const Frame& frame) { result = frame.read(); }, {}});
  renderer.submit(request);
  renderer.drain();
  return result;
}

std::optional<PixelReport> PixelInspector::report(Model& model, glm::ivec2 pixel) {
  model.wants_tree = true;
  if (!model.tracer) return std::nullopt;
  FrameRequest request = model.request();
  request.view.part = {pixel, pixel + 1};
  request.settings = settings_for(model.drawn, true, model.settings.settings.depth);
  return report_of(std::move(request));
}

bool PixelInspector::update(Model& model, glm::ivec2 pixel) {
  FrameRequest request = model.request();
  request.view.part = {pixel, pixel + 1};
  if (reported_ == request) return false;
  reported_ = std::move(request);
  model.pixel = report(model, pixel);
  return true;
}

PixelReport PixelInspector::report_of(FrameRequest request) {
  const int depth = request.settings.depth;
  const Settings exact = request.settings;
  settle_environment(request.scene, exact);
  const std::vector<Light> lights = request.scene.lights;
  request.view = at_sample(request.view, 0);
  const FrameResult whole = draw(request);
  PixelReport report;
  report.pixel = request.view.part.lo;
  report.color = glm::vec3(whole.color[0]);
  report.triangle = whole.ids[0];
  report.rays = whole.record.rays;
  if (report.triangle == kNoTriangle) return report;

  const Mesh& mesh = *request.scene.mesh;
  report.material = mesh.triangle_materials[report.triangle];
  const SurfaceImages surface = surface_images(mesh, view_params(request.view), whole.ids, 0, 1);
  report.depth = surface.z_eye[0];
  report.position = surface.p_world[0];
  report.normal = surface.n_shading[0];
  if (!whole.reflection.pixels().empty()) report.mirrored = whole.reflection[0];
  for (std::uint64_t before = 0; report.bounces < depth; ++report.bounces) {
    request.settings = settings_for(exact, true, report.bounces + 1);
    const std::uint64_t now = bounced(draw(request).record.rays);
    if (now == before) break;
    before = now;
  }

  request.settings = settings_for(exact, false, 0);
  request.scene.lights.clear();
  report.ambient = glm::vec3(draw(request).color[0]);
  for (const Light& light : lights) {
    request.scene.lights = {light};
    const glm::vec3 added = glm::max(glm::vec3(draw(request).color[0]) - report.ambient, glm::vec3(0.0f));
    report.lights.push_back({light.name.empty() ? "light" : light.name, added != glm::vec3(0.0f), added});
  }
  return report;
}

}  // namespace pinocchio::app
