#pragma once

#include "gl/context.h"
#include "gl/state.h"

namespace pinocchio::gl {

// A context of somebody else's, current on this thread; whoever made it keeps it. Between enter() and leave()
// its state is ours.
class ForeignContext final : public Context {
 public:
  using GetProcAddress = void (*(*)(const char*))();

  // Throws NoContextError where the context is less than we need.
  ForeignContext(GetProcAddress get_proc_address, bool debug);
  ~ForeignContext() override { drop_data(); }

  // Throws Error where it is not this thread's context.
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
  ContextData* before_ = nullptr;  // that was current on this thread
  SavedState state_;

  // The caller's listener, where we listen.
  struct {
    GLboolean output = GL_FALSE, synchronous = GL_FALSE;
    void *callback = nullptr, *user = nullptr;
  } listener_;
};

}  // namespace pinocchio::gl
