#include "bench/peers/embree_picture.h"

#include <string>

#include "bench/one_ray/map_lookup.h"
#include "bench/peers/embree_rays.h"
#include "bench/peers/embree_scatter.h"
#include "core/trace/view/view_params.h"

namespace pinocchio {
namespace {

constexpr int kPictureTile = 8;                 // pixels a side
constexpr float kLeast = 1.0f / 8192.0f;        // rays with less throughput are not followed, as by default
constexpr float kAtTheLight = 1.0f - 0x1p-20f;  // shadow rays end in front of the light

// Whether a ray goes on through that point of the triangle, as its alpha says.
bool is_hole(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps || !maps->has_holes()) return false;
  return shared::is_hole(static_cast<int>(maps->alpha_mode), Lookup(mesh, triangle, weights).alpha(*maps),
                         maps->alpha_cutoff);
}

// Whether a shadow ray does, where a pixel has one sample.
bool lets_shadow_ray_pass(const Mesh& mesh, std::uint32_t triangle, const glm::vec3& weights) {
  const MaterialMaps* const maps = mesh.maps_of(triangle);
  if (!maps || !maps->blends()) return is_hole(mesh, triangle, weights);
  return Lookup(mesh, triangle, weights).alpha(*maps) < 0.5f;
}

}  // namespace

EmbreePicture::EmbreePicture(const Scene& scene, int threads, int depth)
    : scene_(scene),
      has_holes_(std::ranges::any_of(scene.mesh->maps,
                                     [](const MaterialMaps& m) { return m.has_holes() || m.blends(); })),
      depth_(depth),
      device_(rtcNewDevice(("threads=" + std::to_string(threads)).c_str())),
      embree_(embree_scene_of(device_, *scene.mesh)) {
  for (const Light& light : scene.lights) lights_.push_back(light_params(light));
}

EmbreePicture::~EmbreePicture() {
  rtcReleaseScene(embree_);
  rtcReleaseDevice(device_);
}

