#include "bench/chart/page.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <string>
#include <system_error>
#include <thread>

#include "pinocchio/error.h"

namespace pinocchio::chart {
namespace {

constexpr int kNoMatplotlib = 3;  // plot.py's exit code
constexpr int kNoProgram = 127;   // the shell's
// The first may lack the system's packages.
constexpr std::array kPythons{"python3", "/usr/bin/python3"};

// The script beside the installed program, else in the source tree.
std::filesystem::path plot_script() {
  std::error_code unknown;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
  const std::filesystem::path installed =
      program.parent_path().parent_path() / "share/pinocchio/chart/plot.py";
  if (!unknown && std::filesystem::exists(installed, unknown)) return installed;
  return PINOCCHIO_CHART_SOURCE_DIR "/plot.py";
}

// The exit code; 127: there is no such program; 128: a signal ended it.
int run(const char* program, std::string script, std::string folder, const Progress& progress) {
  std::string name = program;
  const std::array<char*, 4> arguments{name.data(), script.data(), folder.data(), nullptr};
  const pid_t child = fork();
  if (child < 0) return kNoProgram;
  if (child == 0) {  // only functions that may be called between fork and exec
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execvp(program, arguments.data());
    _exit(kNoProgram);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (progress.cancelled()) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      throw Cancelled();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

}  // namespace

bool draw_page(const std::filesystem::path& folder, const Progress& progress) {
  const std::filesystem::path script = plot_script();
  for (const char* python : kPythons) {
    const int code = run(python, script.string(), folder.string(), progress);
    if (code == 0) return true;
    if (code != kNoMatplotlib && code != kNoProgram)
      throw EnvironmentError(script.string() + ": failed (exit code " + std::to_string(code) +
                             "), so no page was drawn; results.json and results.csv in " + folder.string() +
                             " are whole");
  }
  return false;
}

}  // namespace pinocchio::chart
