#include <pinocchio/batch.h>
#include <pinocchio/engine.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <mutex>

#include "pinocchio/conversion.h"
#include "python/src/layers.h"
#include "python/src/pictures.h"
#include "python/src/render_settings.h"
#include "python/src/result.h"
#include "python/src/scene/scene.h"
#include "python/src/support/interrupt.h"
#include "python/src/support/parts.h"
#include "python/src/threads.h"

namespace pinocchio::python {
namespace {

const LayerRow& output_named(const std::string& name) {
  for (const LayerRow& row : kLayers)
    if (!name.empty() && name == row.array.name) return row;
  throw Error("there is no output '" + name + "'; choose from " + array_names());
}

// Of the lights that the pictures are drawn with. In other poses, lights may reach something that reach
// nothing now.
std::size_t mask_bytes_of(Scene scene, const Settings& settings, bool has_poses) {
  if (settings.mask_bits == 0) return 1;
  if (!has_poses) drop_idle_casters(scene);
  return MaskImage::bytes_for(casting_lights(scene).size());
}

std::vector<std::size_t> shape_of(const LayerRow& output, std::size_t frames, const glm::ivec2& size,
                                  std::size_t mask_bytes) {
  std::vector<std::size_t> shape{frames, as_size(size.y), as_size(size.x)};
  if (const std::size_t numbers = pixel_type(output, mask_bytes).numbers; numbers > 1)
    shape.push_back(numbers);
  return shape;
}

nb::object new_array(const LayerRow& output, const std::vector<std::size_t>& shape, FrameArrays& to) {
  const PixelType type = pixel_type(output, to.mask_bytes);
  std::size_t bytes = type.bytes;
  for (const std::size_t n : shape) bytes *= n;
  void* const data = ::operator new(std::max<std::size_t>(bytes, 1));
  const nb::capsule owner(data, [](void* p) noexcept { ::operator delete(p); });
  point(output, data, to);
  return nb::cast(nb::ndarray<nb::numpy>(data, shape.size(), shape.data(), owner, nullptr, type.type));
}

nb::object given_array(const LayerRow& output, const std::vector<std::size_t>& shape, nb::handle given,
                       FrameArrays& to) {
  const std::string named = "out['" + std::string(output.array.name) + "'] ";
  nb::ndarray<> array;
  if (!nb::try_cast(given, array, false))
    throw nb::type_error((named + "is no array that can be written to in the CPU's memory").c_str());
  if (const int device = array.device_type(); device != nb::device::cpu::value &&
                                              device != nb::device::cuda_host::value &&
                                              device != nb::device::rocm_host::value)
    throw nb::type_error((named + "is on another device (DLPack's type " + std::to_string(device) +
                          "); the CPU fills it: give an array of its memory, and copy that to the device")
                             .c_str());
  if (array.size() == 0 && shape.front() == 0) return nb::borrow(given);
  bool fits = array.dtype() == pixel_type(output, to.mask_bytes).type && array.ndim() == shape.size() &&
              array.is_valid();
  std::int64_t stride = 1;
  for (std::size_t i = shape.size(); fits && i-- > 0; stride *= static_cast<std::int64_t>(shape[i]))
    fits = array.shape(i) == shape[i] && (shape[i] == 1 || array.stride(i) == stride);
  if (!fits) throw Error(named + "is not of the shape and type of this output; leave it out");
  point(output, array.data(), to);
  return nb::borrow(given);
}

// An Engine that knows its process. Calls from several threads are executed one after the other.
class PyEngine {
 public:
  PyEngine(int threads, const std::string& backend, const std::string& device)
      : threads_(threads_wanted(threads)),
        engine_(std::make_unique<Engine>(EngineOptions{.backend = backend, .device = device})) {
    // Without this the first array imports it, and an interrupt at that time becomes a TypeError.
    (void)nb::module_::import_("numpy");
  }
  ~PyEngine() {
    if (is_forked()) (void)engine_.release();
  }

  // Waits for the calls of other threads.
  void close() {
    if (is_forked()) {  // a call of the parent may hold the lock for ever
      (void)engine_.release();
      return;
    }
    const nb::gil_scoped_release released;
    const std::lock_guard lock(mutex_);
    engine_.reset();
  }
  [[nodiscard]] bool is_closed() const { return !engine_; }

  [[nodiscard]] int threads() const { return or_one_a_core(threads_); }

