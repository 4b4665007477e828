// The same of glTF, at each allocation of 4 KiB and more: nlohmann::json's destructor, which may not throw,
// takes memory itself, and its constructors leave some behind where there is none.
#include "tests/support/fail_each_allocation.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

TEST(AllocationGltf, Loading) {
  for (const char* name : {"scenes/cornell.gltf", "scenes/terrace.glb", "scenes/windmill.glb"}) {
    const std::size_t triangles = load_or_die(source_path(name)).mesh->triangles.size();
    fail_each_allocation(
        [&] {
          Warnings warnings;
          const Expected<Scene> scene = load_scene(source_path(name), &warnings);
          if (scene && scene->mesh->triangles.size() != triangles)
            ADD_FAILURE() << "a part of the scene is lost";
        },
        [] {});
  }
}

TEST(AllocationGltf, SavingGltf) {
  save_whole_or_not(load_or_die(source_path("scenes/windmill.glb")), "s.gltf", {"s.gltf", "s.bin"});
}

TEST(AllocationGltf, SavingGlb) {
  save_whole_or_not(load_or_die(source_path("scenes/cornell.gltf")), "s.glb", {"s.glb"});
}

}  // namespace
}  // namespace pinocchio
