// A GoogleTest fixture with an OpenGL context; what the driver complains about fails the test.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "gl/open/open.h"

namespace pinocchio {

class GlTest : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { context_ = gl::open_context({GetParam(), "", true}); }
  void TearDown() override {
    if (!context_) return;  // none could be opened, and SetUp said why
    for (const std::string& complaint : context_->complaints()) ADD_FAILURE() << "OpenGL: " << complaint;
  }
  [[nodiscard]] gl::Context& context() { return *context_; }

 private:
  std::unique_ptr<gl::Context> context_;
};

inline const auto kBackends = testing::Values("egl", "osmesa");
inline std::string backend_name(const testing::TestParamInfo<const char*>& info) {
  return info.param;
}

}  // namespace pinocchio
