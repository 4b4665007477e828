// Loading and saving while memory runs out: at each of their allocations in turn.
#include "tests/support/fail_each_allocation.h"
#include "tests/support/scenes.h"

namespace pinocchio {
namespace {

namespace fs = std::filesystem;

void load_whole_or_not(const fs::path& file) {
  ASSERT_EQ(load_or_die(file).mesh->triangles.size(), 1u);
  fail_each_allocation(
      [&] {
        Warnings warnings;
        const Expected<Scene> scene = load_scene(file, &warnings);
        if (scene && scene->mesh->triangles.size() != 1) ADD_FAILURE() << "a part of the scene is lost";
      },
      [] {});
}

TEST(Allocation, LoadingObj) {
  write(own_file("a.mtl"), "newmtl m\nKd 1 0 0\nmap_Kd a.ppm\n");
  write(own_file("a.ppm"), "P6 1 1 255\nabc");
  write(own_file("a.obj"),
        "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\nl 1 2\nodd\n");
  load_whole_or_not(own_file("a.obj"));
}

TEST(Allocation, LoadingPly) {
  write(own_file("a.ply"),
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property float odd\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0\n"
        "1 0 0 0\n0 1 0 0\n3 0 1 2\n");
  load_whole_or_not(own_file("a.ply"));
}

TEST(Allocation, SavingObj) {
  save_whole_or_not(plate_over_floor(), "s.obj", {"s.obj", "s.mtl"});
}

}  // namespace
}  // namespace pinocchio
