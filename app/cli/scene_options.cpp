// The scene, the camera and the part of the picture that the command line's options mean.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/options.h"
#include "pinocchio/conversion.h"
#include "pinocchio/load.h"
#include "pinocchio/studio.h"

namespace pinocchio::app {

Scene load_whole(const DrawOptions& options, Warnings& warnings, pinocchio::Progress* progress) {
  if (!progress) progress = &run_progress();
  Expected<Scene> scene = load_scene(options.scene, options.load, &warnings, progress);
  if (scene && !options.environment.empty()) {
    auto environment = load_environment(options.environment, progress, options.load.limit_bytes, &warnings);
    if (environment)
      scene->environment = std::move(*environment);
    else
      scene = pinocchio::Unexpected(environment.error());
  }
  if (!scene || (!options.quiet && !options.strict))  // warnings may explain why it cannot be read
    print_warnings(warnings);
  if (scene && options.strict && !warnings.empty()) {
    const std::size_t more = warnings.size() - 1;
    throw Exit(kBadScene, warnings[0].message() +
                              (more > 0 ? "; and " + std::to_string(more) + " more" : "") +
                              " ('pinocchio info' lists them; without --strict the rest is drawn)");
  }
  return value_or_exit(std::move(scene), kBadScene);
}

void light_if_dark(Scene& scene, const DrawOptions& options) {
  if (!scene.lights.empty() || scene.environment) return;
  if (options.studio)
    add_studio_light(scene);
  else
    scene.lights.push_back(default_light(scene, camera_for(options, scene)));
  if (!options.quiet) std::fprintf(stderr, "pinocchio: %s\n", assumed_light(scene, options).c_str());
}

std::string assumed_light(const Scene& scene, const DrawOptions& options) {
  if (!options.studio)
    return scene.source + " has no light; a default one is used (add one with --light x,y,z)";
  const bool framed = scene.cameras.empty() && options.camera.empty() && !options.eye;
  return scene.source + " has no light" + (framed ? " and no camera" : "") + "; a studio lights " +
         (framed ? "and frames it" : "it") + " (--studio off; --light x,y,z, --environment FILE" +
         (framed ? " and --eye x,y,z" : "") + " replace its parts)";
}

Scene load_scene_for(const DrawOptions& options) {
  Warnings warnings;
  Scene scene = load_whole(options, warnings);
  scene.lights.insert(scene.lights.end(), options.lights.begin(), options.lights.end());
  light_if_dark(scene, options);
  return scene;
}

namespace {

// An orthographic picture shows at the target what the perspective one did.
void set_projection(Projection projection, Camera& camera) {
  if (projection == camera.projection) return;
  if (projection == Projection::orthographic && camera.projection == Projection::perspective)
    camera.height = 2.0f * glm::length(camera.target - camera.eye) *
                    std::tan(glm::radians(0.5f * std::min(camera.fov_deg, 179.0f)));
  if (projection != Projection::perspective && projection != Projection::fisheye) camera.distortion = {};
  camera.projection = projection;
}

}  // namespace

Camera camera_for(const DrawOptions& options, const Scene& scene) {
  Camera camera = !scene.cameras.empty() ? scene.cameras.front()
                  : !options.studio      ? camera_for_whole_scene(scene)
                  : options.turns        ? studio_turntable(scene, options.size)
                                         : studio_camera(scene, options.size);
  if (!options.camera.empty()) {
    const std::optional<int> number = parse_int(options.camera);
    const Camera* found = find_camera(scene, options.camera);
    if (!found && number && *number >= 0 && *number < std::ssize(scene.cameras))
      found = &scene.cameras[*number];
    if (!found) {
      std::string known;
      for (const Camera& c : scene.cameras) known += (known.empty() ? "" : ", ") + c.name;
      throw Exit(kUsage, "--camera " + options.camera + ": " + options.scene + " has " +
                             (known.empty() ? "no camera" : "only these cameras: " + known));
    }
    camera = *found;
  }
  if (options.eye) camera.eye = *options.eye;
  if (options.target) camera.target = *options.target;
  if (options.eye && options.target) camera.up = Camera{}.up;
  if (options.up) camera.up = *options.up;
  if (options.fov_deg) camera.fov_deg = *options.fov_deg;
  if (options.projection) set_projection(*options.projection, camera);
  if (options.fov_deg && *options.fov_deg >= 180.0f && camera.projection != Projection::fisheye)
    throw Exit(kUsage, "--fov: " + std::to_string(as_int(*options.fov_deg)) +
                           " degrees are for --projection fisheye; other cameras take less than 180");
  if (options.height) camera.height = *options.height;
  if (options.lens_radius) camera.lens_radius = *options.lens_radius;
  if (options.focus) camera.focus_distance = *options.focus;
  if (const Expected<void> checked = check_camera(camera); !checked)
    throw Exit(kUsage, checked.error().message());
  return camera;
}

PixelBox part_of(const DrawOptions& options) {
  const PixelBox whole{{0, 0}, options.size};
  if (!options.crop) return whole;
  const PixelBox part{glm::max(options.crop->lo, whole.lo), glm::min(options.crop->hi, whole.hi)};
  if (part.empty())
    throw Exit(kUsage, "--crop: no pixel of the picture is in the box; it is x0,y0,x1,y1, half-open");
  return part;
}

}  // namespace pinocchio::app
