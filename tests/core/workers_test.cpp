#include "core/parallel/workers.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>

#include "core/parallel/tiles.h"

namespace pinocchio {
namespace {

TEST(Workers, DoEveryItemOnce) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    EXPECT_EQ(workers.count(), threads);
    for (const std::size_t n : {0u, 1u, 3u, 1000u}) {
      std::vector<std::atomic<int>> done(n);
      workers.for_each(n, [&](std::size_t i) { ++done[i]; });
      for (const std::atomic<int>& d : done) EXPECT_EQ(d, 1);
    }
  }
}

TEST(Workers, WhatABodyThrowsReachesTheCallerAndTheNextJobRuns) {
  Workers workers(4);
  const auto fail = [](std::size_t i) {
    if (i == 17) throw std::runtime_error("seventeen");
  };
  EXPECT_THROW(workers.for_each(100, fail), std::runtime_error);
  std::atomic<int> done{0};
  workers.for_each(100, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 100);
}

TEST(Workers, CallersOnSeveralThreadsTakeTurns) {
  Workers workers(3);
  std::atomic<int> done{0};
  const auto call = [&] {
    for (int i = 0; i < 2000; ++i) workers.for_each(7, [&](std::size_t) { ++done; });
  };
  std::thread other(call), third(call);
  call();
  other.join();
  third.join();
  EXPECT_EQ(done, 3 * 2000 * 7);
}

TEST(Workers, AForkedProcessWorksAloneAndEnds) {
  auto workers = std::make_unique<Workers>(4);
  std::atomic<int> done{0};
  workers->for_each(100, [&](std::size_t) { ++done; });
  const pid_t child = fork();
  if (child == 0) {
    alarm(20);  // ends a process that hangs
    workers->for_each(100, [&](std::size_t) { ++done; });
    const bool alone = workers->count() == 1;
    workers.reset();
    _exit(done == 200 && alone ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  workers->for_each(100, [&](std::size_t) { ++done; });
  EXPECT_EQ(done, 200);
}

TEST(Tiles, CoverEveryPixelOnce) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(33, 65), glm::ivec2(7, 130)}) {
    const TileGrid grid(size);
    std::vector<int> seen(static_cast<std::size_t>(size.x * size.y), 0);
    for (std::size_t i = 0; i < grid.count(); ++i)
      TileGrid::for_each_pixel(grid.tile(i),
                               [&](int x, int y) { ++seen[static_cast<std::size_t>(y * size.x + x)]; });
    for (const int s : seen) EXPECT_EQ(s, 1);
  }
}

}  // namespace
}  // namespace pinocchio
