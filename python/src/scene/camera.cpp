#include <pinocchio/camera.h>

#include <pinocchio/names.h>

#include <nanobind/stl/tuple.h>
#include <algorithm>
#include <cmath>

#include "pinocchio/conversion.h"
#include "python/src/scene/pickle.h"
#include "python/src/support/parts.h"

namespace pinocchio::python {
namespace {

constexpr double kLargest = std::numeric_limits<float>::max(), kLeastFov = 1e-4, kLeastHeight = 1e-30;
constexpr float kRotationError = 1e-3f;  // of a rotation in few digits

// A distance at which eye + forward keeps the direction's digits.
float reach_from(const glm::vec3& eye) {
  return std::max(1.0f, std::max({std::abs(eye.x), std::abs(eye.y), std::abs(eye.z)}));
}

Camera camera_of(const glm::vec3& eye, const glm::vec3& target, const glm::vec3& up, float fov,
                 std::string name) {
  Camera camera{std::move(name), eye, target, up, fov};
  if (const Expected<void> checked = check_camera(camera); !checked) throw Error(checked.error().message());
  return camera;
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

// OpenCV's coefficients of a lens: 4, 5 or 8 of them, of fisheyes 4.
void set_distortion(Camera& camera, const std::vector<double>& given) {
  const bool is_fisheye = camera.projection == Projection::fisheye;
  const std::size_t n = given.size();
  if (!(n == 0 || n == 4 || (!is_fisheye && (n == 5 || n == 8))))
    throw Error("distortion has " + std::to_string(n) + " numbers; " +
                (is_fisheye ? "a fisheye has 4: k1, k2, k3, k4"
                            : "there are 4, 5 or 8: k1, k2, p1, p2, k3, k4, k5, k6, as OpenCV orders them"));
  if (n > 0 && !is_fisheye && camera.projection != Projection::perspective)
    throw Error("only perspective and fisheye cameras can have a distortion");
  camera.distortion = {};
  for (std::size_t i = 0; i < n; ++i)
    camera.distortion[i] = number_within(given[i], "distortion", -kLargest, kLargest);
}

Camera camera_with_matrix(const Size& argument, double fx, double fy, double cx, double cy,
                          const std::optional<Matrix>& pose, const std::string& convention,
                          const std::vector<double>& distortion, const std::string& projection) {
  const glm::ivec2 size = argument.read();
  if (!(fx > 0.0 && fy > 0.0)) throw Error("fx and fy are in pixels; they must be above 0");
  if (!std::isfinite(fx) || !std::isfinite(fy) || !std::isfinite(cx) || !std::isfinite(cy))
    throw Error("fx, fy, cx and cy are in pixels; they must be finite");
  if (projection != "perspective" && projection != "fisheye")
    throw Error("projection is '" + projection +
                "'; a camera matrix is of a 'perspective' or a 'fisheye' one");
  Camera camera;
  camera.eye = glm::vec3(0.0f);
  camera.target = {0, 0, 1};
  camera.up = {0, -1, 0};
  if (pose) camera = camera_at(*pose, convention, 45.0f);
  if (projection == "fisheye") camera.projection = Projection::fisheye;
  set_distortion(camera, distortion);
  Camera made = with_intrinsics(camera, {fx, fy, cx, cy}, size);
  if (camera.projection == Projection::fisheye && made.fov_deg > kWidestFisheye)
    throw Error("fy is " + shown(fy) + " pixels, a field of view of " + shown(made.fov_deg) +
                " degrees; a fisheye has at most 360");
  return made;
}

Camera aimed(Projection projection, const Three& eye, const Three& target, const Three& up, float fov,
             const std::string& name) {
  Camera camera = camera_of(eye.read("eye"), target.read("target"), up.read("up"), 45.0f, name);
  camera.projection = projection;
  if (projection == Projection::fisheye)
    camera.fov_deg = number_within(fov, "fov", kLeastFov, kWidestFisheye);
  return camera;
}

// Where the camera sees points, (n, 2); NaN where it does not.
auto projected(const Camera& camera, const Floats3& points, const Size& argument) {
  const glm::ivec2 size = argument.read();
  const Floats3::Array given = points.read("points");
  const auto all = copied<glm::vec3>(given);
  std::vector<double> pixels;
  pixels.reserve(2 * all.size());
  for (const glm::vec3& p : all) {
    const glm::dvec2 at =
        pixel_of(camera, size, glm::dvec3(p)).value_or(glm::dvec2(std::numeric_limits<double>::quiet_NaN()));
    pixels.insert(pixels.end(), {at.x, at.y});
  }
  const std::size_t n = all.size();
  return array_that_owns<double>(std::move(pixels), {n, 2});
}

}  // namespace

void bind_camera(nb::module_& module) {
  nb::class_<Camera> bound(
      module, "Camera", "A camera: by default a pinhole or thin-lens one. The world is right-handed, Y up.");
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
          "pose"_a = nb::none(), "convention"_a = "opencv", "distortion"_a = std::vector<double>{},
          "projection"_a = "perspective",
          "A camera from OpenCV's camera matrix, in pixels of a picture of `size` (width, height).\n"
          "A point (x, y, z) in camera space (x right, y down, z forward) is seen at (fx x/z + cx, fy y/z + "
          "cy).\n"
          "(0, 0) is the centre of the top left pixel. So a depth is converted to a point by\n"
          "x = (u - cx) / fx * depth, y = (v - cy) / fy * depth, z = depth.\n"
          "pose: a 4x4 camera-to-world matrix. None: the camera is at the origin and looks along +z.\n"
          "distortion: OpenCV's coefficients: k1, k2, p1, p2[, k3[, k4, k5, k6]]; of projection='fisheye' "
          "k1, "
          "k2, k3, k4.\n"
          "Raises Error if fx, fy or size is not above 0, if the matrix scales, shears or mirrors, or if the "
          "lens has another\n"
          "number of coefficients.")
      .def_static(
          "orthographic",
          [](const Three& eye, const Three& target, const Three& up, float height, const std::string& name) {
            Camera camera = aimed(Projection::orthographic, eye, target, up, 45.0f, name);
            camera.height = number_within(height, "height", kLeastHeight, kLargest);
            return camera;
          },
          "eye"_a, "target"_a, "up"_a = glm::vec3(0, 1, 0), "height"_a = 2.0f, "name"_a = "",
          "A camera with parallel rays, which sees what is in front of `eye`.\n"
          "height: of the picture, in scene units. Other arguments and errors as for Camera.")
      .def_static(
          "fisheye",
          [](const Three& eye, const Three& target, const Three& up, float fov,
             const std::vector<double>& distortion, const std::string& name) {
            Camera camera = aimed(Projection::fisheye, eye, target, up, fov, name);
            set_distortion(camera, distortion);
            return camera;
          },
          "eye"_a, "target"_a, "up"_a = glm::vec3(0, 1, 0), "fov"_a = 180.0f,
          "distortion"_a = std::vector<double>{}, "name"_a = "",
          "A camera whose picture shows angles as distances from its centre (equidistant).\n"
          "fov: the angle from the lower to the upper edge, in degrees, at most 360. distortion: k1, k2, k3, "
          "k4 of OpenCV's\n"
          "fisheye. Other arguments and errors as for Camera.")
      .def_static(
          "panorama",
          [](const Three& eye, const Three& target, const Three& up, const std::string& name) {
            return aimed(Projection::panorama, eye, target, up, 45.0f, name);
          },
          "eye"_a, "target"_a, "up"_a = glm::vec3(0, 1, 0), "name"_a = "",
          "A camera that sees everything around `eye`: longitude across, -180 to 180 degrees, with `target` "
          "in the middle;\n"
          "latitude down, 90 to -90. A picture of the shape 2 to 1 has square pixels.")
      .def(
          "stereo",
          [](const Camera& camera, double baseline) {
            if (!std::isfinite(baseline))
              throw Error("baseline is a length in scene units; it must be finite");
            const StereoPair pair = stereo_pair(camera, as_float(baseline));
            return std::tuple(pair.left, pair.right);
          },
          "baseline"_a,
          "(left, right): the cameras of two eyes that are `baseline` (scene units) apart, with this camera "
          "in "
          "the middle and\n"
          "parallel axes. A point at depth z lies further left in the right picture by fx * baseline / z "
          "pixels.")
      .def("project", &projected, "points"_a, "size"_a, nb::rv_policy::reference,
           "(n, 2) float64: where the camera sees points (n, 3) of the world, in pixels of a picture of "
           "`size`; "
           "(0, 0) is the\n"
           "centre of the top left pixel. It may be outside the picture. NaN: the camera does not see the "
           "point, "
           "as it is\n"
           "behind, or beyond the angle up to which its distortion grows.")
      .def_prop_ro(
          "projection", [](const Camera& c) { return std::string(name_of(kProjectionNames, c.projection)); },
          "'perspective', 'orthographic', 'panorama' or 'fisheye'.")
      .def_prop_rw(
          "distortion",
          [](const Camera& c) {
            const std::size_t n = c.projection == Projection::fisheye ? 4 : c.distortion.size();
            return std::vector<double>(c.distortion.begin(), c.distortion.begin() + static_cast<long>(n));
          },
          [](Camera& c, const std::vector<double>& given) { set_distortion(c, given); },
          "OpenCV's coefficients of the lens, in OpenCV's order.")
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
             const std::string kind = c.projection == Projection::perspective
                                          ? ""
                                          : std::string(name_of(kProjectionNames, c.projection)) + ", ";
             const std::string size = c.projection == Projection::orthographic ? "height=" + shown(c.height)
                                      : c.projection == Projection::panorama   ? std::string("all around")
                                                                               : "fov=" + shown(c.fov_deg);
             return "<Camera " + (c.name.empty() ? "" : shown(c.name) + ", ") + kind + "eye=" + shown(c.eye) +
                    ", target=" + shown(c.target) + ", " + size + ">";
           })
      .def("__getstate__", [](const Camera& camera) { return pickled(camera); })
      .def("__setstate__", [](Camera& self, const nb::bytes& state) {
        Camera read;
        unpickle(state, read);
        new (&self) Camera(std::move(read));
      });
  bound.def_prop_rw(
      "fov", [](const Camera& c) { return c.fov_deg; },
      [](Camera& c, double value) {
        const bool is_fisheye = c.projection == Projection::fisheye;
        c.fov_deg = number_within(value, "fov", kLeastFov, is_fisheye ? kWidestFisheye : 180.0 - kLeastFov);
      },
      "The vertical field of view, in degrees; of a fisheye up to 360.");
  def_number(bound, "height", &Camera::height, kLeastHeight, kLargest,
             "The height of an orthographic picture, in scene units.");
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