// The first hit that is not in a hole.
EmbreePicture::Hit EmbreePicture::closest_hit(Ray ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit = embree_ray(ray.origin, ray.direction, ray.t_max);
  for (;;) {
    rtcIntersect1(embree_, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Hit found{hit.hit.primID, {1.0f - hit.hit.u - hit.hit.v, hit.hit.u, hit.hit.v}};
    if (!has_holes_ || !is_hole(*scene_.mesh, found.triangle, found.weights)) return found;
    const float behind = hit.ray.tfar * (1.0f + 0x1p-20f);
    hit = embree_ray(ray.origin, ray.direction, ray.t_max);
    hit.ray.tnear = behind;
  }
}

bool EmbreePicture::occluded(const Ray& ray) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit hit = embree_ray(ray.origin, ray.direction, ray.t_max);
  if (!has_holes_) {
    rtcOccluded1(embree_, &context, &hit.ray);
    return hit.ray.tfar < 0.0f;
  }
  for (;;) {
    rtcIntersect1(embree_, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    const glm::vec3 weights(1.0f - hit.hit.u - hit.hit.v, hit.hit.u, hit.hit.v);
    if (!lets_shadow_ray_pass(*scene_.mesh, hit.hit.primID, weights)) return true;
    const float behind = hit.ray.tfar * (1.0f + 0x1p-20f);
    hit = embree_ray(ray.origin, ray.direction, ray.t_max);
    hit.ray.tnear = behind;
  }
}

SurfaceInteraction EmbreePicture::surface_of(const Hit& hit, const Ray& ray,
                                             const Footprint& footprint) const {
  const Mesh& mesh = *scene_.mesh;
  const glm::uvec3 corners = mesh.triangles[hit.triangle];
  const glm::vec3 &a = mesh.positions[corners.x], &b = mesh.positions[corners.y],
                  &c = mesh.positions[corners.z];
  SurfaceInteraction s{};
  s.to_viewer = -glm::normalize(ray.direction);
  s.p_world = shared::point_on_triangle(hit.weights, a, b - a, c - a);
  s.p_exact = s.p_world;
  const glm::vec3 n = shared::geometric_normal(b - a, c - a, s.to_viewer);
  const shared::FacingNormals facing =
      shared::face_viewer(n,
                          shared::shading_normal(hit.weights, mesh.normals[corners.x],
                                                 mesh.normals[corners.y], mesh.normals[corners.z], n),
                          s.to_viewer);
  s.n_geometric = facing.geometric;
  s.n_shading = s.n_vertices = facing.shading;
  s.leaving = facing.leaving;
  s.offset = error_bound_offset(s.p_exact, s.n_geometric, b - a, c - a);
  s.alpha = 1.0f;
  if (!mesh.maps_of(hit.triangle)) {
    s.material = plain_material(mesh.material_of(hit.triangle));
    return s;
  }
  const MappedMaterial mapped =
      mapped_material(mesh, {hit.triangle, hit.weights, s.n_shading, s.leaving,
                             footprint.at(ray.origin, ray.direction, s.p_world, 0.0f)});
  s.material = mapped.surface;
  s.n_shading = mapped.n_shading;
  s.alpha = mapped.alpha;
  return s;
}

glm::vec3 EmbreePicture::direct(const SurfaceInteraction& s) const {
  const shared::ShadingParams material = shared::viewed_from(s.to_viewer, s.n_shading, s.material.shading);
  glm::vec3 sum = shared::phong_ambient(material, scene_.ambient_light);
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const shared::Incident incident = shared::incident_light(lights_[i], lights_[i].position, s.p_world);
    if (incident.radiance == glm::vec3(0.0f) ||
        !shared::faces_light(s.n_shading, s.n_geometric, incident.to_light))
      continue;
    if (scene_.lights[i].casts_shadow) {
      const glm::vec3 origin = offset_origin(s, incident.to_light);
      const bool far = lights_[i].kind == shared::kLightDirectional;
      if (occluded(far ? Ray{origin, kInfinity, incident.to_light}
                       : Ray{origin, kAtTheLight, incident.target - origin}))
        continue;
    }
    sum += shared::reflected_light(material, incident, s.n_shading, s.to_viewer, true, 0.0f);
  }
  return s.alpha * sum;
}

glm::vec4 EmbreePicture::seen(const Ray& ray, const glm::vec3& throughput, const Footprint& footprint,
                              int depth) const {
  const Hit hit = closest_hit(ray);
  if (hit.triangle == kNoTriangle) return glm::vec4(0.0f);
  const SurfaceInteraction surface = surface_of(hit, ray, footprint);
  glm::vec3 sum = throughput * direct(surface);
  if (depth > 0 && (surface.alpha < 1.0f || scene_.mesh->material_of(hit.triangle).spawns_rays())) {
    std::vector<PathRay> bounces;
    scatter(surface, throughput, kLeast, bounces);
    for (const PathRay& bounce : bounces)
      sum += glm::vec3(seen(bounce.ray, bounce.throughput, footprint.of_cones(), depth - 1));
  }
  return {sum, 1.0f};
}

void EmbreePicture::draw(const Camera& camera, Workers& workers, Image<glm::vec4>& picture) const {
  const glm::ivec2 size = picture.size(), tiles = (size + kPictureTile - 1) / kPictureTile;
  const shared::ViewParams view = view_params(camera, size);
  const Footprint footprint = Footprint::of_camera(view);
  workers.for_each(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), [&](std::size_t i) {
    const int tile = static_cast<int>(i), x0 = tile % tiles.x * kPictureTile,
              y0 = tile / tiles.x * kPictureTile;
    for (int y = y0; y < std::min(y0 + kPictureTile, size.y); ++y)
      for (int x = x0; x < std::min(x0 + kPictureTile, size.x); ++x)
        picture.at(x, y) = seen(pixel_ray(view, x, y), glm::vec3(1.0f), footprint, depth_);
  });
}

}  // namespace pinocchio
