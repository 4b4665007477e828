// What a run of the tables has counted so far, as it is kept in their folder until they are whole.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "pinocchio/error.h"

namespace pinocchio::stability {

class KeptCells {
 public:
  // Reads what a run that was ended has left in DIR/stability-part.json. Errors: it is of another run, or
  // cannot be read. `run`: what the counts depend on.
  [[nodiscard]] static Expected<KeptCells> open(const std::filesystem::path& folder,
                                                const nlohmann::json& run, bool restart);

  // Null where it was not counted. A cell's "table", "case" and "method" name it.
  [[nodiscard]] const nlohmann::json* find(const std::string& table, const std::string& stress_case,
                                           const std::string& method) const;
  // Writes the file, whole or not at all. Throws EnvironmentError.
  void add(nlohmann::json cell);
  // The tables are whole.
  void remove() const;

 private:
  KeptCells(std::filesystem::path file, nlohmann::json json)
      : file_(std::move(file)), json_(std::move(json)) {}

  std::filesystem::path file_;
  nlohmann::json json_;
};

}  // namespace pinocchio::stability
