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
  if (seen == known_) return false;
  const bool settled = seen == pending_;
  pending_ = std::move(seen);
  if (settled) known_ = pending_;
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
