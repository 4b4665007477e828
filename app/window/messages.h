#pragma once

#include <string>
#include <vector>

namespace pinocchio::app {

// What the window has to say, outside of its panels; each is on the terminal, too. News go by themselves
// after some seconds, warnings and errors stay until they are dismissed or what they are about is mended.
class Messages {
 public:
  enum class Kind { news, warning, error };
  struct Message {
    Kind kind;
    std::string text;
    std::string about;     // what failed; empty: nothing that can be mended
    double until_s = 0.0;  // of the steady clock; news only
  };

  void news(const std::string& text, double seconds = 4.0);
  // What a key cannot do now, and why: news on the display, nothing for the terminal's log.
  void hint(const std::string& text, double seconds = 8.0);
  void warning(const std::string& text);
  // In place of another error about the same; the same again says nothing.
  void error(const std::string& about, const std::string& text);
  void mended(const std::string& about);
  void dismiss(std::size_t i);
  void dismiss_all() { all_.clear(); }

  // Drops what is over; whether something was.
  bool expire(double now_s);
  [[nodiscard]] const std::vector<Message>& all() const { return all_; }

 private:
  void add(Message message);
  std::vector<Message> all_;
};

}  // namespace pinocchio::app
