#include "scenes/generator/scenes.h"

#include <array>

namespace pinocchio {
namespace {

struct Entry {
  const char* name;
  int triangles;  // by itself
  Scene (*make)(int triangles, Progress* progress);
};

constexpr std::array<Entry, 5> kScenes{{
    {"two-lights", 0, [](int, Progress*) { return make_two_lights(); }},
    {"speedboat", 16'000, make_speedboat},
    {"cornell", 0, [](int, Progress*) { return make_cornell(); }},
    {"forest", 1'000'000, make_forest},
    {"spd:balls", 400'000, make_spd_balls},
}};

}  // namespace

std::vector<std::string> procedural_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kScenes) names.emplace_back(entry.name);
  return names;
}

Expected<Scene> make_procedural(const std::string& name, const ProceduralOptions& options) {
  for (const Entry& entry : kScenes)
    if (name == entry.name) {
      if (options.triangles > 0 && entry.triangles == 0)
        return Unexpected(InputError{
            {}, 0, "the scene '" + name + "' has a fixed number of triangles", "leave out --triangles"});
      const int triangles = options.triangles > 0 ? options.triangles : entry.triangles;
      begin_phase(options.progress, "generate", triangles);
      Scene scene = entry.make(triangles, options.progress);
      scene.source = name;
      return scene;
    }
  std::string known;
  for (const std::string& n : procedural_names()) known += (known.empty() ? "" : ", ") + n;
  return Unexpected(InputError{{}, 0, "there is no scene '" + name + "'", "choose from " + known});
}

}  // namespace pinocchio
