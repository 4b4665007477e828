#include "bench/chart/sweep.h"

#include <algorithm>
#include <array>
#include <functional>

namespace pinocchio::chart {
namespace {

// The configurations of a sweep as they are collected.
class Sweep {
 public:
  Sweep(const SweepRequest& request, const Plan& plan) : request_(request) { base_.plan = plan; }

  [[nodiscard]] const SweepRequest& request() const { return request_; }
  [[nodiscard]] const Settings& base() const { return base_; }
  [[nodiscard]] std::vector<Configuration> take() { return std::move(configurations_); }
  void begin(std::string_view axis, std::string_view reference) {
    axis_ = axis;
    reference_ = reference;
  }

  void add(const std::string& value, const std::string& options, const Settings& settings) {
    configurations_.push_back({axis_, value, options, false, settings, reference_});
  }
  // What the command line says to a plan; nothing where no such plan draws the scene.
  void add_plan(const std::string& value, const std::string& options,
                const std::function<void(PlanRequest&)>& change, Exchange exchange = Exchange::sync) {
    PlanRequest plan_request = request_.plan;
    plan_request.reprojects = exchange == Exchange::reproject;
    change(plan_request);
    const Expected<Plan> plan = make_plan(request_.needs, plan_request);
    if (!plan) return;
    Settings settings = base_;
    settings.plan = *plan;
    settings.exchange = exchange;
    add(value, options, settings);
  }
  // The default's plan by another tracer, named as its option names it.
  void add_tracer(const std::string& name, const std::string& option,
                  const std::function<void(TracerSettings&)>& change) {
    Settings settings = base_;
    change(settings.tracer);
    add(name, settings.tracer == base_.tracer ? "" : option + " " + name, settings);
  }
  // The default's plan with a change that only a plan's file can say.
  void add_plan_file(const std::string& value, const std::function<void(Plan&)>& change,
                     Exchange exchange = Exchange::sync) {
    Settings settings = base_;
    settings.exchange = exchange;
    if (exchange == Exchange::reproject) settings.plan.primary = Primary::raster;
    change(settings.plan);
    if (!check_plan(settings.plan, request_.needs)) return;
    add(value, "", settings);
    Configuration& added = configurations_.back();
    if (settings.exchange == base_.exchange && settings.plan == base_.plan) return;
    added.has_plan_file = true;
    added.options = "--plan " + added.plan_file();
    if (exchange != Exchange::sync) added.options += std::string(" --exchange ") + exchange_name(exchange);
  }

