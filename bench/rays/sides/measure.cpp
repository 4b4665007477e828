#include "bench/rays/sides/measure.h"

#include <algorithm>
#include <cmath>

#include "core/base/clock.h"
#include "core/math/median.h"

namespace pinocchio::bench {
namespace {

// Two hits are the same if they have the same triangle, or the same place on two adjacent ones.
constexpr float kSamePlace = 1e-5f;  // relative distance

bool same(const Hit& a, const Hit& b) {
  if (a.triangle == b.triangle) return true;
  return a.valid() && b.valid() && std::abs(a.t - b.t) <= kSamePlace * std::max(a.t, b.t);
}

std::size_t count_different(const std::vector<Hit>& a, const std::vector<Hit>& b) {
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.size(); ++i) different += same(a[i], b[i]) ? 0 : 1;
  return different;
}

bool by_processor = false;  // count_processor_time

double now() {
  return by_processor ? processor_s() : now_s();
}

void trace_all(RayBackend& backend, std::size_t rays, Workers& workers) {
  workers.for_each((rays + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    backend.trace(first, std::min(kChunk, rays - first));
  });
}

}  // namespace

void count_processor_time() {
  by_processor = true;
}

double seconds_of(const std::function<void()>& run) {
  const double start = now();
  run();
  return now() - start;
}

double median_seconds(int repeat, const std::function<void()>& prepare, const std::function<void()>& run) {
  std::vector<double> times;
  for (int i = 0; i < repeat; ++i) {
    prepare();
    times.push_back(seconds_of(run));
  }
  return median(times);
}

double seconds_of_tracing(RayBackend& backend, const RaySet& set, Workers& workers) {
  backend.load(set);
  return seconds_of([&] { trace_all(backend, set.rays.size(), workers); });
}

std::vector<Speed> race(const RaySet& set, const RayBackends& backends, Workers& workers, int repeat) {
  const std::size_t rays = set.rays.size();
  std::vector<std::vector<double>> times(backends.size());
  for (int i = 0; i < repeat; ++i)
    for (std::size_t c = 0; c < backends.size(); ++c)
      times[c].push_back(seconds_of_tracing(*backends[c], set, workers));
  const std::vector<Hit> judge = backends.back()->hits();
  std::vector<Speed> speeds;
  for (std::size_t c = 0; c < backends.size(); ++c)
    speeds.push_back({set.name, backends[c]->name(), workers.count(), rays,
                      1e-6 * static_cast<double>(rays) / median(times[c]),
                      count_different(backends[c]->hits(), judge)});
  return speeds;
}

}  // namespace pinocchio::bench
