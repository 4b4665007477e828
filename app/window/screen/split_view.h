#pragma once

#include <memory>
#include <optional>

#include "app/window/model/model.h"
#include "pinocchio/renderer.h"

namespace pinocchio::app {

// The window's right half: the reference of the picture, or its difference from the picture.
class SplitView {
 public:
  explicit SplitView(Model& model);
  ~SplitView();

  // Draws the reference of this request where the window is split. True: there is something new to show.
  bool follow(const FrameRequest& request);
  // Measures how far a delivered frame is from the reference, where that is `newest`'s.
  void compare(const Frame& frame, const std::optional<FrameRequest>& newest);

  [[nodiscard]] bool is_on() const { return comparison_ != nullptr; }
  [[nodiscard]] bool is_done() const;
  [[nodiscard]] bool wants_picture() const;
  // What the right half shows. Null: nothing yet.
  [[nodiscard]] const gl::Texture* texture() const;
  // The largest difference of a colour channel. Nothing: the reference is not complete.
  [[nodiscard]] std::optional<double> error_of(const PixelReport& pixel) const;

 private:
  class Comparison;

  Model& model_;
  std::unique_ptr<Comparison> comparison_;  // null: the window is not split
};

}  // namespace pinocchio::app