 private:
  const SweepRequest& request_;
  Settings base_;
  std::string axis_, reference_;
  std::vector<Configuration> configurations_;
};

void designs(Sweep& sweep) {
  sweep.add("1", "", sweep.base());
  sweep.add_plan("2", "--design 2", [](PlanRequest& r) { r.design = 2; });
  sweep.add_plan("1 slides", "--plan slides", [](PlanRequest& r) { r.slides = true; });
  sweep.add_plan("2 slides", "--design 2 --plan slides", [](PlanRequest& r) {
    r.design = 2;
    r.slides = true;
  });
  sweep.add_plan("raytrace", "--mode raytrace", [](PlanRequest& r) { r.mode = Mode::raytrace; });
  sweep.add_plan("raster", "--mode raster", [](PlanRequest& r) { r.mode = Mode::raster; });
}

void exchanges(Sweep& sweep) {
  sweep.add("1 sync", "", sweep.base());
  for (const int design : {1, 2})
    for (const Exchange exchange : {Exchange::sync, Exchange::pipelined, Exchange::reproject}) {
      const bool is_base = design == 1 && exchange == Exchange::sync;
      if (is_base || (design == 2 && exchange == Exchange::reproject)) continue;
      const std::string name = exchange_name(exchange);
      sweep.add_plan(
          std::to_string(design) + " " + name,
          (design == 2 ? "--design 2 --exchange " : "--exchange ") + name,
          [design](PlanRequest& r) { r.design = design; }, exchange);
    }
}

void primaries(Sweep& sweep) {
  if (!sweep.base().plan.traces()) return;
  for (std::size_t i = 0; i < kPrimaryNames.size(); ++i)
    sweep.add_plan_file(std::string(kPrimaryNames[i]),
                        [i](Plan& plan) { plan.primary = static_cast<Primary>(i); });
}

void reflection_formats(Sweep& sweep) {
  if (!sweep.base().plan.reflects()) return;
  for (std::size_t i = 1; i < kReflectionFormatNames.size(); ++i)
    sweep.add_plan_file(std::string(kReflectionFormatNames[i]),
                        [i](Plan& plan) { plan.reflection = static_cast<ReflectionFormat>(i); });
}

std::string scale_name(int scale) {
  return scale == 1 ? "1" : "1/" + std::to_string(scale);
}

void reflection_scales(Sweep& sweep) {
  if (!sweep.base().plan.reflects()) return;
  for (const int scale : {1, 2, 4})
    sweep.add_plan_file(scale_name(scale), [scale](Plan& plan) { plan.reflection_scale = scale; });
}

void mask_scales(Sweep& sweep) {
  if (sweep.base().plan.mask_bits == 0) return;
  for (const int scale : {1, 2, 4})
    sweep.add_plan_file(scale_name(scale), [scale](Plan& plan) { plan.mask_scale = scale; });
}

void tiles(Sweep& sweep) {
  if (!sweep.base().plan.reflects()) return;
  sweep.add_plan_file("used", [](Plan& plan) { plan.tiles = true; });
  sweep.add_plan_file("all", [](Plan& plan) { plan.tiles = false; });
}

void depths(Sweep& sweep) {
  const int most = sweep.base().plan.depth;
  if (most == 0) return;
  for (const int depth : {0, 1, 2, 3, 4, 6}) {
    if (depth >= most || (sweep.request().quick && depth > 2)) break;
    sweep.add_plan(std::to_string(depth), "--depth " + std::to_string(depth),
                   [depth](PlanRequest& r) { r.depth = depth; });
  }
  sweep.add(std::to_string(most), "", sweep.base());
}

// Mirrored light below this is not followed, nor a shadow ray fired where all lights bring less.
void set_cutoff(Plan& plan, const Needs& needs, float least) {
  plan.least_contribution = least;
  plan.least_light = least / static_cast<float>(std::max(needs.casting_lights, 1));
}

void cutoffs(Sweep& sweep) {
  if (!sweep.base().plan.traces()) return;
  const std::vector<int> powers =
      sweep.request().quick ? std::vector{13, 8, 4} : std::vector{13, 10, 8, 6, 4, 2};
  sweep.add_plan_file("0", [&](Plan& plan) { set_cutoff(plan, sweep.request().needs, 0.0f); });
  for (const int power : powers)
    sweep.add_plan_file("1/" + std::to_string(1 << power), [&, power](Plan& plan) {
      set_cutoff(plan, sweep.request().needs, 1.0f / static_cast<float>(1 << power));
    });
}

void trees(Sweep& sweep) {
  for (const char* const name : kSplitRuleNames)
    sweep.add_tracer(name, "--tree", [name](TracerSettings& t) { t.tree = *parse_split_rule(name); });
}

void triangle_tests(Sweep& sweep) {
  for (const TriangleTest test : kTriangleTests)
    sweep.add_tracer(std::string(triangle_test_name(test)), "--triangle-test",
                     [test](TracerSettings& t) { t.triangle_test = test; });
}

void offsets(Sweep& sweep) {
  for (const OffsetMethod offset : kOffsetMethods)
    sweep.add_tracer(std::string(offset_method_name(offset)), "--offset",
                     [offset](TracerSettings& t) { t.offset = offset; });
}

void simd_widths(Sweep& sweep) {
  for (const Isa isa : supported_isas())
    sweep.add_tracer(std::string(isa_name(isa)), "--isa", [isa](TracerSettings& t) {
      if (isa != default_isa()) t.isa = isa;
    });
}

void thread_counts(Sweep& sweep) {
  for (int threads = 1; threads < sweep.request().cores; threads *= 2) {
    Settings settings = sweep.base();
    settings.plan.threads = threads;
    sweep.add(std::to_string(threads), "--threads " + std::to_string(threads), settings);
  }
  sweep.add(std::to_string(sweep.request().cores), "", sweep.base());
}

void sample_counts(Sweep& sweep) {
  const std::vector<int> counts = sweep.request().quick ? std::vector{1, 4} : std::vector{1, 2, 4, 8};
  for (const int spp : counts) {
    Settings settings = sweep.base();
    settings.spp = spp;
    sweep.add(std::to_string(spp), spp == 1 ? "" : "--spp " + std::to_string(spp), settings);
  }
}

void shrink(Plan& plan, int scale, ReflectionFormat format) {
  if (plan.mask_bits > 0) plan.mask_scale = scale;
  if (!plan.reflects()) return;
  plan.reflection_scale = scale;
  plan.reflection = format;
}

void combinations(Sweep& sweep) {
  if (!sweep.base().plan.traces()) return;
  const Needs& needs = sweep.request().needs;
  const auto half = [](Plan& plan) { shrink(plan, 2, ReflectionFormat::rgb9e5); };
  const auto quarter = [](Plan& plan) { shrink(plan, 4, ReflectionFormat::rgb8); };
  const auto shallow = [&needs](Plan& plan) {
    if (plan.reflects()) plan.depth = 1;
    set_cutoff(plan, needs, 0x1p-6f);
  };
  const auto shallow_half = [&](Plan& plan) {
    shallow(plan);
    half(plan);
  };
  const auto shallow_quarter = [&](Plan& plan) {
    shallow(plan);
    quarter(plan);
  };
  sweep.add("default", "", sweep.base());
  sweep.add_plan_file("half", half);
  sweep.add_plan_file("quarter", quarter);
  sweep.add_plan_file("shallow-half", shallow_half);
  if (sweep.request().quick) return;
  sweep.add_plan_file("shallow", shallow);
  sweep.add_plan_file("shallow-quarter", shallow_quarter);
  sweep.add_plan_file("half-pipelined", half, Exchange::pipelined);
  sweep.add_plan_file("half-reproject", half, Exchange::reproject);
  sweep.add_plan_file("shallow-quarter-reproject", shallow_quarter, Exchange::reproject);
}

struct Axis {
  AxisName name;
  void (*fill)(Sweep&);
  std::string_view reference = "centre";
};
constexpr std::array kAxes{
    Axis{{"design", "design and mode"}, designs},
    Axis{{"exchange", "exchange"}, exchanges},
    Axis{{"primary", "who finds what is seen"}, primaries},
    Axis{{"reflection-format", "reflection, format"}, reflection_formats},
    Axis{{"reflection-scale", "reflection, resolution"}, reflection_scales},
    Axis{{"mask-scale", "shadow mask, resolution"}, mask_scales},
    Axis{{"tiles", "tiles that are sent"}, tiles},
    Axis{{"depth", "most bounces"}, depths},
    Axis{{"cutoff", "contribution cut-off"}, cutoffs},
    Axis{{"tree", "tree builder"}, trees},
    Axis{{"triangle-test", "triangle test"}, triangle_tests},
    Axis{{"offset", "ray offset"}, offsets},
    Axis{{"simd", "SIMD width"}, simd_widths},
    Axis{{"threads", "threads"}, thread_counts},
    Axis{{"spp", "samples a pixel"}, sample_counts, "area"},
    Axis{{"combined", "combinations"}, combinations},
};

bool is_wanted(const SweepRequest& request, std::string_view axis) {
  return request.only.empty() ||
         std::find(request.only.begin(), request.only.end(), axis) != request.only.end();
}

}  // namespace

Expected<std::vector<Configuration>> make_sweep(const SweepRequest& request) {
  const Expected<Plan> plan = make_plan(request.needs, request.plan);
  if (!plan) return Unexpected(plan.error());
  Sweep sweep(request, *plan);
  for (const Axis& axis : kAxes) {
    if (!is_wanted(request, axis.name.name)) continue;
    sweep.begin(axis.name.name, axis.reference);
    axis.fill(sweep);
  }
  return sweep.take();
}

std::vector<AxisName> axis_names() {
  std::vector<AxisName> names;
  for (const Axis& axis : kAxes) names.push_back(axis.name);
  return names;
}

}  // namespace pinocchio::chart
