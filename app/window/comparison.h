#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "core/compare/reference_error.h"
#include "gl/transfer.h"
#include "hybrid/inspect/progressive_reference.h"

namespace pinocchio::app {

// The window's picture beside the precise one: the reference as far as it has come, a heat map of how they
// differ, and how much. Nothing here waits; lives on the thread of the GL context.
class Comparison {
 public:
  // Follows the view, and takes what threads have finished; whether there is something new to show.
  bool follow(const ReferenceView& view);
  // Whether a picture to compare would be used now.
  [[nodiscard]] bool wants_picture() const;
  // The window's picture of the view that is followed.
  void compare(Image<glm::vec4> picture);

  // Null: there is none yet.
  [[nodiscard]] const gl::Texture* reference() const { return reference_.get(); }
  [[nodiscard]] const gl::Texture* heat() const { return heat_.get(); }
  // Its colour, linear; done().
  [[nodiscard]] glm::vec3 reference_at(glm::ivec2 pixel) const {
    return glm::vec3(color_.at(pixel.x, pixel.y));
  }
  // Whether all that can be known of the view is known.
  [[nodiscard]] bool done() const {
    const bool measured = figures_ && compared_share_ >= 1.0 && !error_.valid();  // not of an earlier share
    return share_ >= 1.0 && measured && !newer_;
  }
  // How far the reference is or, once it is complete, the error, in words.
  [[nodiscard]] std::string text() const;

 private:
  bool take_error();

  ProgressiveReference background_;
  Workers workers_{1};
  std::optional<ReferenceView> view_;
  Image<glm::vec4> color_;  // of the reference, newest
  double share_ = 0.0;
  double uploaded_s_ = 0.0, compared_s_ = 0.0;
  bool newer_ = false;  // color_ than the texture
  std::future<ReferenceError> error_;
  ReferenceView error_of_;  // view of error_
  std::optional<ReferenceError> figures_;
  double compared_share_ = 0.0;
  gl::Upload upload_, heat_upload_;
  std::unique_ptr<gl::Texture> reference_, heat_;
};

}  // namespace pinocchio::app
