// A signal ends every verb soon, wherever it is; a second one ends it at once. Nothing half stays.
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <chrono>
#include <limits>
#include <thread>
#include <vector>

#include "core/base/clock.h"
#include "tests/app/program_test.h"

namespace pinocchio {
namespace {

// Limits of processor time, of all threads: the clock would also count how long they waited for a core.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kSoon_s = 10.0;  // of a sanitized program
#else
constexpr double kSoon_s = 2.0;
#endif
constexpr double kHangs_s = 20.0;  // by the clock: then it waits for something

class InterruptTest : public ProgramTest {
 protected:
  // Begins the program; its output is dropped.
  [[nodiscard]] pid_t start(const std::vector<std::string>& arguments) const {
    std::vector<std::string> words{PINOCCHIO_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      if (chdir(folder_.c_str()) != 0 || !freopen("scratch/err", "w", stderr) ||
          !freopen("/dev/null", "w", stdout))
        _exit(126);
      execv(words.front().c_str(), pointers.data());
      _exit(127);
    }
    wait_until_it_catches_signals(child);
    return child;
  }

  // Before that a signal ends the program at once, as it would any other.
  static void wait_until_it_catches_signals(pid_t child) {
    constexpr std::uint64_t kBoth = 1U << (SIGINT - 1) | 1U << (SIGTERM - 1);
    for (const double begin_s = now_s(); now_s() - begin_s < kHangs_s;) {
      std::ifstream status("/proc/" + std::to_string(child) + "/status");
      std::string word;
      while (status >> word && word != "SigCgt:") continue;
      std::uint64_t caught = 0;
      status >> std::hex >> caught;
      if ((caught & kBoth) == kBoth) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ADD_FAILURE() << "it catches no signals";
  }

  // The processor time that a child has used. Reads 0 once the child was waited for.
  [[nodiscard]] static double used_s(pid_t child) {
    std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
    stat.ignore(std::numeric_limits<std::streamsize>::max(), ')');  // its name may have spaces
    std::string skipped;
    for (int i = 0; i < 11; ++i) stat >> skipped;
    double user = 0.0, system = 0.0;
    stat >> user >> system;
    return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  }

  struct End {
    int code = -1;         // -1: by a signal, or it hung
    double after_s = 0.0;  // processor time after the signal
  };
  [[nodiscard]] static End end_by(int signal, pid_t child) {
    const double begin_s = now_s(), before_s = used_s(child);
    kill(child, signal);
    siginfo_t ended{};
    while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT | WNOHANG) == 0 &&
           ended.si_pid == 0) {
      if (now_s() - begin_s > kHangs_s) kill(child, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const double after_s = used_s(child) - before_s;
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, after_s};
  }

  void expect_ends_soon(const std::vector<std::string>& arguments, double after_s,
                        int signal = SIGINT) const {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(std::chrono::duration<double>(after_s));
    expect_ends_soon(child, arguments, signal);
  }

  void expect_ends_soon(pid_t child, const std::vector<std::string>& arguments, int signal = SIGINT) const {
    const End end = end_by(signal, child);
    EXPECT_EQ(end.code, 130) << arguments.front() << ": " << read("scratch/err");
    EXPECT_LT(end.after_s, kSoon_s) << arguments.front();
    EXPECT_NE(read("scratch/err").find("interrupted; what was finished is kept"), std::string::npos);
    EXPECT_EQ(part_files(), 0u) << arguments.front();
  }

  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::size_t part_files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
      count += entry.path().filename().string().find(".part") != std::string::npos;
    return count;
  }
  [[nodiscard]] static std::string speedboat() { return PINOCCHIO_SOURCE_DIR "/scenes/speedboat.glb"; }
};

TEST_F(InterruptTest, InsideASample) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    expect_ends_soon({"render", speedboat(), "--mode", "raytrace", "--size", "4096x4096", "-o", "x.exr"}, 0.6,
                     signal);
  EXPECT_FALSE(exists("x.exr"));
}

