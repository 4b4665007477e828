#include "hybrid/plan_ladder.h"

#include <algorithm>

#include "core/compare/pareto.h"

namespace pinocchio {
namespace {

void add_unless_there(std::vector<Plan>& plans, const Plan& plan) {
  if (std::find(plans.begin(), plans.end(), plan) == plans.end()) plans.push_back(plan);
}

Plan without_mirrors(Plan plan) {
  plan.reflection = ReflectionFormat::none;
  plan.reflection_scale = 1;
  plan.tiles = false;
  plan.depth = 0;
  return plan;
}

Plan without_shadows(Plan plan) {
  plan.mask_bits = 0;
  plan.mask_scale = 1;
  return plan;
}

// One sample for so many pixels, and so many bounces: of what the plan has at all.
Plan thinned(Plan plan, int mask_scale, int reflection_scale, int depth) {
  if (plan.mask_bits > 0) plan.mask_scale = mask_scale;
  if (plan.reflects()) {
    plan.reflection_scale = reflection_scale;
    plan.depth = std::min(plan.depth, depth);
  }
  return plan;
}

const char* resolution(int scale) {
  return scale == 2 ? "half" : "quarter";
}

bool keeps(const MeasuredPlan& measured, const Budget& budget) {
  return (!budget.frame_ms || measured.frame_ms <= *budget.frame_ms) &&
         (!budget.error || measured.error <= *budget.error);
}

}  // namespace

std::vector<Plan> cheaper_plans(const Plan& exact) {
  std::vector<Plan> plans{exact};
  constexpr int kAll = kMostBounces;
  if (exact.reflects()) {
    Plan narrow = exact;
    narrow.reflection = ReflectionFormat::rgb9e5;
    add_unless_there(plans, narrow);
  }
  for (const int depth : {4, 2, 1}) add_unless_there(plans, thinned(exact, 1, 1, depth));
  for (const int scale : {2, 4}) {
    add_unless_there(plans, thinned(exact, 1, scale, kAll));
    add_unless_there(plans, thinned(exact, scale, 1, kAll));
    add_unless_there(plans, thinned(exact, scale, scale, kAll));
    add_unless_there(plans, thinned(exact, scale, scale, 2));
  }
  add_unless_there(plans, thinned(exact, 4, 4, 1));
  add_unless_there(plans, without_mirrors(exact));
  add_unless_there(plans, thinned(without_mirrors(exact), 4, 1, kAll));
  add_unless_there(plans, without_shadows(exact));
  Plan raster = without_mirrors(without_shadows(exact));
  raster.primary = Primary::raster;
  add_unless_there(plans, raster);
  return plans;
}

std::string given_up(const Plan& exact, const Plan& plan) {
  std::vector<std::string> lost;
  if (exact.mask_bits > 0 && plan.mask_bits == 0) lost.emplace_back("shadows");
  if (plan.mask_bits > 0 && plan.mask_scale > exact.mask_scale)
    lost.push_back(std::string("shadows at ") + resolution(plan.mask_scale) + " resolution");
  if (exact.reflects() && !plan.reflects()) lost.emplace_back("reflections");
  if (plan.reflects()) {
    if (plan.reflection_scale > exact.reflection_scale)
      lost.push_back(std::string("reflections at ") + resolution(plan.reflection_scale) + " resolution");
    if (plan.depth < exact.depth) lost.push_back("bounces beyond " + std::to_string(plan.depth));
    if (bytes_per_pixel(plan.reflection) < bytes_per_pixel(exact.reflection))
      lost.emplace_back("reflections of " + std::to_string(bytes_per_pixel(plan.reflection)) +
                        " bytes a pixel");
  }
  std::string text;
  for (const std::string& one : lost) text += (text.empty() ? "" : ", ") + one;
  return text;
}

std::vector<MeasuredPlan> pareto_front(const std::vector<MeasuredPlan>& plans) {
  std::vector<CostAndError> costs;
  for (const MeasuredPlan& one : plans) costs.push_back({one.frame_ms, one.error});
  std::vector<MeasuredPlan> front;
  for (const std::size_t i : pareto_front(costs)) front.push_back(plans[i]);
  std::reverse(front.begin(), front.end());
  return front;
}

std::size_t choose(const std::vector<MeasuredPlan>& front, const Budget& budget) {
  const auto within_error = [&](const MeasuredPlan& one) { return keeps(one, {{}, budget.error}); };
  const auto last = std::find_if_not(front.begin(), front.end(), within_error);
  const std::size_t fastest = last == front.begin() ? 0 : static_cast<std::size_t>(last - front.begin()) - 1;
  if (!budget.frame_ms) return fastest;
  const auto first =
      std::find_if(front.begin(), front.end(), [&](const MeasuredPlan& one) { return keeps(one, budget); });
  return first == front.end() ? fastest : static_cast<std::size_t>(first - front.begin());
}

}  // namespace pinocchio
