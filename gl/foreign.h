#pragma once

#include <string>

#include "gl/context.h"
#include "gl/error.h"

namespace pinocchio::gl {

// A context of somebody else's, current on this thread; whoever made it keeps it.
class ForeignContext final : public Context {
 public:
  using GetProcAddress = void (*(*)(const char*))();

  // Throws NoContextError where the context is less than we need.
  ForeignContext(GetProcAddress get_proc_address, bool debug) try : get_proc_address_(get_proc_address) {
    make_current();
    describe("foreign", "the caller's context", debug);
  } catch (const Error& error) {
    throw NoContextError(std::string("the caller's OpenGL context does not serve: ") + error.what());
  }
  void release() override {}

 private:
  void bind() override {}
  [[nodiscard]] GLADloadfunc loader() const override { return get_proc_address_; }

  GetProcAddress get_proc_address_;
};

}  // namespace pinocchio::gl
