#pragma once

#include <array>
#include <memory>

#include "gl/objects/draw.h"
#include "gl/objects/program.h"
#include "gl/objects/texture.h"
#include "hybrid/gpu/gpu_maps.h"
#include "pinocchio/backfaces.h"
#include "pinocchio/conversion.h"
#include "pinocchio/scene.h"

namespace pinocchio {

// A mesh on the GPU: triangles for the rasteriser, texture buffers for shaders/scene_fetch.glsl. Throws
// gl::Error where the GPU has no room.
class GpuMesh {
 public:
  // Meshes with the same textures or geometry, which are not sent again; null: none is known.
  struct Shared {
    const GpuMesh* textures = nullptr;
    const GpuMesh* geometry = nullptr;  // has_same_geometry
  };
  explicit GpuMesh(const Mesh& mesh, const Shared& shared);
  explicit GpuMesh(const Mesh& mesh) : GpuMesh(mesh, Shared{}) {}

  // Whether nobody else has any of its buffers of vertices and triangles.
  [[nodiscard]] bool is_alone() const { return geometry_.use_count() == 1; }
  // Sends what differs between two poses of one mesh: from now on this is `now`. is_alone().
  void move(const MeshPose& before, const Mesh& now);

  void draw() const { geometry_->triangles.draw(); }
  // Sets the buffers of the program in use, on texture units from `first_unit` on; returns the next free one.
  int bind(const gl::Program& program, int first_unit) const;

  // How many of the triangles have backs that the camera sees through.
  enum class Share { none, some, all };
  [[nodiscard]] Share passed_backs(Backfaces backfaces) const { return passed_backs_[as_size(backfaces)]; }
  // Binds the table of them for shaders/visibility.frag, as bind() binds the rest.
  int bind_backs(const gl::Program& program, int first_unit) const;

  [[nodiscard]] const GpuMaps& maps() const { return maps_; }
  [[nodiscard]] float z_near() const { return z_near_; }  // scene units
  [[nodiscard]] const Bounds& bounds() const { return bounds_; }

 private:
  struct Geometry {
    explicit Geometry(const Mesh& mesh);
    gl::Mesh triangles;
    gl::TextureBuffer corners, triangle_materials, positions, normals;
  };
  std::shared_ptr<Geometry> geometry_;
  gl::TextureBuffer materials_, backs_;
  std::array<Share, kBackfaces.size()> passed_backs_;
  GpuMaps maps_;
  float z_near_;
  Bounds bounds_;
};

// Whether both are poses of one mesh.
[[nodiscard]] bool are_poses_of_one(const Mesh& a, const Mesh& b);

// Whether the meshes differ only in materials and maps, as after an edit.
[[nodiscard]] bool has_same_geometry(const Mesh& a, const Mesh& b);

// A frame's lights on the GPU.
class GpuLights {
 public:
  // Sends the scene's lights, unless they are there already.
  void update(const Scene& scene);
  int bind(const gl::Program& program, int first_unit) const;
  [[nodiscard]] bool any_size() const { return any_size_; }
  [[nodiscard]] int casting() const { return casting_; }  // how many cast shadows

 private:
  std::vector<Light> sent_;
  bool any_size_ = false;
  int casting_ = 0;
  gl::TextureBuffer lights_;
  glm::vec3 ambient_light_{0.0f};
  bool empty_ = true;  // no lights were sent yet
};

}  // namespace pinocchio
