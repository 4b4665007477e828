#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace pinocchio::app {

// Tells when files change, by looking at their times and sizes now and then.
class FileWatch {
 public:
  // All files of `folder` and below, at most kMost.
  explicit FileWatch(std::filesystem::path folder);
  // These, whether they are there yet or not.
  explicit FileWatch(std::vector<std::string> files);

  // These from now on, of a watch of files. What has changed in one that was watched before still counts.
  void follow(std::vector<std::string> files);

  // Whether they differ from what they were at the start, or at the last true. A change counts when it has
  // lasted from one look to the next: a file that is still being written is waited for, and does not hold up
  // the others. Looks at most every `period_s`.
  [[nodiscard]] bool changed(double now_s, double period_s = 0.3);

 private:
  static constexpr std::size_t kMost = 2000;
  using Stamps = std::map<std::string, std::pair<std::int64_t, std::uintmax_t>>;
  [[nodiscard]] Stamps look() const;

  std::filesystem::path folder_;    // empty: files_
  std::vector<std::string> files_;  // not of a folder
  Stamps known_, pending_;
  double looked_s_ = 0.0;
};

}  // namespace pinocchio::app
