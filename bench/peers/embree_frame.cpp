// A frame as Embree's tutorials draw it: threads share tiles of 8 x 8 pixels; each pixel has one ray at a
// time, its shading, and a shadow ray to each light. scripts/peers runs it. pinocchio-embree-frame
// JOB.json: prints {"frame_ms": [...]} If the job names a "scene" instead of a "mesh", it draws the whole
// picture, with mirrors and glass, for each of "cameras" (embree_picture.h); scripts/accuracy charts it.
// "save": {"FRAME": "FILE.exr"} keeps pictures; "export": "FILE.obj" is written for other programs, and
// "lights" are printed.
#include <embree3/rtcore.h>
#include <pmmintrin.h>
#include <xmmintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/peers/embree_picture.h"
#include "bench/peers/embree_rays.h"
#include "core/base/clock.h"
#include "core/parallel/workers.h"
#include "core/trace/view/view_params.h"
#include "pinocchio/exr.h"
#include "pinocchio/image.h"
#include "pinocchio/load.h"
#include "pinocchio/save.h"

namespace pinocchio {
namespace {

constexpr int kTile = 8;  // pixels a side
constexpr float kOffset = 1e-3f;
constexpr float kDiffuse = 0.8f, kSpecular = 0.2f, kShininess = 32.0f;

struct Job {
  Scene scene;
  Camera camera;
  std::vector<glm::vec3> eyes;  // frame by frame, repeated from the first
  std::vector<glm::vec3> lights;
  glm::ivec2 size{};
  int threads = 0, frames = 0;
};

glm::vec3 vec3_of(const nlohmann::json& json) {
  return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()};
}

Job read_job(const nlohmann::json& json) {
  Job job;
  job.scene = load_scene(json.at("mesh").get<std::string>()).value();
  for (const nlohmann::json& eye : json.at("eyes")) job.eyes.push_back(vec3_of(eye));
  job.camera.target = vec3_of(json.at("target"));
  job.camera.fov_deg = json.at("fov").get<float>();
  for (const nlohmann::json& light : json.at("lights")) job.lights.push_back(vec3_of(light));
  job.size = {json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()};
  job.threads = json.at("threads").get<int>();
  job.frames = json.at("frames").get<int>();
  return job;
}

glm::vec4 shade_pixel(RTCScene scene, const Job& job, const shared::ViewParams& view, int x, int y) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  const Ray eye_ray = pixel_ray(view, x, y);
  RTCRayHit seen = embree_ray(eye_ray.origin, eye_ray.direction, kInfinity);
  rtcIntersect1(scene, &context, &seen);
  if (seen.hit.geomID == RTC_INVALID_GEOMETRY_ID) return glm::vec4(0.0f);
  const glm::vec3 to_eye = -glm::normalize(eye_ray.direction);
  const glm::vec3 p = eye_ray.origin + seen.ray.tfar * eye_ray.direction;
  glm::vec3 n = glm::normalize(glm::vec3(seen.hit.Ng_x, seen.hit.Ng_y, seen.hit.Ng_z));
  if (glm::dot(n, to_eye) < 0.0f) n = -n;
  float light_sum = 0.0f;
  for (const glm::vec3& light : job.lights) {
    const glm::vec3 to_light = light - p, l = glm::normalize(to_light);
    if (glm::dot(n, l) <= 0.0f) continue;
    RTCRay shadow = embree_ray(p, to_light, 1.0f).ray;
    shadow.tnear = kOffset;
    rtcOccluded1(scene, &context, &shadow);
    if (shadow.tfar < 0.0f) continue;
    const float highlight = std::max(glm::dot(glm::reflect(-l, n), to_eye), 0.0f);
    light_sum += kDiffuse * glm::dot(n, l) + kSpecular * std::pow(highlight, kShininess);
  }
  return {light_sum, light_sum, light_sum, 1.0f};
}

void draw(RTCScene scene, const Job& job, Workers& workers, Image<glm::vec4>& picture) {
  const shared::ViewParams view = view_params(job.camera, job.size);
  const glm::ivec2 tiles = (job.size + kTile - 1) / kTile;
  workers.for_each(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y), [&](std::size_t i) {
    const int tile = static_cast<int>(i), x0 = tile % tiles.x * kTile, y0 = tile / tiles.x * kTile;
    for (int y = y0; y < std::min(y0 + kTile, job.size.y); ++y)
      for (int x = x0; x < std::min(x0 + kTile, job.size.x); ++x)
        picture.at(x, y) = shade_pixel(scene, job, view, x, y);
  });
}

