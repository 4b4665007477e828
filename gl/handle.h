#pragma once

#include <glad/gl.h>

#include <utility>

namespace pinocchio::gl {

// Owns one GL name; move-only. Delete is called with it at the end, in the context that made it.
template <class Delete>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }

  [[nodiscard]] GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  void reset() {
    if (name_ != 0) Delete()(name_);
    name_ = 0;
  }

  GLuint name_ = 0;
};

}  // namespace pinocchio::gl
