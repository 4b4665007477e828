// Frames through a loop of the test's own, whose buffers may be looked at while each is delivered.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "gl/transfer.h"
#include "hybrid/formats.h"
#include "hybrid/frame.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

namespace pinocchio {

class FramesTest : public GlTest {
 protected:
  void TearDown() override {
    programs_.reset();
    GlTest::TearDown();
  }

  static std::shared_ptr<const PreparedScene> prepare(const Scene& scene) {
    return std::make_shared<const PreparedScene>(scene, Sides{}, BuildOptions{}, std::optional<Isa>());
  }
  static FrameRequest request(const std::shared_ptr<const PreparedScene>& scene, const Plan& plan,
                              glm::ivec2 size) {
    return {scene, plan, first_camera(scene->scene), size, {{0, 0}, size}, glm::vec2(0.0f)};
  }
  static Plan plan_of(const Scene& scene, const PlanRequest& wanted = {}) {
    return *make_plan(take_census(scene), wanted);
  }
  // Each is given to `look` while it is delivered.
  void draw(const std::vector<FrameRequest>& requests, Exchange exchange,
            const std::function<void(Flight&)>& look) {
    FrameLoop loop(workers_, programs_, exchange, gl::Mapping::each_time, {look, [](const FrameRecord&) {}});
    for (const FrameRequest& r : requests) loop.submit(r);
    loop.drain();
  }
  // RGBA16F.
  static Image<glm::vec4> read(const gl::Framebuffer& target) {
    Image<glm::vec4> color(target.size());
    gl::Readback back;
    back.start(target);
    unpack_picture(back.open(), color);
    back.close();
    return color;
  }

  Workers workers_{2};
  std::shared_ptr<Programs> programs_ = std::make_shared<Programs>();
};

}  // namespace pinocchio
