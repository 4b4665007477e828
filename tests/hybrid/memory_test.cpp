// Many frames with a resize now and then leave memory flat. PINOCCHIO_LONG_RUN=10000 sets the number.
#include <malloc.h>
#include <unistd.h>

#include <fstream>

#include "hybrid/frame.h"
#include "tests/support/draw.h"
#include "tests/support/gl_test.h"

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
  const auto context = gl::open_context({"auto", "", true});
  const Scene scene = load_or_die(source_path("scenes/cornell"));
  const Plan plan = *make_plan(take_census(scene), {});
  const auto prepared =
      std::make_shared<const PreparedScene>(scene, sides_of(plan), BuildOptions{}, std::optional<Isa>());
  Workers workers(2);
  std::size_t delivered = 0;
  double before_mb = 0.0;
  {
    FrameLoop loop(workers, shader_source(), Exchange::pipelined, gl::Mapping::each_time,
                   {[](Flight&) {}, [&](const FrameRecord&) { ++delivered; }});
    for (int i = 0; i < frames; ++i) {
      const glm::ivec2 size = i / kResizeEvery % 2 == 0 ? glm::ivec2(96, 64) : glm::ivec2(61, 83);
      loop.submit({prepared, plan, first_camera(scene), size, {{0, 0}, size}, glm::vec2(0.0f)});
      if (i == frames / 3) before_mb = resident_mb();  // warm by now
    }
    loop.drain();
    const double growth_mb = resident_mb() - before_mb;
    std::printf("  %d frames, a resize every %d: %+.2f MB after the first third\n", frames, kResizeEvery,
                growth_mb);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they keep what was freed
    EXPECT_LT(growth_mb, kMostGrowth_mb);
#endif
  }
  EXPECT_EQ(delivered, static_cast<std::size_t>(frames));
  context->throw_complaints();
}

}  // namespace
}  // namespace pinocchio
