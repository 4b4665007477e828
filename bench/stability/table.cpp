#include "bench/stability/table.h"

#include <algorithm>
#include <cstdio>

#include "bench/stability/picture_case.h"
#include "core/base/system_info.h"
#include "core/files/atomic_file.h"

namespace pinocchio::stability {
namespace {

constexpr int kRays = 200000, kQuickRays = 2000;  // a case; a million at edges
constexpr int kSide = 256, kQuickSide = 64;

nlohmann::json details(const FailureCount&) {
  return nlohmann::json::object();
}
nlohmann::json details(const PictureFailureCount& count) {
  return {{"other_ids", count.other_ids},
          {"worst_difference_there", count.worst_there},
          {"mean_difference", count.mean_error},
          {"holes", count.holes}};
}

nlohmann::json to_json(const Cell& c) {
  nlohmann::json cell{{"case", c.stress_case},        {"failure", c.failure},
                      {"method", c.method},           {"trials", c.count.trials},
                      {"failures", c.count.failures}, {"excused", c.count.excused},
                      {"seconds", c.count.seconds},   {"ratio_to_default", c.ratio}};
  cell.update(c.more);
  return cell;
}

FailureCount count_of(const nlohmann::json& cell) {
  return {cell["trials"], cell["failures"], cell["excused"], cell["seconds"]};
}
// The members of a kept cell that a count does not have.
nlohmann::json details(const nlohmann::json& cell) {
  nlohmann::json more = cell;
  for (const char* key :
       {"table", "case", "failure", "method", "trials", "failures", "excused", "seconds", "ratio_to_default"})
    more.erase(key);
  return more;
}

// Runs every case with every method, except kept cells. False: `after_cell` returned false.
template <class StressCases, class Methods, class Run>
bool fill(const StressCases& cases, const Methods& methods, const Run& run,
          const std::function<bool()>& after_cell, KeptCells& kept, Table& table) {
  for (const auto& method : methods) table.methods.push_back(method.name);
  for (const auto& stress_case : cases) {
    double default_seconds = 0.0;
    for (const auto& method : methods) {
      Cell cell{std::string(stress_case.name), std::string(stress_case.failure), method.name, {}, 0.0, {}};
      const nlohmann::json* const known = kept.find(table.name, cell.stress_case, cell.method);
      if (known) {
        cell.count = count_of(*known);
        cell.more = details(*known);
      } else {
        const auto count = run(stress_case, method);
        cell.count = count;
        cell.more = details(count);
      }
      if (&method == &methods.front()) default_seconds = cell.count.seconds;
      cell.ratio = cell.count.seconds / std::max(default_seconds, 1e-9);
      table.cells.push_back(cell);
      if (!known) {
        nlohmann::json json = to_json(cell);
        json["table"] = table.name;
        kept.add(std::move(json));
      }
      if (!after_cell()) {
        kept.write();
        return false;
      }
    }
  }
  return true;
}

std::string number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

std::string text_of(const Cell& cell) {
  std::string text = std::to_string(cell.count.failures);
  if (!cell.more.contains("other_ids"))
    text += " (" + number("%.2f", cell.ratio) + ")";
  else  // times of all threads and the GPU mean little on a busy machine: they are only in the files
    text += ", ids " + std::to_string(cell.more["other_ids"].get<std::uint64_t>()) + ", mean " +
            number("%.4f", cell.more["mean_difference"].get<double>());
  if (cell.more.contains("holes") && cell.more["holes"] != 0)
    text += ", holes " + std::to_string(cell.more["holes"].get<std::uint64_t>());
  return text;
}

// A column for each method, a row for each case: failures, and in brackets the time relative to the
// default's.
std::string markdown(const Table& table) {
  std::string text = "| case | of | counted |";
  for (const std::string& method : table.methods) text += " " + method + " |";
  text += "\n|---|---:|---|";
  for (std::size_t i = 0; i < table.methods.size(); ++i) text += "---:|";
  text += "\n";
  for (std::size_t i = 0; i < table.cells.size(); i += table.methods.size()) {
    const Cell& first = table.cells[i];
    text += "| " + first.stress_case + " | " + std::to_string(first.count.trials) + " | " + first.failure +
            (first.count.excused > 0 ? " (" + std::to_string(first.count.excused) + " excused)" : "") + " |";
    for (std::size_t k = 0; k < table.methods.size(); ++k) text += " " + text_of(table.cells[i + k]) + " |";
    text += "\n";
  }
  return text;
}

nlohmann::json to_json(const Table& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const Cell& cell : table.cells) cells.push_back(to_json(cell));
  return cells;
}

std::string csv_lines(const Table& table) {
  std::string text;
  for (const Cell& c : table.cells)
    text += '"' + c.stress_case + "\",\"" + c.failure + "\",\"" + c.method + "\"," +
            std::to_string(c.count.trials) + "," + std::to_string(c.count.failures) + "," +
            std::to_string(c.count.excused) + "," + number("%.6f", c.count.seconds) + "," +
            number("%.3f", c.ratio) + "\n";
  return text;
}

// The defaults' failures: the first column.
std::uint64_t default_failures(const Table& table) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < table.cells.size(); i += table.methods.size())
    sum += table.cells[i].count.failures;
  return sum;
}

}  // namespace

std::size_t table_cells() {
  return all_methods().size() * all_cases().size() + all_draw_methods().size() * picture_cases().size();
}

nlohmann::json run_json(bool quick) {
  const SystemInfo system = system_info();
  return {{"pinocchio", version()}, {"cpu", system.cpu}, {"cores", system.cores}, {"quick", quick}};
}

std::optional<Tables> make_tables(Engine& engine, bool quick, const std::function<bool()>& after_cell,
                                  KeptCells& kept) {
  const auto trace = [&](const StressCase& c, const Method& m) {
    return c.run(m, quick ? kQuickRays : kRays);
  };
  const auto draw = [&](const PictureStressCase& c, const DrawMethod& m) {
    return c.run(engine, m, quick ? kQuickSide : kSide);
  };
  Tables tables;
  if (!fill(all_cases(), all_methods(), trace, after_cell, kept, tables.rays) ||
      !fill(picture_cases(), all_draw_methods(), draw, after_cell, kept, tables.pictures))
    return std::nullopt;
  return tables;
}

std::string Tables::text() const {
  return markdown(rays) + "\n" + markdown(pictures);
}

std::uint64_t Tables::default_failures() const {
  return stability::default_failures(rays) + stability::default_failures(pictures);
}

void Tables::write(const std::filesystem::path& folder) const {
  write_text(folder / "stability.md",
             "Failures, and in brackets the processor time beside the default's.\n\n" + text());
  write_text(folder / "stability.csv",
             "case,counted,method,trials,failures,excused,seconds,ratio_to_default\n" + csv_lines(rays) +
                 csv_lines(pictures));
  const SystemInfo system = system_info();
  const nlohmann::json json{{"pinocchio", version()},
                            {"cpu", system.cpu},
                            {"cores", system.cores},
                            {"rays", to_json(rays)},
                            {"pictures", to_json(pictures)}};
  write_text(folder / "stability.json", json.dump(2) + "\n");
}

}  // namespace pinocchio::stability
