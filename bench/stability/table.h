// Every method in every difficult case: failures and cost in two tables, of rays and of pictures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/stability/kept_cells.h"
#include "bench/stability/stress_case.h"
#include "pinocchio/engine.h"

namespace pinocchio::stability {

struct Cell {
  std::string stress_case, failure, method;
  FailureCount count;
  double ratio = 0.0;  // of the seconds to the default's seconds in the same run
  nlohmann::json more;
};

struct Table {
  std::string name;
  std::vector<std::string> methods;
  std::vector<Cell> cells;  // row by row, the default first
};

struct Tables {
  Table rays{"rays", {}, {}}, pictures{"pictures", {}, {}};

  [[nodiscard]] std::string text() const;  // Markdown
  [[nodiscard]] std::uint64_t default_failures() const;
  // stability.md, .csv and .json. Throws EnvironmentError.
  void write(const std::filesystem::path& folder) const;
};

// The number of cells of the two tables.
[[nodiscard]] std::size_t table_cells();

// The properties that counts depend on, besides the case and the method.
[[nodiscard]] nlohmann::json run_json(bool quick);

// quick: a hundredth of the rays, small pictures. Uses kept cells and keeps those that it counts. Calls
// `after_cell` after each cell. Empty: `after_cell` returned false.
[[nodiscard]] std::optional<Tables> make_tables(Engine& engine, bool quick,
                                                const std::function<bool()>& after_cell, KeptCells& kept);

}  // namespace pinocchio::stability