  Result render(const PyScene& given, const CameraChoice& choice, const Size& pixels, const nb::object& rays,
                const nb::kwargs& arguments) {
    check_open();
    View view;
    if (rays.is_none())
      view.size = pixels.read();
    else
      set_rays(rays, view);
    const Scene scene = given.now();
    const Settings settings = settings_of(arguments, threads_);
    view.camera = camera_of(scene, choice);
    const Scene drawn = lit(scene, view.camera);
    const bool is_dark = scene.lights.empty();
    return without_gil([&](Progress* progress) {
      const std::lock_guard lock(mutex_);
      check_open();
      const auto begin = std::chrono::steady_clock::now();
      Result result{value_or_throw(engine_->render(drawn, view, settings, progress))};
      result.ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
      if (is_dark) result.frame.scene.lights = drawn.lights;
      return result;
    });
  }

  nb::dict render_many(const PyScene& given, const std::vector<CameraChoice>& choices, const Size& pixels,
                       const std::vector<std::string>& outputs, const std::optional<Dict>& given_out,
                       const PyScene* motion_scene,
                       const std::optional<std::vector<CameraChoice>>& motion_cameras,
                       const std::optional<std::vector<Dict>>& given_poses, const nb::kwargs& arguments) {
    check_open();
    if (given_poses && (motion_scene || motion_cameras))
      throw Error("with poses, motion leads to the next picture; leave out motion_scene and motion_cameras");
    const glm::ivec2 size = pixels.read();
    const Scene scene = given.now();
    const Settings settings = settings_of(arguments, threads_);
    std::vector<Camera> cameras;
    for (const CameraChoice& choice : choices) cameras.push_back(camera_of(scene, choice));
    const Poses poses = given_poses ? poses_of(scene, choices, *given_poses) : Poses{};
    const std::size_t pictures = given_poses ? poses.pictures.size() : cameras.size();
    const Scene drawn = cameras.empty() ? scene : lit(scene, cameras.front());
    const nb::dict out = given_out ? given_out->read("out") : nb::dict();
    nb::dict result;
    FrameArrays to;
    to.mask_bytes = mask_bytes_of(drawn, settings, given_poses.has_value());
    for (const std::string& name : outputs) {
      const LayerRow& output = output_named(name);
      const std::vector<std::size_t> shape = shape_of(output, pictures, size, to.mask_bytes);
      result[name.c_str()] = out.contains(name.c_str()) ? given_array(output, shape, out[name.c_str()], to)
                                                        : new_array(output, shape, to);
    }
    if (pictures == 0) return result;
    const std::vector<MotionTo> motion = to.motion && !given_poses
                                             ? motions(scene, cameras, motion_scene, motion_cameras)
                                             : std::vector<MotionTo>();
    without_gil([&](Progress* progress) {
      const std::lock_guard lock(mutex_);
      check_open();
      return value_or_throw(
          given_poses
              ? pinocchio::render_many(*engine_, drawn, poses.pictures, size, settings, to, progress)
              : pinocchio::render_many(*engine_, drawn, cameras, size, settings, to, progress, motion));
    });
    return result;
  }

 private:
  void check_open() const {
    if (!engine_) throw Error("this Engine is closed; create another one");
    if (is_forked())
      throw Error("this Engine was created before the process was forked; create one in each process");
  }

  // Its threads are in the parent.
  [[nodiscard]] bool is_forked() const { return pid_ != getpid(); }

