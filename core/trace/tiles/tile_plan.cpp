#include "core/trace/tiles/tile_plan.h"

#include <algorithm>

#include "core/shade/surface.h"
#include "core/trace/tiles/medium_at.h"
#include "core/trace/tiles/tinted_shadows.h"
#include "core/trace/view/view_params.h"

namespace pinocchio {
namespace {

std::vector<BounceLight> lights_of(const Scene& scene) {
  std::vector<BounceLight> lights;
  const std::vector<int> slots = mask_slots(scene);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const shared::LightParams params = light_params(scene.lights[i]);
    lights.push_back({params, slots[i], shared::has_size(params), static_cast<std::uint32_t>(i)});
  }
  return lights;
}

// Whether textures are averaged.
bool filters(const TraceJob& job) {
  const Textures& textures = job.scene.mesh->textures;
  return job.options.texture_footprint > 0.0f &&
         std::any_of(textures.begin(), textures.end(), [](const Texture& t) { return t.levels() > 1; });
}

bool any_maps(const Mesh& mesh, bool (MaterialMaps::*is)() const) {
  return std::any_of(mesh.maps.begin(), mesh.maps.end(), [is](const MaterialMaps& m) { return (m.*is)(); });
}

}  // namespace

SceneArrays SceneArrays::of(const Mesh& mesh, const LaneMapsOf& maps) {
  return {mesh.positions.data(),
          mesh.normals.data(),
          mesh.triangles.data(),
          mesh.triangle_materials.data(),
          mesh.materials.data(),
          maps.data(),
          mesh.colors.empty() ? nullptr : mesh.colors.data(),
          mesh.tangents.empty() ? nullptr : mesh.tangents.data()};
}

void TilePlan::set_view(const shared::ViewParams& from, const RayModel* rays) {
  view = scaled_view(from, out.scale);
  model = rays;
  first = glm::ivec2(from.first);
  const float side = job.options.texture_footprint;
  if (filters(job))
    seen_footprint = model ? model->footprint(out.size / 2, side) : Footprint::of_camera(view, side);
  further_footprint = seen_footprint.of_cones();
  const bool one_eye = model ? model->has_one_eye() : !view.parallel;
  visible.eye_medium = medium_of_eye(job.tracer, view.eye, one_eye);
}

TilePlan::TilePlan(const TraceJob& j, const TileOutputs& o)
    : job(j),
      out(o),
      maps(*j.scene.mesh),
      has_holes(any_maps(*j.scene.mesh, &MaterialMaps::has_holes)),
      blends(any_maps(*j.scene.mesh, &MaterialMaps::blends)),
      tints((o.reflection || o.color || o.added || o.sampled) && tints_shadows(*j.scene.mesh, j.options)),
      passed_backs(*j.scene.mesh, j.options.backfaces),
      all_lights(lights_of(j.scene)),
      casting(casting_lights(j.scene).size()),
      sized_lights(static_cast<std::size_t>(std::ranges::count_if(j.scene.lights, &Light::has_size))) {
  straight_apart = blends && (passed_backs.any() || o.coverage);
  further.scene = SceneArrays::of(*job.scene.mesh, maps);
  further.offset = job.tracer.offset();
  further.options = &job.options;
  further.footprint = &further_footprint;
  further.lights = all_lights.data();
  further.light_count = all_lights.size();
  further.ambient_light = job.scene.ambient_light;
  further.adds_ambient = further.adds_light = true;
  const bool microfacets = std::ranges::any_of(job.scene.mesh->materials, &Material::is_microfacet);
  const bool sampled_lobes = job.options.glossy == Glossy::sampled;
  further.samples =
      takes_samples(job.scene, job.options.environment_light, job.options.glossy) || out.indirect > 0;
  further.attenuates = std::ranges::any_of(job.scene.mesh->materials, &Material::attenuates);
  further.tints = tints;
  further.scale = static_cast<std::uint32_t>(out.scale);
  if (job.scene.environment) environment.emplace(job.scene);
  if (environment && environment->shines && o.environment_light) {
    const bool sampled = job.options.environment_light == EnvironmentMethod::sampled;
    if (!sampled) environment->prefiltered = prefiltered(job.scene.environment);
    (sampled ? further.environment : further.prefiltered) = &*environment;
  }
  further.lobes =
      further.samples && sampled_lobes && microfacets && (o.reflection || o.color || o.added || o.sampled);
  shadows = further;
  shadows.footprint = &no_footprint;
  visible = further;
  visible.footprint = &seen_footprint;
  visible.visible = true;
  visible.adds_ambient = out.color != nullptr;
  visible.adds_light = out.color || out.added;
  for (const BounceLight& light : all_lights)
    if (light.slot >= 0 ? out.mask_bits > 0 : visible.adds_ambient || (out.sampled && light.has_size))
      visible_lights.push_back(light);
  visible.lights = visible_lights.data();
  visible.light_count = visible_lights.size();
  set_view(j.view, j.model);
}

}  // namespace pinocchio
