// chart --stability: methods against troubles, failures and cost, on one table.
#include "bench/stability/table.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/console.h"
#include "app/exit_codes.h"
#include "app/machine.h"
#include "app/output.h"
#include "bench/stability/picture_trouble.h"
#include "bench/stability/trouble.h"
#include "core/base/system_info.h"
#include "core/image/atomic_file.h"
#include "gl/open.h"

namespace pinocchio::app {
namespace {

constexpr int kRays = 200000, kQuickRays = 2000;  // a trouble; a million at edges
constexpr int kSide = 256, kQuickSide = 64;

// One cell of the table.
struct Cell {
  std::string trouble, failure, method;
  bool limit = false;  // no method is without it
  std::uint64_t trials = 0, failures = 0, excused = 0;
  double seconds = 0.0, ratio = 0.0;  // to the default's, in the same run
  nlohmann::json more = nlohmann::json::object();
};

struct Table {
  std::vector<std::string> methods;
  std::vector<Cell> cells;  // row by row, the default first
};

Cell cell_of(const stability::Trouble& trouble, const stability::Tally& tally) {
  Cell cell;
  cell.failure = trouble.failure;
  cell.limit = trouble.limit;
  cell.trials = tally.trials;
  cell.failures = tally.failures;
  cell.excused = tally.excused;
  cell.seconds = tally.seconds;
  return cell;
}

Cell cell_of(const stability::PictureTrouble&, const stability::PictureTally& tally) {
  Cell cell;
  cell.failure = "black or NaN pixels";
  cell.trials = tally.pixels;
  cell.failures = tally.failures;
  cell.seconds = tally.seconds;
  cell.more = {{"other_ids", tally.other_ids},
               {"worst_difference_there", tally.worst_there},
               {"mean_difference", tally.mean_error},
               {"holes", tally.holes}};
  return cell;
}

// Runs every trouble, as large as `size`, by every method. False where the user asked for an end.
template <class Troubles, class Methods>
bool fill(const Troubles& troubles, const Methods& methods, int size, Progress& progress, Table& table) {
  for (const auto& method : methods) table.methods.push_back(method.name);
  for (const auto& trouble : troubles) {
    double default_seconds = 0.0;
    for (const auto& method : methods) {
      if (interrupted()) return false;
      Cell cell = cell_of(trouble, trouble.run(method, size));
      cell.trouble = trouble.name;
      cell.method = method.name;
      if (&method == &methods.front()) default_seconds = cell.seconds;
      cell.ratio = cell.seconds / std::max(default_seconds, 1e-9);
      table.cells.push_back(std::move(cell));
      progress.step();
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
  std::string text = std::to_string(cell.failures);
  if (!cell.more.contains("other_ids"))
    text += " (" + number("%.2f", cell.ratio) + ")";
  else  // whose times, of all threads and the GPU, say little on a busy machine: they are in the files
    text += ", ids " + std::to_string(cell.more["other_ids"].get<std::uint64_t>()) + ", mean " +
            number("%.4f", cell.more["mean_difference"].get<double>());
  if (cell.more.contains("holes") && cell.more["holes"] != 0)
    text += ", holes " + std::to_string(cell.more["holes"].get<std::uint64_t>());
  return text;
}

// A column a method, a row a trouble: failures, and in brackets the time beside the default's.
std::string markdown(const Table& table) {
  std::string text = "| trouble | of | counted |";
  for (const std::string& method : table.methods) text += " " + method + " |";
  text += "\n|---|---:|---|";
  for (std::size_t i = 0; i < table.methods.size(); ++i) text += "---:|";
  text += "\n";
  for (std::size_t i = 0; i < table.cells.size(); i += table.methods.size()) {
    const Cell& first = table.cells[i];
    text += "| " + first.trouble + (first.limit ? " (limit)" : "") + " | " + std::to_string(first.trials) +
            " | " + first.failure +
            (first.excused > 0 ? " (" + std::to_string(first.excused) + " excused)" : "") + " |";
    for (std::size_t k = 0; k < table.methods.size(); ++k) text += " " + text_of(table.cells[i + k]) + " |";
    text += "\n";
  }
  return text;
}

nlohmann::json to_json(const Table& table) {
  nlohmann::json cells = nlohmann::json::array();
  for (const Cell& c : table.cells) {
    nlohmann::json cell{{"trouble", c.trouble}, {"failure", c.failure}, {"method", c.method},
                        {"limit", c.limit},     {"trials", c.trials},   {"failures", c.failures},
                        {"excused", c.excused}, {"seconds", c.seconds}, {"ratio_to_default", c.ratio}};
    cell.update(c.more);
    cells.push_back(cell);
  }
  return cells;
}

std::string csv_lines(const Table& table) {
  std::string text;
  for (const Cell& c : table.cells)
    text += '"' + c.trouble + "\",\"" + c.failure + "\",\"" + c.method + "\"," + (c.limit ? "1" : "0") + "," +
            std::to_string(c.trials) + "," + std::to_string(c.failures) + "," + std::to_string(c.excused) +
            "," + number("%.6f", c.seconds) + "," + number("%.3f", c.ratio) + "\n";
  return text;
}

// Failures of the defaults: the first column, but for what no method is without.
std::uint64_t default_failures(const Table& table) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < table.cells.size(); i += table.methods.size())
    if (!table.cells[i].limit) sum += table.cells[i].failures;
  return sum;
}

void write_tables(const std::filesystem::path& folder, const Table& rays, const Table& pictures) {
  write_text(folder / "stability.md",
             "Failures, and in brackets the processor time beside the default's.\n\n" + markdown(rays) +
                 "\n" + markdown(pictures));
  write_text(folder / "stability.csv",
             "trouble,counted,method,limit,trials,failures,excused,seconds,ratio_to_default\n" +
                 csv_lines(rays) + csv_lines(pictures));
  const SystemInfo system = system_info();
  write_json(folder / "stability.json", {{"pinocchio", version()},
                                         {"cpu", system.cpu},
                                         {"cores", system.cores},
                                         {"rays", to_json(rays)},
                                         {"pictures", to_json(pictures)}});
}

}  // namespace

int run_stability(const StabilityRequest& request) {
  make_folder(request.folder);
  check_writable(request.folder / "stability.json");
  const DrawOptions& draw = *request.draw;
  const auto context = gl::open_context({draw.backend, draw.device, false});
  const auto methods = stability::all_methods();
  const auto draw_methods = stability::all_draw_methods();
  const auto troubles = stability::all_troubles();
  const auto picture_troubles = stability::picture_troubles();
  Table rays, pictures;
  {
    Progress progress(draw.quiet ? "off" : draw.progress, "stability",
                      methods.size() * troubles.size() + draw_methods.size() * picture_troubles.size());
    if (!fill(troubles, methods, request.quick ? kQuickRays : kRays, progress, rays) ||
        !fill(picture_troubles, draw_methods, request.quick ? kQuickSide : kSide, progress, pictures))
      return kInterrupted;
  }
  write_tables(request.folder, rays, pictures);
  const std::uint64_t failures = default_failures(rays) + default_failures(pictures);
  if (!draw.quiet)
    std::printf("%s\n%s\n%llu failures of the defaults\n%s\n", markdown(rays).c_str(),
                markdown(pictures).c_str(), static_cast<unsigned long long>(failures),
                (request.folder / "stability.md").c_str());
  return failures == 0 ? kDone : kFailed;
}

}  // namespace pinocchio::app
