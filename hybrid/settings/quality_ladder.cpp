#include "hybrid/settings/quality_ladder.h"

#include <algorithm>

#include "core/math/pareto.h"
#include "pinocchio/conversion.h"

namespace pinocchio {
namespace {

void add_unless_there(std::vector<Settings>& ladder, const Settings& s) {
  if (std::find(ladder.begin(), ladder.end(), s) == ladder.end()) ladder.push_back(s);
}

Settings without_mirrors(Settings s) {
  s.reflection = ReflectionFormat::none;
  s.reflection_scale = 1;
  s.tiles = false;
  s.denoise.value = false;
  s.depth = 0;
  return s;
}

Settings without_shadows(Settings s) {
  s.mask_bits = 0;
  s.mask_scale = 1;
  return s;
}

// With one sample for so many pixels and at most so many bounces.
Settings thinned(Settings s, int mask_scale, int reflection_scale, int depth) {
  if (s.mask_bits > 0) s.mask_scale = mask_scale;
  if (s.reflects()) {
    s.reflection_scale = reflection_scale;
    s.depth = std::min<int>(s.depth, depth);
  }
  if (!can_denoise(s)) s.denoise.value = false;
  return s;
}

const char* resolution(int scale) {
  return scale == 2 ? "half" : "quarter";
}

bool keeps(const MeasuredSettings& measured, const Budget& budget) {
  return (!budget.frame_ms || measured.frame_ms <= *budget.frame_ms) &&
         (!budget.error || measured.error <= *budget.error);
}

}  // namespace

std::vector<Settings> quality_ladder(const Settings& exact, bool lights_in_reflection) {
  std::vector<Settings> ladder{exact};
  constexpr int kAll = kMostBounces;
  if (exact.reflects()) {
    Settings narrow = exact;
    narrow.reflection = ReflectionFormat::rgb9e5;
    if (!can_denoise(narrow)) narrow.denoise.value = false;
    add_unless_there(ladder, narrow);
  }
  for (const int depth : {4, 2, 1}) add_unless_there(ladder, thinned(exact, 1, 1, depth));
  for (const int scale : {2, 4}) {
    add_unless_there(ladder, thinned(exact, 1, scale, kAll));
    add_unless_there(ladder, thinned(exact, scale, 1, kAll));
    add_unless_there(ladder, thinned(exact, scale, scale, kAll));
    add_unless_there(ladder, thinned(exact, scale, scale, 2));
  }
  add_unless_there(ladder, thinned(exact, 4, 4, 1));
  if (!lights_in_reflection) {
    add_unless_there(ladder, without_mirrors(exact));
    add_unless_there(ladder, thinned(without_mirrors(exact), 4, 1, kAll));
  }
  add_unless_there(ladder, without_shadows(exact));
  Settings raster = without_mirrors(without_shadows(exact));
  raster.visibility = Processor::gpu;
  add_unless_there(ladder, raster);
  return ladder;
}

std::string given_up(const Settings& exact, const Settings& s) {
  std::vector<std::string> lost;
  if (exact.mask_bits > 0 && s.mask_bits == 0) lost.emplace_back("shadows");
  if (s.mask_bits > 0 && s.mask_scale > exact.mask_scale)
    lost.push_back(std::string("shadows at ") + resolution(s.mask_scale) + " resolution");
  if (exact.denoise && !s.denoise) lost.emplace_back("the filter of sampled light");
  if (exact.reflects() && !s.reflects()) lost.emplace_back("reflections");
  if (s.reflects()) {
    if (s.reflection_scale > exact.reflection_scale)
      lost.push_back(std::string("reflections at ") + resolution(s.reflection_scale) + " resolution");
    if (s.depth < exact.depth) lost.push_back("bounces beyond " + std::to_string(s.depth));
    if (bytes_per_pixel(s.reflection) < bytes_per_pixel(exact.reflection))
      lost.emplace_back("reflections of " + std::to_string(bytes_per_pixel(s.reflection)) + " bytes a pixel");
  }
  std::string text;
  for (const std::string& one : lost) text += (text.empty() ? "" : ", ") + one;
  return text;
}

std::vector<MeasuredSettings> pareto_front(const std::vector<MeasuredSettings>& ladder) {
  std::vector<CostAndError> costs;
  for (const MeasuredSettings& one : ladder) costs.push_back({one.frame_ms, one.error});
  std::vector<MeasuredSettings> front;
  for (const std::size_t i : pareto_front(costs)) front.push_back(ladder[i]);
  std::reverse(front.begin(), front.end());
  return front;
}

std::size_t choose(const std::vector<MeasuredSettings>& front, const Budget& budget) {
  const auto within_error = [&](const MeasuredSettings& one) { return keeps(one, {{}, budget.error}); };
  const auto last = std::find_if_not(front.begin(), front.end(), within_error);
  const std::size_t fastest = last == front.begin() ? 0 : as_size(last - front.begin()) - 1;
  if (!budget.frame_ms) return fastest;
  const auto first = std::find_if(front.begin(), front.end(),
                                  [&](const MeasuredSettings& one) { return keeps(one, budget); });
  return first == front.end() ? fastest : as_size(first - front.begin());
}

}  // namespace pinocchio
