// view: the window.
#include <malloc.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "app/run/output.h"
#include "app/verbs/verbs.h"
#include "app/window/session.h"
#include "core/files/atomic_file.h"
#include "gl/context/error.h"

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

// For hours, pictures of many sizes are allocated and freed. With pages of its own, each returns its memory
// to the system; in glibc's heap they would leave gaps.
void avoid_fragmentation() {
  constexpr int kOwnPages_bytes = 256 * 1024;
  mallopt(M_MMAP_THRESHOLD, kOwnPages_bytes);
}

int view(const ViewOptions& options) {
  avoid_fragmentation();
  if (const Rule* const rule = broken_rule(options.draw.settings))
    throw Exit(
        kUsage,
        InputError{options.draw.plan_file, 0, std::string(rule->what), std::string(rule->remedy)}.message());
  check_apart({{"the scene", options.draw.scene},
               {"--plan", options.draw.plan_file},
               {"--environment", options.draw.environment}},
              {{"--stats-json", options.stats_json}});
  if (!options.stats_json.empty()) check_writable(options.stats_json);
  const std::unique_ptr<gl::Window> window = open_window(options);
  bool is_loading = false;
  ExitCode scene_code = kDone;
  {
    Session session(*window, options);
    session.run();
    is_loading = session.is_loading();
    scene_code = session.code();
    std::vector<NamedFile> inputs;
    for (const std::string& file : session.scene().source_files) inputs.push_back({"the scene's", file});
    check_apart(inputs, {{"--stats-json", options.stats_json}});
    if (!options.stats_json.empty()) write_json(options.stats_json, session.pace().json());
  }
  window->context().throw_complaints();
  const int code = interrupted() ? kInterrupted : scene_code;
  if (!is_loading) return code;
  // A thread still reads a scene that is not wanted any more, and may lock files: only what was printed is
  // flushed.
  std::fflush(stdout);
  std::_Exit(code);
}

}  // namespace

Run add_view(CLI::App& program) {
  auto options = std::make_shared<ViewOptions>();
  CLI::App& verb = *program.add_subcommand("view", "show a scene in a window (F1: its keys)");
  add_scene_options(verb, options->draw);
  add_size_option(verb, options->draw, "size of the picture in the window, pixels (800x600)");
  add_settings_options(verb, options->draw);
  add_studio_option(verb, options->draw, true);
  add_budget_options(verb, options->budget);
  add_display_options(verb, options->exposure_ev, options->tone_map, kMostExposure);
  begin_group(verb, kOtherGroup);
  verb.add_option("--stats-json", options->stats_json,
                  "write as JSON how quickly the window responded, when it is closed");
  verb.add_flag("--watch", options->watch,
                "load the scene again when its files change, and the shaders in PINOCCHIO_SHADERS");
  verb.add_flag("!--no-vsync", options->vsync, "do not wait for the display between frames");
  return [options] { return view(*options); };
}

}  // namespace pinocchio::app
