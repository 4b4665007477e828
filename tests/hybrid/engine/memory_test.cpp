// Many frames with a resize now and then leave memory flat. PINOCCHIO_LONG_RUN=10000 sets the number.
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "tests/support/draw.h"

namespace pinocchio {
namespace {

constexpr int kResizeEvery = 50;
constexpr double kMostGrowth_mb = 2.0;

double resident_mb() {
  malloc_trim(0);
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

TEST(Memory, IsFlatOverManyFramesAndResizes) {
  const char* wanted = std::getenv("PINOCCHIO_LONG_RUN");
  const int frames = wanted ? std::atoi(wanted) : 1200;
  Engine engine({.gl_debug = true});
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  Settings settings;
  settings.threads = 2;
  settings.exchange = Exchange::pipelined;
  settings = engine.resolve(scene, {96, 64}, settings).value();
  FrameRequest request{scene, Engine::prepare(scene, settings), settings, {first_camera(scene)}};
  std::size_t delivered = 0;
  double before_mb = 0.0;
  {
    Renderer renderer(engine, {{}, [&](const FrameRecord&) { ++delivered; }});
    for (int i = 0; i < frames; ++i) {
      request.view.size = i / kResizeEvery % 2 == 0 ? glm::ivec2(96, 64) : glm::ivec2(61, 83);
      request.view.camera.eye.x += 1e-5f;  // no frame is the last one again
      renderer.submit(request);
      if (i == frames / 3) before_mb = resident_mb();  // warm by now
    }
    renderer.drain();
    const double growth_mb = resident_mb() - before_mb;
    std::printf("  %d frames, a resize every %d: %+.2f MB after the first third\n", frames, kResizeEvery,
                growth_mb);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was freed
    EXPECT_LT(growth_mb, kMostGrowth_mb);
#endif
  }
  EXPECT_EQ(delivered, static_cast<std::size_t>(frames));
  engine.throw_gl_complaints();
}

}  // namespace
}  // namespace pinocchio
