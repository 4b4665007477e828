#include "app/window/pixel_report.h"

#include <algorithm>

#include "core/trace/aov.h"
#include "core/trace/jitter.h"
#include "core/trace/view_params.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {
namespace {

// Nothing is left out and nothing is rounded; `traced`: mirrored light as well.
Settings settings_for(bool traced, int depth) {
  Settings s;
  apply_preset("mode", "raytrace", s);
  s.exchange = Exchange::sync;
  s.depth = depth;
  s.mask_bits = kMaxCastingLights;
  s.reflection = traced && depth > 0 ? ReflectionFormat::full : ReflectionFormat::none;
  s.tiles = s.reuse = false;
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
  Renderer renderer(engine_, {[&](const Frame& frame) { result = frame.read(); }, {}});
  renderer.submit(request);
  renderer.drain();
  return result;
}

PixelReport PixelInspector::look(const Scene& scene, const std::shared_ptr<const Tracer>& tracer,
                                 const View& view, glm::ivec2 pixel, int depth) {
  FrameRequest request{scene, tracer, settings_for(true, depth), view};
  request.view.part = {pixel, pixel + 1};
  request.view = at_sample(request.view, 0);
  const FrameResult whole = draw(request);
  PixelReport report;
  report.pixel = pixel;
  report.color = glm::vec3(whole.color[0]);
  report.triangle = whole.ids[0];
  report.rays = whole.record.rays;
  if (report.triangle == kNoTriangle) return report;

  const Mesh& mesh = *scene.mesh;
  report.material = mesh.triangle_materials[report.triangle];
  const SurfaceImages surface = surface_images(mesh, view_params(request.view), whole.ids, 0, 1);
  report.depth = surface.z_eye[0];
  report.position = surface.p_world[0];
  report.normal = surface.n_shading[0];
  if (!whole.reflection.pixels().empty()) report.mirrored = whole.reflection[0];
  for (std::uint64_t before = 0; report.bounces < depth; ++report.bounces) {
    request.settings = settings_for(true, report.bounces + 1);
    const std::uint64_t now = bounced(draw(request).record.rays);
    if (now == before) break;
    before = now;
  }

  // One light at a time.
  request.settings = settings_for(false, 0);
  request.scene.lights.clear();
  report.ambient = glm::vec3(draw(request).color[0]);
  for (const Light& light : scene.lights) {
    request.scene.lights = {light};
    const glm::vec3 brings = glm::max(glm::vec3(draw(request).color[0]) - report.ambient, glm::vec3(0.0f));
    report.lights.push_back({light.name.empty() ? "light" : light.name, brings != glm::vec3(0.0f), brings});
  }
  return report;
}

}  // namespace pinocchio::app
