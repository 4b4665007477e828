#include <pinocchio/camera.h>

#include <algorithm>
#include <cmath>

#include "python/src/parts.h"

namespace pinocchio::python {
namespace {

// A distance at which eye + forward keeps the direction's digits.
float reach_from(const glm::vec3& eye) {
  return std::max(1.0f, std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}));
}

Camera camera_of(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up, float fov,
                 std::string name) {
  if (eye == target) throw Error("the camera's eye is its target; move one of them");
  if (!(fov > 0.0f && fov < 180.0f))
    throw Error("fov is " + std::string(nb::str(nb::float_(fov)).c_str()) +
                "; it must be between 0 and 180 degrees");
  return {std::move(name), eye, target, up, fov};
}

// A camera-to-world matrix. OpenCV's camera looks along +z, y down; OpenGL's along -z, y up.
Camera camera_at(const Matrix& pose, const std::string& convention, float fov) {
  if (convention != "opencv" && convention != "opengl")
    throw Error("convention is '" + convention +
                "'; it is 'opencv' (z forward, y down) or 'opengl' (y up, looks along -z)");
  const glm::mat4 m = matrix_of(pose);
  const float sign = convention == "opencv" ? 1.0f : -1.0f;
  const glm::vec3 eye(m[3]), forward = sign * glm::normalize(glm::vec3(m[2]));
  return camera_of(eye, eye + reach_from(eye) * forward, -sign * glm::vec3(m[1]), fov, "");
}

Camera camera_with_matrix(const glm::ivec2& size, double fx, double fy, double cx, double cy,
                          const std::optional<Matrix>& pose, const std::string& convention) {
  if (!(fx > 0.0 && fy > 0.0) || size.x < 1 || size.y < 1)
    throw Error("fx, fy and size are in pixels; they must be above 0");
  Camera camera;
  camera.eye = glm::vec3(0.0f);
  camera.target = {0, 0, 1};
  camera.up = {0, -1, 0};
  if (pose) camera = camera_at(*pose, convention, 45.0f);
  return with_intrinsics(camera, {fx, fy, cx, cy}, size);
}

}  // namespace

void bind_camera(nb::module_& module) {
  nb::class_<Camera>(module, "Camera", "A pinhole or thin-lens camera. The world is right-handed, Y up.")
      .def(
          "__init__",
          [](Camera* self, const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up, float fov,
             const std::string& name) { new (self) Camera(camera_of(eye, target, up, fov, name)); },
          "eye"_a, "target"_a, "up"_a = glm::vec3(0, 1, 0), "fov"_a = 45.0f, "name"_a = "",
          "A camera at `eye` that looks at `target`.\n"
          "eye, target, up: three numbers each, in scene units.\n"
          "fov: the vertical field of view, in degrees, between 0 and 180.\n"
          "Raises Error if eye and target are the same point, or if fov is out of range.")
      .def_static("from_pose", &camera_at, "pose"_a, "convention"_a = "opencv", "fov"_a = 45.0f,
                  "A camera from a pose.\n"
                  "pose: a 4x4 camera-to-world matrix.\n"
                  "convention: 'opencv' (z forward, y down) or 'opengl' (looks along -z, y up).\n"
                  "fov: the vertical field of view, in degrees.\n"
                  "Raises Error if the convention or the field of view is another one.")
      .def_static(
          "from_intrinsics", &camera_with_matrix, "size"_a, "fx"_a, "fy"_a, "cx"_a, "cy"_a,
          "pose"_a = nb::none(), "convention"_a = "opencv",
          "A camera from OpenCV's camera matrix, in pixels of a picture of `size` (width, height).\n"
          "A point (x, y, z) in camera space (x right, y down, z forward) is seen at (fx x/z + cx, fy y/z + "
          "cy).\n"
          "(0, 0) is the centre of the top left pixel. So a depth is converted to a point by\n"
          "x = (u - cx) / fx * depth, y = (v - cy) / fy * depth, z = depth.\n"
          "pose: a 4x4 camera-to-world matrix. None: the camera is at the origin and looks along +z.\n"
          "Raises Error if fx, fy or size is not above 0.")
      .def(
          "intrinsics",
          [](const Camera& camera, const glm::ivec2& size) {
            const Intrinsics k = intrinsics_of(camera, size);
            return nb::make_tuple(k.fx, k.fy, k.cx, k.cy);
          },
          "size"_a,
          "(fx, fy, cx, cy) in pixels, for a picture of that size: the arguments of from_intrinsics.")
      .def_rw("name", &Camera::name)
      .def_rw("eye", &Camera::eye)
      .def_rw("target", &Camera::target)
      .def_rw("up", &Camera::up)
      .def_rw("fov", &Camera::fov_deg, "The vertical field of view, in degrees.")
      .def_rw("lens_radius", &Camera::lens_radius,
              "The lens radius in scene units, for depth of field with several samples (spp). 0: a pinhole.")
      .def_rw("focus_distance", &Camera::focus_distance,
              "The distance of sharp points along the view axis, in scene units. 0: the target's.")
      .def("__copy__", [](const Camera& camera) { return camera; })
      .def(
          "__deepcopy__", [](const Camera& camera, nb::handle) { return camera; }, "memo"_a);
}

}  // namespace pinocchio::python
