#include <algorithm>

#include "pinocchio/load.h"

namespace pinocchio {

std::string Warning::message() const {
  std::string text = file + ": ";
  if (!where.empty()) text += where + ": ";
  text += what;
  if (places > 1)
    text += " (and in " + std::to_string(places - 1) + (places > 2 ? " more places)" : " more place)");
  if (!lost.empty()) text += "; " + lost;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');  // one line
  return text;
}

void Warnings::add(Warning warning) {
  const auto [known, is_new] = known_.try_emplace({warning.file, warning.what}, all_.size());
  if (is_new)
    all_.push_back(std::move(warning));
  else
    all_[known->second].places += warning.places;
}

}  // namespace pinocchio
