#include "core/trace/tiles/tile_plan.h"

#include <algorithm>
#include <cassert>

#include "core/base/prefetch.h"
#include "core/bsp/clear/clear_ways.h"
#include "core/shade/ground_sky.h"
#include "core/shade/surface.h"
#include "core/trace/tiles/holes.h"
#include "core/trace/tiles/medium_at.h"
#include "core/trace/tiles/tinted_shadows.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

// In the scene's order.
std::vector<LightGroup> groups_of(const Scene& scene) {
  constexpr int kGroup = as_int(kLightGroup);
  const std::vector<int> slots = mask_slots(scene);
  std::vector<LightGroup> groups(1);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const shared::LightParams params = light_params(scene.lights[i]);
    const int slot = slots[i], byte = std::max(slot, 0) / kGroup;
    if (as_size(byte) == groups.size()) groups.push_back({.lights = {}, .byte = byte});
    groups[as_size(byte)].lights.push_back({.params = params,
                                            .slot = slot,
                                            .queue = slot < 0 ? -1 : slot % kGroup,
                                            .has_size = shared::has_size(params),
                                            .index = as_uint32(i)});
  }
  return groups;
}

// The most lights of a group for which `is` is true.
template <class Is>
std::size_t most_of(const std::vector<LightGroup>& groups, Is is) {
  std::size_t most = 0;
  for (const LightGroup& group : groups)
    most = std::max(most, as_size(std::ranges::count_if(group.lights, is)));
  return most;
}

// What lights visible points. Without a mask, casting lights do not, unless their light is in the mirrored
// light.
std::vector<LightGroup> visible_groups(const std::vector<LightGroup>& all, const TileOutputs& out,
                                       bool adds_ambient) {
  std::vector<LightGroup> groups;
  for (const LightGroup& from : all) {
    LightGroup group{.lights = {}, .byte = from.byte};
    group.in_reflection = out.reflection && from.byte * as_int(kLightGroup) >= out.first_added_slot;
    for (const BounceLight& light : from.lights)
      if (light.slot >= 0 ? out.mask_bits > 0 || group.in_reflection
                          : adds_ambient || (out.sampled && light.has_size))
        group.lights.push_back(light);
    if (groups.empty() || !group.lights.empty()) groups.push_back(std::move(group));
  }
  return groups;
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

// Whether a surface of the material may mirror sharply or let see through. lobes: those of glTF's model are
// sampled.
bool shows_beyond(const Material& m, bool lobes) {
  if (m.transmits()) return true;
  if (lobes && m.is_microfacet()) return m.maps >= 0 || m.layers.coat > 0.0f || m.ggx_alpha <= kSharpAlpha;
  return m.reflects() && (m.gloss == 0.0f || m.gloss >= kSharpGloss);
}

}  // namespace

// The step with the lights of one group.
Bounce lit_by(const LightGroup& group, const Bounce& step) {
  Bounce lit = step;
  lit.lights = group.lights.data();
  lit.light_count = group.lights.size();
  return lit;
}

Bounce lights_alone(const LightGroup& group, const Bounce& step) {
  Bounce alone = lit_by(group, step);
  alone.adds_ambient = false;
  alone.adds_light = step.adds_light || group.in_reflection;
  alone.environment = alone.prefiltered = nullptr;
  alone.lights_alone = true;
  alone.mirrored = alone.refracted = alone.straight = alone.diffuse = nullptr;
  return alone;
}

