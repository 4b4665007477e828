#include "app/options.h"

#include <cstdio>

#include "app/errors.h"
#include "app/parse.h"
#include "core/scene/load.h"

namespace pinocchio::app {
namespace {

// An option whose text `parse` turns into a value; anything else is a usage error that says what is wanted.
template <class T, class Parse, class Store>
CLI::Option* add_parsed(CLI::App& verb, const std::string& name, const std::string& help,
                        const std::string& wanted, Parse parse, Store store) {
  const auto take = [=](const std::string& text) {
    const std::optional<T> value = parse(text);
    if (!value) throw CLI::ValidationError(name, "'" + text + "' is not " + wanted);
    store(*value);
  };
  return verb.add_option_function<std::string>(name, take, help)->type_name(wanted);
}

void add_vec3(CLI::App& verb, const std::string& name, const std::string& help,
              std::optional<glm::vec3>& to) {
  add_parsed<glm::vec3>(verb, name, help, "x,y,z", parse_vec3, [&to](const glm::vec3& v) { to = v; });
}

std::optional<Mode> parse_mode(const std::string& text) {
  for (const Mode mode : {Mode::hybrid, Mode::raytrace, Mode::raster})
    if (text == mode_name(mode)) return mode;
  return std::nullopt;
}

std::optional<Exchange> parse_exchange(const std::string& text) {
  for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject})
    if (text == exchange_name(exchange)) return exchange;
  return std::nullopt;
}

std::optional<glm::ivec2> parse_picture_size(const std::string& text) {
  const std::optional<glm::ivec2> size = parse_size(text);
  if (!size || size->x < 1 || size->y < 1 || size->x > kMaxSide || size->y > kMaxSide) return std::nullopt;
  return static_cast<long long>(size->x) * size->y <= kMaxPixels ? size : std::nullopt;
}

void add_picture_options(CLI::App& verb, DrawOptions& o) {
  add_parsed<Mode>(verb, "--mode", "who draws: both, CPU alone, GPU alone (hybrid)",
                   "hybrid, raytrace or raster", parse_mode, [&o](Mode v) { o.mode = v; });
  verb.add_option("--design", o.design, "where the parts meet: 1, on the GPU; 2, on the CPU (1)")
      ->check(CLI::Range(1, 2));
  add_parsed<Exchange>(
      verb, "--exchange",
      "sync: wait for the CPU; pipelined: its part comes two frames later, GPU and CPU work on "
      "different frames; reproject: newest raster, the last mask and reflection warped to it (pipelined over "
      "frame ranges, sync for one frame)",
      "sync, pipelined or reproject", parse_exchange, [&o](Exchange v) { o.exchange = v; });
  verb.add_option_function<std::string>(
          "--plan",
          [&o](const std::string& text) {
            o.slides = text == "slides";
            if (text.ends_with(".json")) {
              o.plan_file = text;
            } else if (text != "auto" && !o.slides) {
              throw CLI::ValidationError("--plan",
                                         "'" + text + "' is not auto, slides or a plan's FILE.json");
            }
          },
          "auto: model and send only what the scene needs; slides: the fixed bytes of 2005; FILE.json: a "
          "plan, as 'info SCENE --plan --json' writes it; it says mode, design and depth too (auto)")
      ->type_name("auto|slides|FILE.json");
  add_parsed<PixelBox>(verb, "--crop",
                       "half-open pixel box; the EXR keeps the full displayWindow (whole frame)",
                       "x0,y0,x1,y1", parse_box, [&o](const PixelBox& v) { o.crop = v; });
  verb.add_option("--spp", o.spp, "jittered samples a pixel, averaged in linear light (1)")
      ->check(CLI::Range(1, 65536));
  verb.add_option("--depth", o.depth, "most bounces (8)")->check(CLI::Range(0, kMostBounces));
  verb.add_flag(
      "--precise", o.precise,
      "with --mode raytrace: the reference, in double precision, without shortcuts; slow, and in glass "
      "twice the time with each bounce");
  verb.parse_complete_callback([&o, &verb] {
    for (const char* said : {"--mode", "--design", "--depth"})
      if (!o.plan_file.empty() && verb.count(said) > 0)
        throw CLI::ValidationError(said,
                                   "is what " + o.plan_file + " says; change it there, or leave out --plan");
    if (o.precise && o.mode != Mode::raytrace)
      throw CLI::ValidationError(
          "--precise", "draws with --mode raytrace alone, not with " + std::string(mode_name(o.mode)));
  });
}

void add_camera_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("--camera", o.camera,
                  "one of the scene's, by name or number from 0 (first; whole scene in view)");
  add_vec3(verb, "--eye", "camera position, scene units", o.eye);
  add_vec3(verb, "--target", "what the camera looks at", o.target);
  add_vec3(verb, "--up", "which way is up (0,1,0)", o.up);
  add_parsed<float>(
      verb, "--fov", "vertical field of view, degrees", "between 0 and 180",
      [](const std::string& s) {
        const std::optional<float> v = parse_float(s);
        return v && *v > 0.0f && *v < 180.0f ? v : std::nullopt;
      },
      [&o](float v) { o.fov_deg = v; })
      ->type_name("DEG");
  const auto take_lights = [&o](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::optional<Light> light = parse_light(text);
      if (!light)
        throw CLI::ValidationError("--light", "'" + text + "' is not x,y,z[,intensity[,cast|nocast]]");
      o.lights.push_back(*light);
    }
  };
  verb.add_option_function<std::vector<std::string>>(
          "--light", take_lights, "add a point light, same strength at any distance (repeatable)")
      ->type_name("x,y,z[,intensity[,cast|nocast]]")
      ->expected(1)
      ->take_all();
}

