#include "app/window/model/messages.h"

#include <algorithm>
#include <cstdio>

#include "core/base/clock.h"

namespace pinocchio::app {
namespace {

constexpr std::size_t kMost = 100;  // warnings of one file are folded into one line

}  // namespace

void Messages::add(Message message) {
  const auto same = [&](const Message& m) { return m.kind == message.kind && m.text == message.text; };
  std::erase_if(all_, same);
  all_.push_back(std::move(message));
  if (all_.size() > kMost) all_.erase(all_.begin());
}

void Messages::news(const std::string& text, double seconds) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
  hint(text, seconds);
}

void Messages::hint(const std::string& text, double seconds, const std::string& about) {
  clear(about);
  add({Kind::news, text, about, now_s() + seconds});
}

void Messages::warning(const std::string& text) {
  std::fprintf(stderr, "pinocchio: warning: %s\n", text.c_str());
  add({Kind::warning, text, {}});
}

void Messages::error(const std::string& about, const std::string& text) {
  const auto known = std::ranges::find(all_, about, &Message::about);
  if (known != all_.end() && known->text == text) return;
  clear(about);
  std::fprintf(stderr, "pinocchio: %s\n", text.c_str());
  add({Kind::error, text, about});
}

void Messages::clear(const std::string& about) {
  std::erase_if(all_, [&](const Message& m) { return !m.about.empty() && m.about == about; });
}

void Messages::clear_warnings() {
  std::erase_if(all_, [](const Message& m) { return m.kind == Kind::warning; });
}

void Messages::dismiss(std::size_t i) {
  if (i < all_.size()) all_.erase(all_.begin() + i);
}

bool Messages::expire(double now_s) {
  return std::erase_if(all_, [&](const Message& m) { return m.kind == Kind::news && m.until_s < now_s; }) > 0;
}

}  // namespace pinocchio::app