// A software driver rasterises it for seconds and looks at nothing of ours meanwhile.
TEST_F(InterruptTest, InsideADriver) {
  for (const double after_s : {0.8, 1.6, 2.4})
    expect_ends_soon({"render", speedboat(), "--visibility", "gpu", "--composite", "gpu", "--size",
                      "4096x4096", "-o", "x.exr"},
                     after_s);
  EXPECT_FALSE(exists("x.exr"));
}

TEST_F(InterruptTest, BetweenSamples) {
  expect_ends_soon({"render", speedboat(), "--spp", "65536", "-o", "x.exr"}, 0.8);
  EXPECT_FALSE(exists("x.exr"));
}

TEST_F(InterruptTest, ThePrecisePicture) {
  expect_ends_soon({"render", speedboat(), "--mode", "raytrace", "--precise", "--spp", "64", "-o", "x.exr"},
                   0.6);
}

TEST_F(InterruptTest, WhatWasFinishedIsKept) {
  const pid_t child =
      start({"render", speedboat(), "--turntable", "100000", "--size", "64x48", "-o", "f####.exr"});
  for (int i = 0; i < 6000 && !exists("f0003.exr"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const End end = end_by(SIGTERM, child);
  EXPECT_EQ(end.code, 130);
  EXPECT_LT(end.after_s, kSoon_s);
  EXPECT_TRUE(exists("f0000.exr") && exists("f0003.exr"));
  EXPECT_EQ(part_files(), 0u);
}

TEST_F(InterruptTest, GenerateReadAndBuild) {
  expect_ends_soon({"generate", "forest", "--triangles", "20000000", "-o", "x.gltf"}, 0.3);  // making it
  const std::vector<std::string> written{"generate", "forest", "--triangles", "6000000", "-o", "x.gltf"};
  const pid_t writes = start(written);
  for (int i = 0; i < 60000 && part_files() == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  expect_ends_soon(writes, written);
  EXPECT_FALSE(exists("x.gltf"));
  ASSERT_EQ(run("generate forest --triangles 1500000 -o forest.glb").exit_code, 0);
  for (const double after_s : {0.1, 0.4, 0.9, 1.4})
    expect_ends_soon({"measure", "forest.glb", "--mode", "raytrace", "--turntable", "1000"}, after_s);
}

TEST_F(InterruptTest, AChartAndItsChild) {
  expect_ends_soon({"chart", speedboat(), "--quick", "-o", "out"}, 1.5);
  expect_ends_soon({"chart", "--stability", "-o", "out"}, 1.0);
}

TEST_F(InterruptTest, ASecondSignalEndsAtOnce) {
  const pid_t child = start({"render", speedboat(), "--spp", "65536", "--size", "1024x1024", "-o", "x.exr"});
  std::this_thread::sleep_for(std::chrono::milliseconds(700));
  kill(child, SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(80));
  const End end = end_by(SIGINT, child);
  EXPECT_EQ(end.code, 130);
  EXPECT_LT(end.after_s, 0.5);
  EXPECT_EQ(part_files(), 0u);
}

TEST_F(InterruptTest, WhatDeadProcessesLeftIsSwept) {
  write(".x-abc123.part.exr", "half");
  write(".x-abc123.part", "half");
  write(".mine-notes.part.txt.bak", "a person's");
  write(".x-1.part.exr", "a person's");
  ASSERT_EQ(run("render" + scene("cornell.gltf") + "--size 16x12 -o x.exr").exit_code, 0);
  EXPECT_FALSE(exists(".x-abc123.part.exr"));
  EXPECT_FALSE(exists(".x-abc123.part"));
  EXPECT_TRUE(exists(".mine-notes.part.txt.bak"));
  EXPECT_TRUE(exists(".x-1.part.exr"));
}

}  // namespace
}  // namespace pinocchio
