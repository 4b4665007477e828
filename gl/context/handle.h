#pragma once

#include <utility>

#include "gl/context/functions.h"

namespace pinocchio::gl {

// Owns a GL name of the context that is current at construction. Move-only. Delete is called in that context,
// whichever thread destroys the handle.
template <class Delete, class Name = GLuint>
class Handle {
 public:
  Handle() = default;
  explicit Handle(Name name) : name_(name), context_(current->weak_from_this()) {}
  ~Handle() { reset(); }
  Handle(Handle&& other) noexcept
      : name_(std::exchange(other.name_, Name{})), context_(std::move(other.context_)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, Name{});
      context_ = std::move(other.context_);
    }
    return *this;
  }

  [[nodiscard]] Name name() const { return name_; }
  explicit operator bool() const { return name_ != Name{}; }

 private:
  void reset() {
    if (name_ != Name{}) delete_in(context_, [name = name_] { Delete()(name); });
    name_ = Name{};
  }

  Name name_{};
  std::weak_ptr<ContextData> context_;
};

}  // namespace pinocchio::gl
