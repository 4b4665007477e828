#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pinocchio::app {

// Tells when files change, by their times and sizes.
class FileWatch {
 public:
  // All files of `folder` and below, at most kMost.
  explicit FileWatch(std::filesystem::path folder);
  // These files, which need not exist yet.
  explicit FileWatch(std::vector<std::string> files);

  // Watches these files from now on. A change of one that was watched before still counts.
  void follow(std::vector<std::string> files);

  // Whether a file has changed since the start, or since the last true. A change counts when it is the same
  // in two polls: a file that is still being written is waited for. Polls at most every `period_s`.
  [[nodiscard]] bool changed(double now_s, double period_s = 0.3);

 private:
  static constexpr std::size_t kMost = 2000;
  using Stamps = std::map<std::string, std::pair<std::int64_t, std::uintmax_t>>;
  [[nodiscard]] Stamps read_stamps() const;

  std::filesystem::path folder_;  // empty: files_ are watched
  std::vector<std::string> files_;
  Stamps known_, pending_;
  double polled_s_ = 0.0;
};

}  // namespace pinocchio::app
