#include "gl/open/apart.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

namespace pinocchio::gl {
namespace {

void write_all(int file, const std::string& text) {
  const char* at = text.data();
  std::size_t left = text.size();
  while (left > 0) {
    const ssize_t written = write(file, at, left);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += written;
    left -= written;
  }
}

// The child does not flush, close or handle anything of the parent.
[[noreturn]] void run_child(int to_parent, const std::function<void(const Report&)>& act) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  try {
    act([to_parent](const std::string& text) { write_all(to_parent, text + '\0'); });
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

// Reads until the other end is closed. False: it took longer than `seconds`.
bool read_all(int from, int seconds, std::string& text) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  std::array<char, 4096> part{};
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd waited{from, POLLIN, 0};
    const int ready = left > 0 ? poll(&waited, 1, int(left)) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    const ssize_t n = read(from, part.data(), part.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    text.append(part.data(), n);
  }
}

std::string failure_of(int status) {
  if (WIFSIGNALED(status)) return std::string("it crashes: ") + strsignal(WTERMSIG(status));
  return WEXITSTATUS(status) == 0 ? "" : "it ends the process that tries it";
}

}  // namespace

Apart try_apart(const std::function<void(const Report&)>& act, int seconds) {
  Apart result;
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    result.failure = std::string("no pipe to a process: ") + std::strerror(errno);
    return result;
  }
  const pid_t child = fork();
  if (child == 0) run_child(ends[1], act);
  close(ends[1]);
  if (child < 0) {
    result.failure = std::string("no process can be started: ") + std::strerror(errno);
    close(ends[0]);
    return result;
  }
  std::string text;
  const bool ended = read_all(ends[0], seconds, text);
  close(ends[0]);
  if (!ended) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  result.failure = ended ? failure_of(status) : "it hangs: no answer in " + std::to_string(seconds) + " s";
  for (std::size_t begin = 0, end = 0; (end = text.find('\0', begin)) != std::string::npos; begin = end + 1)
    result.reports.push_back(text.substr(begin, end - begin));
  return result;
}

}  // namespace pinocchio::gl