int run(Job job) {
  RTCDevice device = rtcNewDevice(("threads=" + std::to_string(job.threads)).c_str());
  RTCScene scene = embree_scene_of(device, *job.scene.mesh);
  Workers workers(job.threads);
  Image<glm::vec4> picture(job.size);
  nlohmann::json frame_ms = nlohmann::json::array();
  for (int i = 0; i < job.frames; ++i) {
    job.camera.eye = job.eyes.at(static_cast<std::size_t>(i) % job.eyes.size());
    const double begin_s = now_s();
    draw(scene, job, workers, picture);
    frame_ms.push_back(1e3 * (now_s() - begin_s));
  }
  double mean = 0.0;
  for (const glm::vec4& pixel : picture.pixels()) mean += static_cast<double>(pixel.r);
  mean /= static_cast<double>(picture.pixels().size());
  std::printf("%s\n", nlohmann::json{{"frame_ms", frame_ms}, {"mean", mean}}.dump().c_str());
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
  return 0;
}

Camera camera_of(const nlohmann::json& json) {
  Camera camera;
  camera.eye = vec3_of(json.at("eye"));
  camera.target = vec3_of(json.at("target"));
  camera.up = vec3_of(json.at("up"));
  camera.fov_deg = json.at("fov").get<float>();
  return camera;
}

void save(const Image<glm::vec4>& picture, const std::string& file) {
  ExrFile exr;
  exr.display_size = picture.size();
  exr.data_window = {{0, 0}, picture.size()};
  for (int i = 0; i < 4; ++i) {
    ExrChannel& channel = exr.channels.emplace_back();
    channel.name = std::string("RGBA").substr(static_cast<std::size_t>(i), 1);
    channel.type = ExrChannel::Type::real;
    for (const glm::vec4& pixel : picture.pixels()) channel.values.push_back(pixel[i]);
  }
  write_exr(file, exr);
}

nlohmann::json described(const std::vector<Light>& lights) {
  const auto list = [](const glm::vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::json described = nlohmann::json::array();
  for (const Light& light : lights)
    described.push_back({{"directional", light.kind == Light::Kind::directional},
                         {"position", list(light.position)},
                         {"direction", list(light.direction)},
                         {"radiance", list(light.color * light.intensity)},
                         {"inverse_square", light.falloff == Light::Falloff::inverse_square}});
  return described;
}

int run_scene(const nlohmann::json& json) {
  Scene scene = load_scene(json.at("scene").get<std::string>()).value();
  if (scene.lights.empty())
    scene.lights.push_back(default_light(scene, camera_of(json.at("cameras").front())));
  if (json.contains("export")) save_scene(scene, json.at("export").get<std::string>());
  const EmbreePicture embree(scene, json.at("threads").get<int>(), json.at("depth").get<int>());
  Workers workers(json.at("threads").get<int>());
  Image<glm::vec4> picture({json.at("size").at(0).get<int>(), json.at("size").at(1).get<int>()});
  nlohmann::json frame_ms = nlohmann::json::array();
  for (int round = 0; round < json.at("rounds").get<int>(); ++round)
    for (std::size_t i = 0; i < json.at("cameras").size(); ++i) {
      const double begin_s = now_s();
      embree.draw(camera_of(json.at("cameras").at(i)), workers, picture);
      frame_ms.push_back(1e3 * (now_s() - begin_s));
      if (round == 0 && json.at("save").contains(std::to_string(i)))
        save(picture, json.at("save").at(std::to_string(i)).get<std::string>());
    }
  const bool brdf = std::ranges::any_of(scene.mesh->materials, &Material::brdf) ||
                    std::ranges::any_of(scene.mesh->maps, &MaterialMaps::from_gltf);
  const nlohmann::json lights{{"all", described(scene.lights)}, {"count_pi", !brdf}};
  std::printf("%s\n", nlohmann::json{{"frame_ms", frame_ms}, {"lights", lights}}.dump().c_str());
  return 0;
}

int run_job(const char* job_file) {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  std::ifstream in(job_file);
  const nlohmann::json json = nlohmann::json::parse(in);
  return json.contains("scene") ? run_scene(json) : run(read_job(json));
}

}  // namespace
}  // namespace pinocchio

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: pinocchio-embree-frame JOB.json\n");
    return 2;
  }
  try {
    return pinocchio::run_job(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "pinocchio-embree-frame: %s\n", error.what());
    return 1;
  }
}
