// pinocchio VERB SCENE [options]
#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "app/console.h"
#include "app/errors.h"
#include "app/verbs.h"
#include "core/base/system_info.h"
#include "pinocchio/open_gl_error.h"
#include "pinocchio/progress.h"
#include "pinocchio/threads.h"

namespace pinocchio::app {
namespace {

int say(const std::string& line, ExitCode code) {
  std::fprintf(stderr, "pinocchio: %s\n", one_line(line).c_str());
  return code;
}

// What was printed must have arrived: a full disk shows when it is flushed at the latest.
int flushed(int code) {
  std::cout.flush();
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return code;
  const std::string why = errno != 0 ? std::strerror(errno) : "it is full or closed";
  return say("standard output cannot be written: " + why, code == kDone ? kFailed : ExitCode(code));
}

// The verbs' errors end here, each as one line and its exit code.
int run_verb(const Run& run) {
  try {
    return run();
  } catch (const Exit& end) {
    return say(end.what(), end.code());
  } catch (const Cancelled&) {
    return say("interrupted; what was finished is kept", kInterrupted);
  } catch (const NoOpenGlError& error) {
    return say(error.what(), kNoContext);
  } catch (const std::bad_alloc&) {
    return say("out of memory; a smaller --size, a --crop or fewer triangles need less", kFailed);
  } catch (const std::exception& error) {
    return say(error.what(), kFailed);
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App program("Pinocchio: a CPU ray tracer and OpenGL sharing every frame", "pinocchio");
  program.set_version_flag("--version", std::string("pinocchio ") + version());
  program.require_subcommand(1);
  program.failure_message([](const CLI::App*, const CLI::Error&) { return std::string(); });
  const std::vector<std::pair<std::string, Run>> verbs{
      {"render", add_render(program)},    {"view", add_view(program)},
      {"measure", add_measure(program)},  {"chart", add_chart(program)},
      {"compare", add_compare(program)},  {"info", add_info(program)},
      {"generate", add_generate(program)}};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return flushed(program.exit(error));  // --help, --version
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const std::string verb = chosen.empty() ? "" : " " + chosen.front()->get_name();
    if (chosen.empty() && argc > 1 && argv[1][0] != '-')
      return say(std::string("'") + argv[1] + "' is no verb; 'pinocchio --help' lists them", kUsage);
    return say(std::string(error.what()) + "; 'pinocchio" + verb + " --help' tells what there is", kUsage);
  }
  catch_interrupts();
  set_thread_warning([](const char* line) { std::fprintf(stderr, "pinocchio: warning: %s\n", line); });
  for (const auto& [name, run] : verbs)
    if (program.got_subcommand(name)) return flushed(run_verb(run));
  return kUsage;
}

}  // namespace
}  // namespace pinocchio::app

int main(int argc, char** argv) {
  // Writing beyond a limit is then an error that names the file, as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return pinocchio::app::parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {  // before a verb runs
    return pinocchio::app::say("out of memory", pinocchio::app::kFailed);
  }
}
