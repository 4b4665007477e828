// A function for each verb adds it to the command line. The returned function runs the verb after parsing; it
// returns the exit code or throws Exit.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pinocchio::app {

using Run = std::function<int()>;

[[nodiscard]] Run add_render(CLI::App& program);
[[nodiscard]] Run add_view(CLI::App& program);
[[nodiscard]] Run add_info(CLI::App& program);
[[nodiscard]] Run add_measure(CLI::App& program);
[[nodiscard]] Run add_chart(CLI::App& program);
[[nodiscard]] Run add_generate(CLI::App& program);
[[nodiscard]] Run add_compare(CLI::App& program);

}  // namespace pinocchio::app
