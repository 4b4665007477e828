#include "bench/stability/kept_cells.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <system_error>

#include "core/base/clock.h"
#include "core/files/atomic_file.h"

namespace pinocchio::stability {
namespace {

constexpr std::array kNumbers{"trials", "failures", "excused", "seconds"};
constexpr double kWrittenEvery_s = 1.0;  // many cells take milliseconds; the file holds all of them

bool is_cell(const nlohmann::json& cell) {
  const auto is_text = [&](const char* key) { return cell.contains(key) && cell[key].is_string(); };
  return cell.is_object() && is_text("table") && is_text("case") && is_text("method") &&
         std::ranges::all_of(kNumbers,
                             [&](const char* key) { return cell.contains(key) && cell[key].is_number(); });
}

}  // namespace

Expected<KeptCells> KeptCells::open(const std::filesystem::path& folder, const nlohmann::json& run,
                                    bool restart) {
  const std::filesystem::path file = folder / "stability-part.json";
  nlohmann::json json{{"run", run}, {"cells", nlohmann::json::array()}};
  if (restart || !std::filesystem::exists(file)) return KeptCells(file, std::move(json));
  const auto refused = [&](const char* what) {
    return Unexpected(
        InputError{file.string(), 0, what, "name another folder, or begin afresh with --restart"});
  };
  std::ifstream in(file);
  json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object() || !json.contains("run") || !json.contains("cells") || !json["cells"].is_array() ||
      !std::ranges::all_of(json["cells"], is_cell))
    return refused("is not what a run of chart --stability leaves");
  if (json["run"] != run) return refused("was begun by another program, machine or number of rays");
  return KeptCells(file, std::move(json));
}

const nlohmann::json* KeptCells::find(const std::string& table, const std::string& stress_case,
                                      const std::string& method) const {
  const auto found = std::ranges::find_if(json_["cells"], [&](const nlohmann::json& cell) {
    return cell["table"] == table && cell["case"] == stress_case && cell["method"] == method;
  });
  return found == json_["cells"].end() ? nullptr : &*found;
}

void KeptCells::add(nlohmann::json cell) {
  json_["cells"].push_back(std::move(cell));
  if (now_s() - written_s_ >= kWrittenEvery_s) write();
}

void KeptCells::write() {
  write_text(file_, json_.dump() + "\n");
  written_s_ = now_s();
}

void KeptCells::remove() const {
  std::error_code none;
  std::filesystem::remove(file_, none);
}

}  // namespace pinocchio::stability
