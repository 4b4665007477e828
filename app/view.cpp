// view: the window.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "app/console.h"
#include "app/errors.h"
#include "app/parse.h"
#include "app/verbs.h"
#include "app/window/session.h"
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

int view(const ViewOptions& options) {
  if (const Rule* const rule = broken_rule(options.draw.settings))
    throw Exit(kUsage, InputError{options.draw.plan_file, 0, std::string(rule->what), std::string(rule->remedy)}
                           .message());
  const std::unique_ptr<gl::Window> window = open_window(options);
  bool loading = false;
  {
    Session session(*window, options);
    session.run();
    loading = session.loading();
  }
  window->context().throw_complaints();
  const int code = interrupted() ? kInterrupted : kDone;
  if (!loading) return code;
  // A scene is still being read that nobody wants any more; nothing is left to be written.
  std::fflush(nullptr);
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
        return value && std::abs(*value) <= kMostExposure ? std::string() : "'" + text + "' is no number of stops that is shown";
      });
  verb.add_flag("--watch", options->watch, "load the scene anew when its files change, and the shaders in PINOCCHIO_SHADERS");
  verb.add_flag("!--no-vsync", options->vsync, "do not wait for the display between frames");
  return [options] { return view(*options); };
}

}  // namespace pinocchio::app
