// The counts of an unfinished run of the tables, which are kept in their folder.
#pragma once

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio::stability {

class KeptCells {
 public:
  // Reads DIR/stability-part.json of an interrupted run. Errors: it is of another run, or cannot be read.
  // `run`: the properties that the counts depend on.
  [[nodiscard]] static Expected<KeptCells> open(const std::filesystem::path& folder,
                                                const nlohmann::json& run, bool restart);

  // The cell with that "table", "case" and "method"; null: it is not counted yet.
  [[nodiscard]] const nlohmann::json* find(const std::string& table, const std::string& stress_case,
                                           const std::string& method) const;
  // The first cell is written at once, the others with those of a second. Throws EnvironmentError.
  void add(nlohmann::json cell);
  // Writes the file whole or not at all. Throws EnvironmentError.
  void write();
  // Removes the file: the tables are complete.
  void remove() const;

 private:
  KeptCells(std::filesystem::path file, nlohmann::json json)
      : file_(std::move(file)), json_(std::move(json)) {}

  std::filesystem::path file_;
  nlohmann::json json_;
  double written_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace pinocchio::stability
