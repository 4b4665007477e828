#include "app/cli/console.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <string_view>

#include "app/cli/errors.h"
#include "core/files/part_file.h"

namespace pinocchio::app {
namespace {

constexpr std::array kInterrupts{SIGINT, SIGTERM, SIGHUP};
// Less than the second a caller may wait: the system needs time to free gigabytes.
constexpr long kGrace_ns = 500'000'000;
constexpr std::string_view kInterruptedLine = "pinocchio: interrupted; what was finished is kept\n";
// Some programs send a signal to the process and to its group: both count as one.
constexpr long kOneSignal_ns = 50'000'000;

pinocchio::Progress progress_of_run;
timer_t deadline;
volatile std::sig_atomic_t signalled = 0;
timespec first_signal;

// Signal handlers call only functions that POSIX allows there.
void end_at_once(int) {
  remove_part_files();
  (void)!write(STDERR_FILENO, kInterruptedLine.data(), kInterruptedLine.size());
  _exit(kInterrupted);
}

void on_interrupt(int) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (signalled == 0) {
    signalled = 1;
    first_signal = now;
    progress_of_run.cancel();
    const itimerspec grace{{0, 0}, {0, kGrace_ns}};
    timer_settime(deadline, 0, &grace, nullptr);
    return;
  }
  const long since_ns =
      (now.tv_sec - first_signal.tv_sec) * 1'000'000'000L + (now.tv_nsec - first_signal.tv_nsec);
  if (since_ns > kOneSignal_ns) end_at_once(0);
}

}  // namespace

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void print_warning(const std::string& warning) {
  std::fprintf(stderr, "pinocchio: warning: %s\n", warning.c_str());
}

void print_warnings(const Warnings& warnings) {
  for (const Warning& warning : warnings) print_warning(warning.message());
}

void catch_interrupts() {
  (void)timer_create(CLOCK_MONOTONIC, nullptr, &deadline);  // sends SIGALRM
  struct sigaction action {};
  sigemptyset(&action.sa_mask);
  for (const int signal : kInterrupts) sigaddset(&action.sa_mask, signal);
  action.sa_flags = SA_RESTART;
  action.sa_handler = end_at_once;
  sigaction(SIGALRM, &action, nullptr);
  action.sa_handler = on_interrupt;
  for (const int signal : kInterrupts) {
    struct sigaction inherited {};
    sigaction(signal, nullptr, &inherited);
    if (signal == SIGHUP && inherited.sa_handler == SIG_IGN) continue;  // nohup
    sigaction(signal, &action, nullptr);
  }
}

pinocchio::Progress& run_progress() {
  return progress_of_run;
}

bool interrupted() {
  return progress_of_run.cancelled();
}

Progress::Progress(const std::string& mode, std::string what, std::size_t total)
    : shown_(mode == "on" || (mode == "auto" && isatty(STDERR_FILENO) != 0)),
      what_(std::move(what)),
      total_(total) {
  draw();
}

Progress::~Progress() {
  if (shown_) std::fprintf(stderr, "\r\033[K");
}

void Progress::step() {
  ++done_;
  draw();
}

void Progress::draw() const {
  if (!shown_) return;
  constexpr std::size_t kWidth = 30;
  const std::size_t filled = total_ == 0 ? kWidth : done_ * kWidth / total_;
  std::fprintf(stderr, "\r%s [%s%s] %zu/%zu", what_.c_str(), std::string(filled, '#').c_str(),
               std::string(kWidth - filled, '.').c_str(), done_, total_);
}

}  // namespace pinocchio::app
