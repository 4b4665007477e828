#include "bench/stability/count.h"

#include <cmath>
#include <ctime>

namespace pinocchio::stability {

double Timed::thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::vector<Hit> trace(const Tracer& tracer, const std::vector<Ray>& rays, Tally& tally) {
  std::vector<Hit> hits(rays.size());
  const Timed timed(tally);
  tracer.closest_hits(rays, hits);
  return hits;
}

Tally count_misses(const Tracer& tracer, const std::vector<Ray>& rays) {
  Tally tally;
  tally.trials = rays.size();
  const std::vector<Hit> hits = trace(tracer, rays, tally);
  std::vector<std::uint8_t> blocked(rays.size());
  tracer.occluded(rays, blocked);
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (!hits[i].valid() || !std::isfinite(hits[i].t) || !blocked[i]) ++tally.failures;
  return tally;
}

std::vector<Trouble> all_troubles() {
  std::vector<Trouble> all;
  for (const auto& some :
       {leak_troubles(), direction_troubles(), triangle_troubles(), shadow_troubles(), bounce_troubles()})
    all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace pinocchio::stability