void add_gl_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("--backend", o.backend, "OpenGL context: auto, egl, osmesa (auto)")
      ->check(CLI::IsMember({"auto", "egl", "osmesa"}))
      ->envname("PINOCCHIO_BACKEND");
  verb.add_option("--device", o.device, "EGL device number, or software")
      ->check([](const std::string& text) {
        const std::optional<int> number = parse_int(text);
        return text == "software" || (number && *number >= 0)
                   ? std::string()
                   : "'" + text +
                         "' is not a device number or software ('pinocchio info --system' lists them)";
      })
      ->envname("PINOCCHIO_DEVICE");
  verb.add_option("--gl-threads", o.gl_threads,
                  "threads of a software rasteriser (its own choice: all cores)")
      ->check(CLI::Range(1, 32));
}

void add_tracer_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option_function<int>(
          "--threads", [&o](int threads) { o.threads = o.tree.threads = threads; },
          "worker threads (all cores)")
      ->type_name("INT")
      ->check(CLI::Range(1, kMostThreads));
  add_parsed<Isa>(verb, "--isa", "SIMD level, never above what the processor has (the fastest measured)",
                  "scalar, sse4, avx2 or avx512", parse_isa, [&o](Isa v) {
                    if (!isa_supported(v))
                      throw CLI::ValidationError("--isa",
                                                 "this processor does not have " + std::string(isa_name(v)));
                    o.isa = v;
                  });
  add_parsed<SplitRule>(verb, "--tree", "how the BSP tree is split (sah)",
                        "sah, spatial-median or object-median", parse_split_rule,
                        [&o](SplitRule v) { o.tree.rule = v; });
  add_parsed<TriangleTest>(verb, "--triangle-test",
                           "how a ray meets a triangle (filtered: safe, docs/stability.md)",
                           "projected, moeller-trumbore, watertight or filtered", parse_triangle_test,
                           [&o](TriangleTest v) { o.tree.triangle_test = v; });
  add_parsed<OffsetMethod>(
      verb, "--offset",
      "how far off a surface its shadow and mirrored rays start: one length, one a scene, or "
      "what rounding can do there (error-bound)",
      "fixed, scaled or error-bound", parse_offset_method, [&o](OffsetMethod v) { o.offset = v; });
  verb.add_option("--tree-depth", o.tree.max_depth, "most levels of the BSP tree (from the triangle count)")
      ->check(CLI::Range(1, kMaxTreeDepth));
  verb.add_option("--tree-leaf", o.tree.leaf_size, "triangles that are not split further (2)")
      ->check(CLI::Range(1, 1 << 20));
}

}  // namespace

void add_size_option(CLI::App& verb, DrawOptions& o, const std::string& help) {
  add_parsed<glm::ivec2>(verb, "--size", help,
                         "WxH, each from 1 to " + std::to_string(kMaxSide) + " and at most " +
                             std::to_string(kMaxPixels) + " pixels",
                         parse_picture_size, [&o](glm::ivec2 v) { o.size = v; })
      ->type_name("WxH");
}

void add_scene_options(CLI::App& verb, DrawOptions& o) {
  verb.add_option("SCENE", o.scene, "glTF (.gltf, .glb) or OBJ file")->required();
  add_camera_options(verb, o);
  add_gl_options(verb, o);
  verb.add_flag("--quiet", o.quiet, "print errors only");
  verb.add_option("--progress", o.progress, "progress bar: auto (on a terminal), on, off (auto)")
      ->check(CLI::IsMember({"auto", "on", "off"}));
}

void add_draw_options(CLI::App& verb, DrawOptions& o) {
  add_scene_options(verb, o);
  add_size_option(verb, o, "pixels (800x600)");
  add_picture_options(verb, o);
  add_tracer_options(verb, o);
}

Scene load_scene_for(const DrawOptions& options) {
  std::vector<std::string> warnings;
  Scene scene = value_or_exit(load_scene(options.scene, &warnings), kBadScene);
  if (!options.quiet)
    for (const std::string& warning : warnings)
      std::fprintf(stderr, "pinocchio: warning: %s\n", warning.c_str());
  scene.lights.insert(scene.lights.end(), options.lights.begin(), options.lights.end());
  if (scene.lights.empty()) {
    scene.lights.push_back(default_light(scene, camera_for(options, scene)));
    if (!options.quiet)
      std::fprintf(stderr, "pinocchio: %s has no light; a default one is used (add one with --light x,y,z)\n",
                   scene.source.c_str());
  }
  return scene;
}

Camera camera_for(const DrawOptions& options, const Scene& scene) {
  Camera camera = scene.cameras.empty() ? camera_for_whole_scene(scene) : scene.cameras.front();
  if (!options.camera.empty()) {
    const std::optional<int> number = parse_int(options.camera);
    const Camera* found = find_camera(scene, options.camera);
    if (!found && number && *number >= 0 && static_cast<std::size_t>(*number) < scene.cameras.size())
      found = &scene.cameras[static_cast<std::size_t>(*number)];
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
  if (options.up) camera.up = *options.up;
  if (options.fov_deg) camera.fov_deg = *options.fov_deg;
  if (camera.eye == camera.target)
    throw Exit(kUsage, "--eye and --target are the same point; move one of them");
  return camera;
}

}  // namespace pinocchio::app
