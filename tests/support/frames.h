// Frames through a renderer of the test's own, whose buffers may be looked at while each is delivered.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hybrid/engine/engine_parts.h"
#include "hybrid/engine/frame_slot.h"
#include "hybrid/settings/resolve.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

namespace pinocchio {

class FramesTest : public GlTest {
 protected:
  void SetUp() override {
    GlTest::SetUp();
    engine_.emplace(context());
  }
  void TearDown() override {
    engine_.reset();
    GlTest::TearDown();
  }

  static Settings settings_for(const Scene& scene, Settings wanted = {}) {
    wanted.threads.fill(2);
    return resolve(wanted, analyze(scene)).value();
  }
  // With a tree of its own, also where nothing is traced.
  static FrameRequest request(const Scene& scene, const Settings& settings, glm::ivec2 size) {
    return {scene, std::make_shared<const Tracer>(scene.mesh), settings, {first_camera(scene), size}};
  }
  // Each is given to `look` while it is delivered.
  void draw(const std::vector<FrameRequest>& requests, Exchange exchange,
            const std::function<void(Frame&)>& look) {
    Renderer renderer(*engine_, {look, {}});
    for (FrameRequest r : requests) {
      r.settings.exchange = exchange;
      renderer.submit(r);
    }
    renderer.drain();
  }
  static Image<glm::vec4> read(const gl::Texture& texture) {
    Image<glm::vec4> color(texture.size());
    glBindTexture(GL_TEXTURE_2D, texture.name());
    glGetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, color.pixels().data());
    return color;
  }
  [[nodiscard]] const std::shared_ptr<Programs>& programs() { return engine_->parts().gpu().programs; }

  std::optional<Engine> engine_;
};

}  // namespace pinocchio
