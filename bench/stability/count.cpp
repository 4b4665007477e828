#include "bench/stability/count.h"

#include <cmath>
#include <ctime>

namespace pinocchio::stability {

double Timed::thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, FailureCount& count) {
  std::vector<Hit> hits(rays.size());
  const Timed timed(count);
  tracer.closest_hits(rays, hits);
  return hits;
}

FailureCount count_misses(const Tracer& tracer, const std::vector<Ray>& rays) {
  FailureCount count;
  count.trials = rays.size();
  const std::vector<Hit> hits = trace(tracer, rays, count);
  std::vector<std::uint8_t> blocked(rays.size());
  tracer.occluded(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (!hits[i].valid() || !std::isfinite(hits[i].t) || !blocked[i]) ++count.failures;
  return count;
}

std::vector<StressCase> all_cases() {
  std::vector<StressCase> all;
  for (const auto& some : {leak_cases(), direction_cases(), triangle_cases(), shadow_cases(),
                           terminator_cases(), bounce_cases(), hole_cases()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace pinocchio::stability
