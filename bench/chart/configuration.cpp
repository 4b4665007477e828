#include "bench/chart/configuration.h"

#include <cctype>
#include <nlohmann/json.hpp>

#include "hybrid/plan_json.h"

namespace pinocchio::chart {

std::string Configuration::name() const {
  std::string name = axis + "-" + value;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.') c = '-';
  return name;
}

nlohmann::json to_json(const Settings& settings) {
  return {{"plan", to_json(settings.plan)},
          {"exchange", exchange_name(settings.exchange)},
          {"spp", settings.spp},
          {"tree", kSplitRuleNames[static_cast<std::size_t>(settings.tracer.tree)]},
          {"isa", isa_name(settings.tracer.isa.value_or(default_isa()))},
          {"triangle_test", triangle_test_name(settings.tracer.triangle_test)},
          {"offset", offset_method_name(settings.tracer.offset)}};
}

}  // namespace pinocchio::chart
