#include <pinocchio/camera.h>

#include <nanobind/stl/tuple.h>
#include <algorithm>
#include <cmath>

#include "python/src/scene/pickle.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max(), kLeastFov = 1e-4;
constexpr float kRotationError = 1e-3f;  // of a rotation in few digits

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

// A rotation and a place: a scale, a shear or a mirror would be lost without a word.
void check_rigid(const glm::mat4& m) {
  const glm::mat3 axes(m);
  const glm::mat3 product = glm::transpose(axes) * axes;  // the identity, for a rotation
  for (int i = 0; i < 3; ++i)
    if (const float length = std::sqrt(product[i][i]); std::abs(length - 1.0f) > kRotationError)
      throw Error("pose scales: its column " + std::to_string(i) + " has the length " + shown(length) +
                  "; the columns of a camera's pose have the length 1");
  const float skew = std::max({std::abs(product[0][1]), std::abs(product[0][2]), std::abs(product[1][2])});
  if (skew > kRotationError)
    throw Error("pose shears: its first three columns are not at right angles to each other");
  if (glm::determinant(axes) < 0.0f)
    throw Error("pose mirrors: the determinant of its rotation is -1, not 1");
  if (m[0][3] != 0.0f || m[1][3] != 0.0f || m[2][3] != 0.0f || m[3][3] != 1.0f)
    throw Error("pose is no camera-to-world matrix: its last row is not (0, 0, 0, 1)");
}

// A camera-to-world matrix. OpenCV's camera looks along +z, y down; OpenGL's along -z, y up.
Camera camera_at(const Matrix& pose, const std::string& convention, float fov) {
  if (convention != "opencv" && convention != "opengl")
    throw Error("convention is '" + convention +
                "'; it is 'opencv' (z forward, y down) or 'opengl' (y up, looks along -z)");
  const glm::mat4 m = pose.read("pose");
  check_rigid(m);
  const float sign = convention == "opencv" ? 1.0f : -1.0f;
  const glm::vec3 eye(m[3]), forward = sign * glm::normalize(glm::vec3(m[2]));
  return camera_of(eye, eye + reach_from(eye) * forward, -sign * glm::vec3(m[1]), fov, "");
}

Camera camera_with_matrix(const Size& argument, double fx, double fy, double cx, double cy,
                          const std::optional<Matrix>& pose, const std::string& convention) {
  const glm::ivec2 size = argument.read();
  if (!(fx > 0.0 && fy > 0.0)) throw Error("fx and fy are in pixels; they must be above 0");
  if (!std::isfinite(fx) || !std::isfinite(fy) || !std::isfinite(cx) || !std::isfinite(cy))
    throw Error("fx, fy, cx and cy are in pixels; they must be finite");
  Camera camera;
  camera.eye = glm::vec3(0.0f);
  camera.target = {0, 0, 1};
  camera.up = {0, -1, 0};
  if (pose) camera = camera_at(*pose, convention, 45.0f);
  return with_intrinsics(camera, {fx, fy, cx, cy}, size);
}

}  // namespace

void bind_camera(nb::module_& module) {
  nb::class_<Camera> bound(module, "Camera",
                           "A pinhole or thin-lens camera. The world is right-handed, Y up.");
  bound
      .def(
          "__init__",
          [](Camera* self, const Three& eye, const Three& target, const Three& up, float fov,
             const std::string& name) {
            new (self) Camera(camera_of(eye.read("eye"), target.read("target"), up.read("up"), fov, name));
          },
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
                  "Raises Error if the matrix scales, shears or mirrors, or if the convention or the field "
                  "of view is another "
                  "one.")
      .def_static(
          "from_intrinsics", &camera_with_matrix, "size"_a, "fx"_a, "fy"_a, "cx"_a, "cy"_a,
          "pose"_a = nb::none(), "convention"_a = "opencv",
          "A camera from OpenCV's camera matrix, in pixels of a picture of `size` (width, height).\n"
          "A point (x, y, z) in camera space (x right, y down, z forward) is seen at (fx x/z + cx, fy y/z + "
          "cy).\n"
          "(0, 0) is the centre of the top left pixel. So a depth is converted to a point by\n"
          "x = (u - cx) / fx * depth, y = (v - cy) / fy * depth, z = depth.\n"
          "pose: a 4x4 camera-to-world matrix. None: the camera is at the origin and looks along +z.\n"
          "Raises Error if fx, fy or size is not above 0, or if the matrix scales, shears or mirrors.")
      .def(
          "intrinsics",
          [](const Camera& camera, const Size& size) {
            const Intrinsics k = intrinsics_of(camera, size.read());
            return std::tuple(k.fx, k.fy, k.cx, k.cy);
          },
          "size"_a,
          "(fx, fy, cx, cy) in pixels, for a picture of that size: the arguments of from_intrinsics.")
      .def_rw("name", &Camera::name)
      .def("__copy__", [](const Camera& camera) { return camera; })
      .def(
          "__deepcopy__", [](const Camera& camera, nb::handle) { return camera; }, "memo"_a)
      .def("__repr__",
           [](const Camera& c) {
             return "<Camera " + (c.name.empty() ? "" : shown(c.name) + ", ") + "eye=" + shown(c.eye) +
                    ", target=" + shown(c.target) + ", fov=" + shown(c.fov_deg) + ">";
           })
      .def("__getstate__", [](const Camera& camera) { return pickled(camera); })
      .def("__setstate__", [](Camera& self, const nb::bytes& state) {
        Camera read;
        unpickle(state, read);
        new (&self) Camera(std::move(read));
      });
  def_number(bound, "fov", &Camera::fov_deg, kLeastFov, 180.0 - kLeastFov,
             "The vertical field of view, in degrees.");
  def_number(bound, "lens_radius", &Camera::lens_radius, 0.0, kLargest,
             "The lens radius in scene units, for depth of field with several samples (spp). 0: a pinhole.");
  def_number(bound, "focus_distance", &Camera::focus_distance, 0.0, kLargest,
             "The distance of sharp points along the view axis, in scene units. 0: the target's.");
  def_three(
      bound, "eye", [](Camera& c) -> glm::vec3& { return c.eye; }, "Scene units.");
  def_three(
      bound, "target", [](Camera& c) -> glm::vec3& { return c.target; }, "A point that the camera looks at.");
  def_three(bound, "up", [](Camera& c) -> glm::vec3& { return c.up; });
}

}  // namespace pinocchio::python
