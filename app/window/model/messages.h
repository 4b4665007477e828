#pragma once

#include <string>
#include <vector>

namespace pinocchio::app {

// What the window tells outside of its panels, and on the terminal. News disappear after some seconds.
// Warnings and errors stay until they are dismissed, errors also until what failed succeeds.
class Messages {
 public:
  enum class Kind { news, warning, error };
  struct Message {
    Kind kind;
    std::string text;
    std::string about;     // what failed, or what a hint is about. Empty: nothing that is replaced
    double until_s = 0.0;  // of the steady clock. News only
  };

  void news(const std::string& text, double seconds = 4.0);
  // News for the display alone, such as why a key does nothing now.
  // about: it replaces an earlier hint about the same. Empty: none.
  void hint(const std::string& text, double seconds = 8.0, const std::string& about = {});
  void warning(const std::string& text);
  // The warnings were about a scene that is no longer shown, or a person has read them.
  void clear_warnings();
  // Replaces an earlier error about the same. The same text is not repeated.
  void error(const std::string& about, const std::string& text);
  // `about` works again: its error disappears.
  void clear(const std::string& about);
  void dismiss(std::size_t i);

  // Drops news whose time is over. True: there were some.
  bool expire(double now_s);
  [[nodiscard]] const std::vector<Message>& all() const { return all_; }

 private:
  void add(Message message);
  std::vector<Message> all_;
};

}  // namespace pinocchio::app
