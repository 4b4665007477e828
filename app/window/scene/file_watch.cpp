#include "app/window/scene/file_watch.h"

#include <algorithm>

namespace pinocchio::app {

namespace {

bool contains(const std::vector<std::string>& files, const std::string& file) {
  return std::find(files.begin(), files.end(), file) != files.end();
}

}  // namespace

FileWatch::FileWatch(std::filesystem::path folder) : folder_(std::move(folder)) {
  known_ = pending_ = read_stamps();
}

FileWatch::FileWatch(std::vector<std::string> files) : files_(std::move(files)) {
  known_ = pending_ = read_stamps();
}

void FileWatch::follow(std::vector<std::string> files) {
  const std::vector<std::string> before = std::exchange(files_, std::move(files));
  const auto dropped = [this](const auto& one) { return !contains(files_, one.first); };
  std::erase_if(known_, dropped);
  std::erase_if(pending_, dropped);
  for (const auto& [file, stamp] : read_stamps())
    if (!contains(before, file)) known_[file] = pending_[file] = stamp;
}

bool FileWatch::changed(double now_s, double period_s) {
  if (now_s - polled_s_ < period_s) return false;
  polled_s_ = now_s;
  Stamps seen = read_stamps();
  // File by file: the others need not wait for one that is written all the time.
  bool settled = false;
  for (const auto& [file, stamp] : seen) {
    const auto before = pending_.find(file), known = known_.find(file);
    if (before == pending_.end() || before->second != stamp) continue;
    if (known != known_.end() && known->second == stamp) continue;
    known_[file] = stamp;
    settled = true;
  }
  const auto gone = [&](const auto& one) {
    return !seen.contains(one.first) && !pending_.contains(one.first);
  };
  settled = std::erase_if(known_, gone) > 0 || settled;
  pending_ = std::move(seen);
  return settled;
}

FileWatch::Stamps FileWatch::read_stamps() const {
  Stamps stamps;
  const auto add = [&stamps](const std::filesystem::directory_entry& file) {
    std::error_code gone;  // it was removed meanwhile, or is not there yet
    if (!file.is_regular_file(gone) || gone) return;
    const auto time = file.last_write_time(gone);
    const std::uintmax_t size = file.file_size(gone);
    if (!gone) stamps[file.path().string()] = {time.time_since_epoch().count(), size};
  };
  std::error_code error;
  for (const std::string& file : files_) add(std::filesystem::directory_entry(file, error));
  if (folder_.empty()) return stamps;
  using Iterator = std::filesystem::recursive_directory_iterator;
  for (Iterator at(folder_, std::filesystem::directory_options::skip_permission_denied, error), end;
       !error && at != end && stamps.size() < kMost; at.increment(error))
    add(*at);
  return stamps;
}

}  // namespace pinocchio::app
