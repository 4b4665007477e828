// The ray tracer without a renderer: rays in, hits out. Prints the scene in letters: # is lit by its light, .
// is in shadow.
#include <pinocchio/load.h>
#include <pinocchio/tracer.h>
#include <pinocchio/view.h>

#include <cstdio>

using namespace pinocchio;

int main(int argc, char** argv) {
  const Expected<Scene> scene = load_scene(argc > 1 ? argv[1] : "");
  if (!scene) return std::fprintf(stderr, "%s\n", scene.error().message().c_str()), 1;
  const View view{.camera = camera_for_whole_scene(*scene), .size = {72, 36}};
  const Light light = scene->lights.empty() ? default_light(*scene, view.camera) : scene->lights.front();

  const Tracer tracer(scene->mesh);
  const Image<Ray> rays = camera_rays(view);
  Image<Hit> hits(view.size);
  tracer.closest_hits(rays.pixels(), hits.pixels());

  Image<Ray> to_light(view.size);
  for (std::size_t i = 0; i < hits.pixels().size(); ++i) {
    // The shadow ray starts in front of the surface, so that the surface does not shadow itself.
    const glm::vec3 point =
        hits[i].valid() ? rays[i].origin + 0.999f * hits[i].t * rays[i].direction : light.position;
    to_light[i] = {point, 1.0f, light.position - point};
  }
  Image<std::uint8_t> blocked(view.size);
  tracer.occluded(to_light.pixels(), blocked.pixels());

  for (int y = 0; y < view.size.y; ++y, std::putchar('\n'))
    for (int x = 0; x < view.size.x; ++x)
      std::putchar(!hits.at(x, y).valid() ? ' ' : blocked.at(x, y) ? '.' : '#');
}
