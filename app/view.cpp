// view: the window.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/console.h"
#include "app/errors.h"
#include "app/output.h"
#include "app/parse.h"
#include "app/verbs.h"
#include "app/window/session.h"
#include "core/image/atomic_file.h"
#include "gl/error.h"

namespace pinocchio::app {
namespace {

std::unique_ptr<gl::Window> open_window(const ViewOptions& options) {
  try {
    return std::make_unique<gl::Window>("Pinocchio", options.draw.size,
                                        std::getenv("PINOCCHIO_GL_DEBUG") != nullptr);
  } catch (const gl::NoContextError& error) {
    throw Exit(kNoContext, std::string(error.what()) + "; 'pinocchio render " + options.draw.scene +
                               " --preview picture.png' draws without a display");
  }
}

// Pictures of all sizes come and go for hours. Each gets pages of its own, which go back to the system with
// it; glibc would soon keep them between those that stay.
void keep_memory_whole() {
  constexpr int kOwnPages_bytes = 256 * 1024;
  mallopt(M_MMAP_THRESHOLD, kOwnPages_bytes);
}

int view(const ViewOptions& options) {
  keep_memory_whole();
  if (const Rule* const rule = broken_rule(options.draw.settings))
    throw Exit(
        kUsage,
        InputError{options.draw.plan_file, 0, std::string(rule->what), std::string(rule->remedy)}.message());
  check_apart({{"the scene", options.draw.scene}}, {{"--stats-json", options.stats_json}});
  if (!options.stats_json.empty()) check_writable(options.stats_json);
  const std::unique_ptr<gl::Window> window = open_window(options);
  bool loading = false;
  {
    Session session(*window, options);
    session.run();
    loading = session.loading();
    std::vector<NamedFile> inputs;
    for (const std::string& file : session.scene().source_files) inputs.push_back({"the scene's", file});
    check_apart(inputs, {{"--stats-json", options.stats_json}});
    if (!options.stats_json.empty()) write_json(options.stats_json, session.pace().json());
  }
  window->context().throw_complaints();
  const int code = interrupted() ? kInterrupted : kDone;
  if (!loading) return code;
  // A scene is still being read that nobody wants any more; nothing is left to be written but what was
  // printed: other files may be locked by who reads them.
  std::fflush(stdout);
  std::_Exit(code);
}

}  // namespace

Run add_view(CLI::App& program) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& verb = *program.add_subcommand("view", "open a scene in a window (F1 there: the keys)");
  add_scene_options(verb, options->draw);
  add_size_option(verb, options->draw, "pixels of the window's inside (800x600)");
  add_settings_options(verb, options->draw);
  add_budget_options(verb, options->budget);
  verb.add_option("--exposure", options->exposure_ev, "stops brighter (0)")
      ->check([](const std::string& text) {
        const std::optional<float> value = parse_float(text);  // CLI::Range lets NaN through
        return value && std::abs(*value) <= kMostExposure
                   ? std::string()
                   : "'" + text + "' is no number of stops that is shown";
      });
  add_tone_map_option(verb, options->tone_map);
  verb.add_option("--stats-json", options->stats_json,
                  "write how quickly the window answered as JSON, when it is closed");
  verb.add_flag("--watch", options->watch,
                "load the scene anew when its files change, and the shaders in PINOCCHIO_SHADERS");
  verb.add_flag("!--no-vsync", options->vsync, "do not wait for the display between frames");
  return [options] { return view(*options); };
}

}  // namespace pinocchio::app
