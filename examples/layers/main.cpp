// The layers of a picture, as a data set needs them. Prints a line for each node that is seen: its pixels,
// the box around them, the mean depth, the share in light, and how far it moves until the next frame.
#include <pinocchio/animation.h>
#include <pinocchio/engine.h>
#include <pinocchio/layers.h>
#include <pinocchio/load.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace {

struct Seen {
  int pixels = 0;
  glm::ivec2 low{1 << 30}, high{-1};
  double depth = 0.0, lit = 0.0, motion = 0.0;  // sums
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::puts("layers SCENE [SECONDS [OUT.exr]]"), 2;
  const auto scene = pinocchio::load_scene(argv[1]);
  if (!scene) return std::puts(scene.error().message().c_str()), 1;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 0.0;
  const auto now = at_time(*scene, seconds), then = at_time(*scene, seconds + 1.0 / 24.0);
  if (!now || !then) return std::puts("the scene has no pose at that time"), 1;

  const auto camera_of = [](const pinocchio::Scene& pose) {
    return pose.cameras.empty() ? camera_for_whole_scene(pose) : pose.cameras.front();
  };
  pinocchio::Engine engine;
  const glm::ivec2 size{320, 240};
  auto frame = engine.render(*now, {.camera = camera_of(*now), .size = size});
  if (!frame) return std::puts(frame.error().message().c_str()), 1;
  frame->motion = {then->mesh, camera_of(*then)};

  // An array for each layer that is wanted; the others are not computed.
  const auto pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  std::vector<std::uint32_t> nodes(pixels);
  std::vector<float> depth(pixels);
  std::vector<glm::vec2> motion(pixels);
  std::vector<std::uint8_t> mask(pixels);  // bit i: the light in slot i reaches the point; 8 lights
  pinocchio::FrameArrays arrays;
  arrays.objects = nodes.data();
  arrays.depth = depth.data();
  arrays.motion = motion.data();
  arrays.mask = mask.data();
  write_layers(*frame, arrays);

  std::map<std::uint32_t, Seen> all;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (nodes[i] == pinocchio::kNoTriangle) continue;  // nothing is hit
    Seen& seen = all[nodes[i]];
    const glm::ivec2 at{static_cast<int>(i) % size.x, static_cast<int>(i) / size.x};
    ++seen.pixels;
    seen.low = min(seen.low, at);
    seen.high = max(seen.high, at + 1);
    seen.depth += static_cast<double>(depth[i]);
    seen.lit += mask[i] != 0 ? 1.0 : 0.0;
    seen.motion += static_cast<double>(length(motion[i]));
  }
  for (const auto& [node, seen] : all) {
    std::string name = now->nodes ? now->nodes->nodes[node].name : "";
    if (name.empty()) name = "#" + std::to_string(node);
    std::printf("%s: %d pixels, box %d %d %d %d, depth %.3f, lit %.2f, motion %.2f\n", name.c_str(),
                seen.pixels, seen.low.x, seen.low.y, seen.high.x, seen.high.y, seen.depth / seen.pixels,
                seen.lit / seen.pixels, seen.motion / seen.pixels);
  }
  if (argc > 3) write_exr(argv[3], *frame, {.layers = "all,id.node,motion"});
}
