// pinocchio VERB SCENE [options]
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/errors.h"
#include "app/cli/groups.h"
#include "app/cli/options.h"
#include "app/verbs/verbs.h"
#include "core/base/system_info.h"
#include "pinocchio/open_gl_error.h"
#include "pinocchio/progress.h"
#include "pinocchio/threads.h"

namespace pinocchio::app {
namespace {

int fail(const std::string& line, ExitCode code) {
  std::fprintf(stderr, "pinocchio: %s\n", one_line(line).c_str());
  return code;
}

// A full disk may show only when standard output is flushed.
int code_after_flush(int code) {
  std::cout.flush();
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return code;
  if (code != kDone) return code;  // the verb's own line says why
  const std::string why = errno != 0 ? std::strerror(errno) : "it is full or closed";
  return fail("standard output cannot be written: " + why, kFailed);
}

// Turns a verb's errors into one line and an exit code.
int run_verb(const Run& run) {
  try {
    return run();
  } catch (const Exit& end) {
    return fail(end.what(), end.code());
  } catch (const Cancelled&) {
    return fail("interrupted; what was finished is kept", kInterrupted);
  } catch (const NoOpenGlError& error) {
    return fail(error.what(), kNoContext);
  } catch (const std::bad_alloc&) {
    return fail("out of memory; use a smaller --size, a --crop or fewer triangles", kFailed);
  } catch (const std::exception& error) {
    return fail(error.what(), kFailed);
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App program("Pinocchio: a renderer whose frames a CPU ray tracer and OpenGL share", "pinocchio");
  program.set_version_flag("--version", std::string("pinocchio ") + version());
  program.require_subcommand(1);
  program.formatter(std::make_shared<GroupedHelp>());
  program.failure_message([](const CLI::App*, const CLI::Error&) { return std::string(); });
  const std::vector<std::pair<std::string, Run>> verbs{
      {"render", add_render(program)},    {"view", add_view(program)},
      {"measure", add_measure(program)},  {"chart", add_chart(program)},
      {"compare", add_compare(program)},  {"info", add_info(program)},
      {"generate", add_generate(program)}};
  try {
    std::vector<std::string> arguments = with_values({argv + 1, argv + argc});
    std::ranges::reverse(arguments);  // as CLI11 takes them
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return code_after_flush(program.exit(error));  // --help, --version
    const std::vector<CLI::App*> chosen = program.get_subcommands();
    const std::string verb = chosen.empty() ? "" : " " + chosen.front()->get_name();
    if (chosen.empty() && argc > 1 && argv[1][0] != '-')
      return fail(std::string("'") + argv[1] + "' is not a verb; 'pinocchio --help' lists them", kUsage);
    return fail(std::string(error.what()) + "; 'pinocchio" + verb + " --help' lists the options", kUsage);
  }
  catch_interrupts();
  set_thread_warning([](const char* line) { print_warning(line); });
  for (const auto& [name, run] : verbs)
    if (program.got_subcommand(name)) return code_after_flush(run_verb(run));
  return kUsage;
}

}  // namespace
}  // namespace pinocchio::app

int main(int argc, char** argv) {
  // Writing beyond a limit becomes an error that names the file, as for a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return pinocchio::app::parse_and_run(argc, argv);
  } catch (const std::bad_alloc&) {  // before a verb runs
    return pinocchio::app::fail("out of memory", pinocchio::app::kFailed);
  }
}
