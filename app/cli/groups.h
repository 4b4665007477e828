// The groups of a verb's options in its help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pinocchio::app {

inline constexpr const char *kCameraGroup = "Camera", *kPictureGroup = "Picture", *kLightGroup = "Light",
                            *kSamplesGroup = "Samples", *kAnimationGroup = "Animation",
                            *kMethodGroup = "Method", *kExchangeGroup = "Exchange between CPU and GPU",
                            *kMachineGroup = "Machine", *kOtherGroup = "Options";

// Options that are added from here on belong to the group.
inline void begin_group(CLI::App& verb, const char* group) {
  verb.option_defaults()->group(group);
}

// Help that lists the groups in this order, whatever the order of the options.
class GroupedHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* verb, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = make_description(verb) + make_usage(verb, name) + make_positionals(verb);
    for (const std::string group : {kCameraGroup, kPictureGroup, kLightGroup, kSamplesGroup, kAnimationGroup,
                                    kMethodGroup, kExchangeGroup, kMachineGroup, kOtherGroup}) {
      const std::vector<const CLI::Option*> options = verb->get_options(
          [&](const CLI::Option* option) { return option->get_group() == group && option->nonpositional(); });
      if (!options.empty()) text += make_group(group, false, options);
    }
    return text + make_subcommands(verb, mode);
  }
};

}  // namespace pinocchio::app
