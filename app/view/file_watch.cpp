#include "app/view/file_watch.h"

#include <algorithm>

namespace pinocchio::app {

FileWatch::FileWatch(std::filesystem::path folder, std::vector<std::string> extensions)
    : folder_(std::move(folder)), extensions_(std::move(extensions)) {
  if (folder_.empty()) folder_ = ".";
  known_ = pending_ = look();
}

bool FileWatch::changed(double now_s, double period_s) {
  if (now_s - looked_s_ < period_s) return false;
  looked_s_ = now_s;
  Stamps seen = look();
  // File by file: one that is written all the time does not hold up the others.
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

FileWatch::Stamps FileWatch::look() const {
  Stamps stamps;
  std::error_code error;
  using Iterator = std::filesystem::recursive_directory_iterator;
  for (Iterator at(folder_, std::filesystem::directory_options::skip_permission_denied, error), end;
       !error && at != end && stamps.size() < kMost; at.increment(error)) {
    std::error_code gone;  // between listing and looking
    if (!at->is_regular_file(gone) || gone) continue;
    const std::string extension = at->path().extension().string();
    if (!extensions_.empty() &&
        std::find(extensions_.begin(), extensions_.end(), extension) == extensions_.end())
      continue;
    const auto time = at->last_write_time(gone);
    const std::uintmax_t size = at->file_size(gone);
    if (!gone) stamps[at->path().string()] = {time.time_since_epoch().count(), size};
  }
  return stamps;
}

}  // namespace pinocchio::app