SceneArrays SceneArrays::of(const Mesh& mesh, const LaneMapsOf& maps) {
  return {mesh.positions.data(),
          mesh.normals.data(),
          mesh.triangles.data(),
          mesh.triangle_materials.data(),
          mesh.materials.data(),
          maps.data(),
          mesh.colors.empty() ? nullptr : mesh.colors.data(),
          mesh.tangents.empty() ? nullptr : mesh.tangents.data(),
          mesh.triangles.size() > kLargeMesh};
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
      passed_backs(*j.scene.mesh, [&](const Material& m) { return passes_backs(m, j.options.backfaces); }),
      passed_by_shadows(*j.scene.mesh,
                        [&](const Material& m) {
                          const unsigned holes = pinocchio::has_holes(*j.scene.mesh, m) ? kHasHoles : 0u;
                          return holes |
                                 (tints && passes_light(*j.scene.mesh, m, j.options) ? kPassesLight : 0u);
                        }),
      further_lights(groups_of(j.scene)),
      most_casting(most_of(further_lights, [](const BounceLight& light) { return light.slot >= 0; })),
      most_sized(most_of(further_lights,
                         [](const BounceLight& light) { return light.slot >= 0 && light.has_size; })) {
  assert(o.mask_bits == 0 || o.mask_bits >= as_int(casting_lights(j.scene).size()));
  plan_background();
  plan_further();
  plan_sky();
  plan_visible();
  set_view(j.view, j.model);
}

void TilePlan::plan_background() {
  const TraceOptions& o = job.options;
  const Backdrop behind = backdrop_of(job.scene, o.background, o.background_blur);
  behind_scene = behind.picture;
  if (behind_scene) backdrop.emplace(*behind_scene, behind.rotation_deg, behind.strength);
  if (o.catcher_height && (out.color || out.caught_in_reflection))
    catcher.emplace(job.scene.mesh->bounds(), *o.catcher_height);
  straight_apart = blends && (passed_backs.any() || out.coverage || catcher ||
                              o.background.kind != Background::Kind::environment || o.background_blur > 0.0f);
}

void TilePlan::plan_further() {
  const Mesh& mesh = *job.scene.mesh;
  further.scene = SceneArrays::of(mesh, maps);
  further.offset = job.tracer.offset();
  further.options = &job.options;
  further.footprint = &further_footprint;
  further = lit_by(further_lights.front(), further);
  further.ambient_light = job.scene.ambient_light;
  further.adds_ambient = further.adds_light = true;
  further.samples =
      takes_samples(job.scene, job.options.environment_light, job.options.glossy) || out.indirect > 0;
  further.attenuates = std::ranges::any_of(mesh.materials, &Material::attenuates);
  further.tints = tints;
  further.scale = as_uint32(out.scale);
  further.lobes = further.samples && job.options.glossy == Glossy::sampled &&
                  std::ranges::any_of(mesh.materials, &Material::is_microfacet) &&
                  (out.reflection || out.color || out.added || out.sampled);
  if (out.sampled && out.beyond && out.depth > 0 &&
      (blends || std::ranges::any_of(mesh.materials,
                                     [&](const Material& m) { return shows_beyond(m, further.lobes); })))
    beyond = out.beyond;
}

void TilePlan::plan_sky() {
  if (job.scene.environment) environment.emplace(job.scene);
  if (environment && environment->shines && out.environment_light) {
    const bool sampled = job.options.environment_light == EnvironmentMethod::sampled;
    if (!sampled || out.sampled) environment->prefiltered = prefiltered(job.scene.environment);
    (sampled ? further.environment : further.prefiltered) = &*environment;
  }
  if (catcher && further.environment) {
    sky_on_ground = pinocchio::sky_on_ground(job.scene.environment);
    ground_sky = *environment;
    ground_sky->shares = sky_on_ground->shares();
    ground_sky->shines = !sky_on_ground->is_black();
  }
}

void TilePlan::plan_visible() {
  shadows = further;
  shadows.footprint = &no_footprint;
  visible = further;
  visible.footprint = &seen_footprint;
  visible.visible = true;
  visible.adds_ambient = out.color != nullptr;
  visible.adds_light = out.color || out.added;
  visible_lights = visible_groups(further_lights, out, visible.adds_ambient);
  lights_in_reflection = std::ranges::any_of(visible_lights, &LightGroup::in_reflection);
  find_clear_ways();
  visible = lit_by(visible_lights.front(), visible);
  visible.light_later = visible.tints && finds_mask_alone();
  find_settled();
}

// With on_rays the caller wants to see every ray, so none is left out.
void TilePlan::find_clear_ways() {
  ClearWaysToLights* const known = job.tracer.clear_ways();
  if (!known || !job.options.clear_ways || out.on_rays) return;
  std::vector<BounceLight*> lights;
  std::vector<LightPlace> places;
  for (LightGroup& group : visible_lights)
    for (BounceLight& light : group.lights) {
      if (light.slot < 0 || light.has_size) continue;
      const bool far = light.params.kind == shared::kLightDirectional;
      lights.push_back(&light);
      places.push_back({far ? -glm::vec3(light.params.direction) : glm::vec3(light.params.position), far});
    }
  if (places.empty()) return;  // what is known of other pictures' lights is kept
  clear_ways = known->to(places);
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i]->clear_ways = clear_ways[i].get();
}

bool TilePlan::finds_mask_alone() const {
  return !visible.adds_ambient && !visible.adds_light && !lights_in_reflection && !visible.environment &&
         !visible.prefiltered && !visible.lobes && !out.sampled && out.indirect == 0;
}

// Where each light has clear ways, and one byte of the mask holds all. Displaced shadow rays start elsewhere.
void TilePlan::find_settled() {
  SettledUnderLights* const known = job.tracer.settled();
  if (!known || !job.options.clear_ways || out.on_rays || !finds_mask_alone() || catcher ||
      !visible.cuts_light() || model || job.options.terminator == Terminator::displaced ||
      visible_lights.size() > 1)
    return;
  SettledTriangles::Under under{
      .lights = {}, .mirrors = out.depth > 0, .light_cutoff = job.options.light_cutoff};
  for (const BounceLight& light : visible_lights.front().lights) {
    if (light.slot < 0) continue;
    const auto ways = std::ranges::find(clear_ways, light.clear_ways, &std::shared_ptr<ClearWays>::get);
    if (!light.clear_ways || ways == clear_ways.end()) return;
    under.lights.push_back({light.params, static_cast<std::uint8_t>(light.queue), *ways});
  }
  if (under.mirrors || !under.lights.empty()) settled = known->of(under);
}

}  // namespace pinocchio