  int threads_;
  pid_t pid_ = getpid();
  std::mutex mutex_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace

void bind_engine(nb::module_& module) {
  static const std::string kRender =
      "Draws a picture and returns a Result.\n"
      "camera: a Camera, or the name or index of one of the scene's. None: the scene's first camera, or one "
      "that sees the\n"
      "whole scene.\n"
      "size: (width, height) in pixels.\n"
      "rays: (origins, directions) of the pixels, in place of the camera's and of size: arrays (height, "
      "width, "
      "3), or (n, 3)\n"
      "for a picture of one row, for a lidar say. One origin serves for all. Depth is then the distance.\n"
      "A scene without lights gets one above the camera. By default the CPU draws alone (mode='raytrace') "
      "and no OpenGL is\n"
      "needed.\n"
      "Raises Error if there is no such camera or setting, if settings contradict each other, or if OpenGL "
      "fails.\n"
      "Settings, those of the picture first:\n\n" +
      settings_help();
  static const std::string kRenderMany =
      "Draws a picture from each camera and returns {name: array (n, height, width, ...)}.\n"
      "outputs: names of " +
      array_names() +
      ",\n"
      "each as in Result. Other layers are not computed.\n"
      "out: the arrays of an earlier call, which are filled again.\n"
      "motion_scene, motion_cameras: the other pose of the scene, and a camera for each picture, that the "
      "output motion\n"
      "leads to. None: the scene, or the cameras, themselves.\n"
      "poses: what Scene.posed takes, for each picture; cameras are then one for each, or one for all, and "
      "those of the scene move\n"
      "with their nodes. The next pose is made while one is drawn. Motion leads to the next picture, and is "
      "0 "
      "in the last one.\n"
      "A scene without lights gets one above the first camera.\n"
      "Settings and errors as for render; Error too if an array of `out` has another shape or type, "
      "TypeError "
      "if it is no array\n"
      "of the CPU's memory. Small pictures keep all threads busy.";
  nb::class_<PyEngine> bound(
      module, "Engine",
      "Worker threads, the last scene's tree and, if the settings need it, an OpenGL context.\n"
      "Several threads may use an Engine; their calls are executed one after the other. A process may have "
      "several\n"
      "Engines. Create an Engine after a fork, not before it.");
  bound
      .def(nb::init<int, const std::string&, const std::string&>(), "threads"_a = 0, "backend"_a = "auto",
           "device"_a = "",
           "threads: the number of worker threads. 0: the environment variable PINOCCHIO_THREADS, else one "
           "for each core of the\n"
           "process. If several processes share a machine, give each its share.\n"
           "backend: of OpenGL: 'auto', 'egl', 'osmesa' or 'glfw'. device: an EGL device's number or "
           "'software'.\n"
           "Raises Error if threads is not 0 to 1024, or if there is no such backend.")
      .def_prop_ro("threads", &PyEngine::threads, "The number of worker threads.")
      .def("close", &PyEngine::close,
           "Ends the threads and frees the tree and the OpenGL context. Later pictures raise Error. `with "
           "Engine() as "
           "engine:`\n"
           "closes it at the end of the block.")
      .def(
          "__enter__", [](nb::handle self) { return nb::borrow(self); },
          nb::sig("def __enter__(self) -> Engine"))
      .def(
          "__exit__", [](PyEngine& engine, const nb::args&) { engine.close(); },
          nb::sig("def __exit__(self, *exception: object) -> None"))
      .def("__repr__",
           [](const PyEngine& engine) {
             return engine.is_closed() ? std::string("<Engine, closed>")
                                       : "<Engine: " + std::to_string(engine.threads()) + " threads>";
           })
      .def("render", &PyEngine::render, "scene"_a, "camera"_a = nb::none(), "size"_a = glm::ivec2(800, 600),
           "rays"_a = nb::none(), "settings"_a,
           nb::sig("def render(self, scene: Scene, camera: Camera | int | str | None = None, size: "
                   "collections.abc.Sequence[int] = (800, 600), rays: tuple[numpy.typing.ArrayLike, "
                   "numpy.typing.ArrayLike] | None = None, **settings: object) -> Result"),
           kRender.c_str())
      .def("render_many", &PyEngine::render_many, "scene"_a, "cameras"_a, "size"_a = glm::ivec2(800, 600),
           "outputs"_a = std::vector<std::string>{"color"}, "out"_a = nb::none(),
           "motion_scene"_a.none() = nb::none(), "motion_cameras"_a = nb::none(), "poses"_a = nb::none(),
           "settings"_a,
           nb::sig(
               "def render_many(self, scene: Scene, cameras: collections.abc.Sequence[Camera | int | str | "
               "None], "
               "size: collections.abc.Sequence[int] = (800, 600), outputs: collections.abc.Sequence[str] = "
               "('color',), out: collections.abc.Mapping[str, typing.Any] | None = None, motion_scene: Scene "
               "| "
               "None = None, motion_cameras: collections.abc.Sequence[Camera | int | str | None] | None = "
               "None, poses: collections.abc.Sequence[collections.abc.Mapping[str, numpy.typing.ArrayLike] | "
               "collections.abc.Mapping[int, numpy.typing.ArrayLike]] | None = None, **settings: object) -> "
               "dict[str, numpy.typing.NDArray[typing.Any]]"),
           kRenderMany.c_str());
  def_no_pickle(bound, "an Engine does not pickle, as it has threads: create one in each process");
}

}  // namespace pinocchio::python
