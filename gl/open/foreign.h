#pragma once

#include "gl/context/context.h"
#include "gl/context/state.h"

namespace pinocchio::gl {

// The caller's context, current on this thread. The caller keeps owning it. Between enter() and leave() its
// state is ours.
class ForeignContext final : public Context {
 public:
  using GetProcAddress = void (*(*)(const char*))();

  // Throws NoContextError where the context has less than we need.
  ForeignContext(GetProcAddress get_proc_address, bool debug);
  ~ForeignContext() override { drop_data(); }

  // Throws Error where the context is not current on this thread.
  void enter() override;
  void leave() noexcept override;

 private:
  [[nodiscard]] bool is_bound() const override { return native_.is_context_of(NativeContext::now()); }
  void bind() override {}
  void unbind() override {}
  [[nodiscard]] GLADloadfunc loader() const override { return get_proc_address_; }
  void listen();
  void stop_listening() noexcept;

  GetProcAddress get_proc_address_;
  bool debug_;
  NativeContext native_ = NativeContext::now();
  ContextData* before_ = nullptr;  // current on this thread before enter()
  SavedState state_;

  // The caller's debug callback, while ours replaces it.
  struct {
    GLboolean output = GL_FALSE, synchronous = GL_FALSE;
    void *callback = nullptr, *user = nullptr;
  } listener_;
};

}  // namespace pinocchio::gl
