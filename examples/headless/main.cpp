// Draws a scene to an EXR without a display; the CPU computes shadows and mirrors. The README shows these
// lines.
#include <pinocchio/engine.h>
#include <pinocchio/load.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc < 3) return std::puts("headless SCENE OUT.exr"), 2;
  const auto scene = pinocchio::load_scene(argv[1]);
  if (!scene) return std::puts(scene.error().message().c_str()), 1;
  pinocchio::Engine engine;
  pinocchio::Settings settings;
  settings.depth = 4;  // other settings are resolved: the cheapest that draw the scene exactly
  const auto camera = scene->cameras.empty() ? camera_for_whole_scene(*scene) : scene->cameras.front();
  const auto frame = engine.render(*scene, {.camera = camera, .size = {800, 600}}, settings);
  if (!frame) return std::puts(frame.error().message().c_str()), 1;
  write_exr(argv[2], *frame);
}
