#pragma once

#include <functional>
#include <string>
#include <utility>

#include "app/window/scene/scene_source.h"
#include "gl/open/window.h"

namespace pinocchio::app {

// Opens another file or closes the window. Where edits would be lost, a person is asked first.
class Leave {
 public:
  // first: the file that is opened at the start. save: writes the edits to a file.
  Leave(gl::Window& window, Model& model, SceneSource& source, std::string first, std::function<void()> save)
      : window_(window), model_(model), source_(source), save_(std::move(save)), tried_(std::move(first)) {}

  // True if the user closes the window and there are no unsaved edits.
  [[nodiscard]] bool is_closed();
  void request(const Leaving& to);
  // False: the scene in the window was edited while another one was loaded. A person is asked before that one
  // is shown.
  [[nodiscard]] bool may_show() const { return !model_.unsaved || model_.edits == agreed_; }
  void answer(Action action);
  // A file that could not be read is stepped over.
  void open_neighbour(int by);
  // The file that was opened is shown, or was cancelled.
  void arrived() { tried_.clear(); }

 private:
  void leave_now(const Leaving& to);

  gl::Window& window_;
  Model& model_;
  SceneSource& source_;
  std::function<void()> save_;
  int agreed_ = 0;     // as many edits may be lost: Model::edits of the last answer
  std::string tried_;  // the file that was opened last and is not shown. Empty: none
};

}  // namespace pinocchio::app
