#include "python/src/pictures.h"

#include <algorithm>
#include <utility>

#include "pinocchio/conversion.h"
#include "python/src/support/arguments.h"

namespace pinocchio::python {

namespace {

// Which of the scene's cameras is chosen; none: another camera is.
std::optional<std::size_t> number_of(const Scene& scene, const CameraChoice& choice) {
  if (const auto* name = std::get_if<std::string>(&choice)) {
    if (const Camera* found = find_camera(scene, *name)) return as_size(found - scene.cameras.data());
    throw Error("the scene has no camera '" + *name + "'; Scene.cameras lists them");
  }
  if (const int* index = std::get_if<int>(&choice)) {
    if (*index >= 0 && as_size(*index) < scene.cameras.size()) return as_size(*index);
    throw Error("the scene has no camera " + std::to_string(*index) + ", there are " +
                std::to_string(scene.cameras.size()));
  }
  if (std::holds_alternative<Camera>(choice) || scene.cameras.empty()) return std::nullopt;
  return 0;
}

}  // namespace

Camera camera_of(const Scene& scene, const CameraChoice& choice) {
  if (const auto* camera = std::get_if<Camera>(&choice)) return *camera;
  const std::optional<std::size_t> own = number_of(scene, choice);
  return own ? scene.cameras[*own] : camera_for_whole_scene(scene);
}

Scene lit(const Scene& scene, const Camera& camera) {
  Scene copy = scene;
  if (copy.lights.empty()) copy.lights.push_back(default_light(copy, camera));
  return copy;
}

void set_rays(const nb::object& given, View& view) {
  const char* const wanted =
      "rays must be (origins, directions), arrays of the shape (height, width, 3) or (n, 3)";
  if (!nb::isinstance<nb::sequence>(given) || nb::len(given) != 2) throw Error(wanted);
  const nb::module_ numpy = nb::module_::import_("numpy");
  const auto axes_of = [&](nb::handle array) { return nb::cast<int>(numpy.attr("ndim")(array)); };
  const auto read = [](nb::handle array, const char* name, int axes) {
    const std::vector<int> shape = axes == 1   ? std::vector{3}
                                   : axes == 3 ? std::vector{-1, -1, 3}
                                               : std::vector{-1, 3};
    return array_of(array, name, "float32", shape);
  };
  const int axes = axes_of(given[1]), axes_of_origins = axes_of(given[0]);
  if ((axes != 2 && axes != 3) || (axes_of_origins != axes && axes_of_origins != 1)) throw Error(wanted);
  nb::object directions = read(given[1], "directions of rays", axes),
             origins = read(given[0], "origins of rays", axes_of_origins);
  try {
    origins = numpy.attr("broadcast_to")(origins, directions.attr("shape"));
  } catch (const nb::python_error&) {
    throw Error("the origins of rays do not have the shape of their directions; give as many, or one");
  }
  if (axes == 2) {
    directions = directions.attr("reshape")(1, -1, 3);
    origins = origins.attr("reshape")(1, -1, 3);
  }
  const auto height = nb::cast<int>(directions.attr("shape")[0]),
             width = nb::cast<int>(directions.attr("shape")[1]);
  if (width < 1 || height < 1) throw Error("there are no rays");
  const auto values = [&](const nb::object& array, const char* name) {
    const Floats3::Array rows = Floats3{array.attr("reshape")(-1, 3)}.read(name);
    return copied<glm::vec3>(rows);
  };
  auto rays = std::make_shared<PixelRays>();
  rays->origins = values(origins, "the origins of rays");
  rays->directions = values(directions, "the directions of rays");
  view.rays = std::move(rays);
  view.size = {width, height};
}

std::vector<MotionTo> motions(const Scene& scene, const std::vector<Camera>& cameras, const PyScene* other,
                              const std::optional<std::vector<CameraChoice>>& choices) {
  if (choices && choices->size() != cameras.size())
    throw Error("there are " + std::to_string(choices->size()) + " motion_cameras and " +
                std::to_string(cameras.size()) + " cameras; give one for each");
  if (other && other->scene.mesh->triangles.size() != scene.mesh->triangles.size())
    throw Error(
        "motion_scene has other triangles; it is another pose of the scene (Scene.posed, Scene.at_time)");
  std::vector<MotionTo> all;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    all.push_back(
        {other ? other->scene.mesh : nullptr, choices ? camera_of(scene, (*choices)[i]) : cameras[i]});
  return all;
}

Poses poses_of(const Scene& scene, const std::vector<CameraChoice>& choices, const std::vector<Dict>& given) {
  if (choices.size() != given.size() && choices.size() != 1)
    throw Error("there are " + std::to_string(given.size()) + " poses and " + std::to_string(choices.size()) +
                " cameras; give a camera for each pose, or one for all");
  Poses poses;
  std::vector<std::size_t> of_picture;
  NodeNumbers numbers(scene);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (i == 0 || !given[i].source.is(given[i - 1].source))
      poses.moves.push_back(transforms_of(numbers, given[i]));
    of_picture.push_back(poses.moves.size() - 1);
  }
  for (std::size_t i = 0; i < given.size(); ++i) {
    const CameraChoice& choice = choices[choices.size() == 1 ? 0 : i];
    PosedPicture picture{poses.moves[of_picture[i]]};
    if (const std::optional<std::size_t> own = number_of(scene, choice))
      picture.camera = *own;
    else
      picture.camera = camera_of(scene, choice);
    poses.pictures.push_back(std::move(picture));
  }
  return poses;
}

}  // namespace pinocchio::python
