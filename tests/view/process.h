// Programs that run beside a test, and waiting for what they do.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace pinocchio {

inline void pause_ms(int ms) {
  std::this_thread::sleep_for(std::chrono::milliseconds(ms));
}

// Looks again and again until it holds; false after `seconds`.
template <class Condition>
bool becomes(Condition holds, double seconds = 60.0) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::milliseconds(static_cast<int>(1e3 * seconds));
  while (!holds()) {
    if (Clock::now() >= end) return false;
    pause_ms(20);
  }
  return true;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A program that runs beside the test; killed at the end.
class Process {
 public:
  // environment: "NAME=VALUE"; an empty value takes the name out.
  Process(const std::vector<std::string>& command, const std::filesystem::path& folder,
          const std::vector<std::string>& environment, const std::filesystem::path& out,
          const std::filesystem::path& err) {
    id_ = fork();
    if (id_ != 0) return;
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing outlives the test
    for (const std::string& setting : environment) {
      const std::size_t at = setting.find('=');
      if (at + 1 == setting.size()) {
        unsetenv(setting.substr(0, at).c_str());
      } else {
        setenv(setting.substr(0, at).c_str(), setting.substr(at + 1).c_str(), 1);
      }
    }
    redirect(out, STDOUT_FILENO);
    redirect(err, STDERR_FILENO);
    if (chdir(folder.c_str()) != 0) _exit(126);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments.front(), arguments.data());
    _exit(127);
  }
  ~Process() {
    if (!running()) return;
    kill(id_, SIGTERM);  // an X server tidies up
    if (wait(10.0) != -2) return;
    kill(id_, SIGKILL);
    (void)wait(30.0);
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] pid_t id() const { return id_; }
  void signal(int number) const { kill(id_, number); }
  [[nodiscard]] bool running() {
    int status = 0;
    if (!status_ && waitpid(id_, &status, WNOHANG) == id_) status_ = status;
    return !status_;
  }
  // Its exit code; -1: it was ended by a signal; -2: it still runs.
  [[nodiscard]] int wait(double seconds = 60.0) {
    if (!becomes([this] { return !running(); }, seconds)) return -2;
    return WIFEXITED(*status_) ? WEXITSTATUS(*status_) : -1;
  }
  // Processor time of all cores since it began.
  [[nodiscard]] double cpu_s() const {
    const std::string stat = text_of("/proc/" + std::to_string(id_) + "/stat");
    std::istringstream rest(stat.substr(stat.rfind(')') + 2));
    std::string skipped;
    for (int field = 3; field < 14; ++field) rest >> skipped;  // proc(5): utime is the 14th
    double user = 0.0, system = 0.0;
    rest >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }
  // Whether one of its threads works, or waits for a processor or a disk.
  [[nodiscard]] bool busy() const {
    std::error_code gone;
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(id_) + "/task", gone)) {
      const std::string stat = text_of(thread.path() / "stat");  // proc(5): "id (name) state ..."
      const std::size_t name_end = stat.rfind(')');
      if (name_end == std::string::npos) continue;  // it has ended
      const char state = stat[name_end + 2];
      if (state == 'R' || state == 'D') return true;
    }
    return false;
  }
  // Resident memory, MB.
  [[nodiscard]] double memory_mb() const {
    std::ifstream in("/proc/" + std::to_string(id_) + "/statm");
    long long pages = 0, resident = 0;
    in >> pages >> resident;
    return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
  }

 private:
  static void redirect(const std::filesystem::path& file, int to) {
    const int opened = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    dup2(opened, to);
  }

  pid_t id_ = 0;
  std::optional<int> status_;
};

}  // namespace pinocchio
