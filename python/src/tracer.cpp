#include <pinocchio/load.h>
#include <pinocchio/scene.h>
#include <pinocchio/tracer.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>

#include "python/src/interrupt.h"
#include "python/src/parts.h"
#include "python/src/threads.h"

namespace pinocchio::python {
namespace {

constexpr std::size_t kChunk = 4096;  // rays that a thread traces at once

std::shared_ptr<const Mesh> mesh_of(const Floats3& vertices, const Words3& triangles) {
  MeshData mesh;
  mesh.positions = copied<glm::vec3>(vertices);
  mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
  mesh.triangles = copied<glm::uvec3>(triangles);
  mesh.triangle_materials.resize(mesh.triangles.size(), 0u);
  mesh.materials.emplace_back();
  const Scene scene(std::move(mesh));
  (void)value_or_throw(check_scene(scene).map([] { return true; }));
  return scene.mesh;
}

struct Rays {
  const float *origins, *directions, *lengths;
  std::size_t count, origin_step;  // 0: one origin for all

  [[nodiscard]] Ray ray(std::size_t i) const {
    const float *o = origins + i * origin_step, *d = directions + 3 * i;
    return {{o[0], o[1], o[2]}, lengths ? lengths[i] : kInfinity, {d[0], d[1], d[2]}};
  }
};

Rays rays_of(const Floats3& origins, const Floats3& directions, const std::optional<Floats>& t_max) {
  const std::size_t n = directions.shape(0);
  if (origins.shape(0) != n && origins.shape(0) != 1)
    throw Error("there are " + std::to_string(origins.shape(0)) + " origins and " + std::to_string(n) +
                " directions; give the same number, or one origin");
  if (t_max && t_max->shape(0) != n) throw Error("t_max has one number for each ray");
  return {origins.data(), directions.data(), t_max ? t_max->data() : nullptr, n,
          origins.shape(0) == n ? 3u : 0u};
}

// Calls body(first, last) for chunks of [0, n), on at most `threads` threads: fewer for few chunks, or if the
// system does not start them.
void for_chunks(std::size_t n, int threads, const Progress* progress,
                const std::function<void(std::size_t, std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  const auto work = [&] {
    try {
      for (std::size_t first; (first = next.fetch_add(kChunk)) < n;) {
        throw_if_cancelled(progress);
        body(first, std::min(first + kChunk, n));
      }
    } catch (...) {
      next = n;
      const std::lock_guard lock(mutex);
      if (!error) error = std::current_exception();
    }
  };
  const auto chunks = static_cast<int>(std::min<std::size_t>((n + kChunk - 1) / kChunk, 1024));
  {
    std::vector<std::jthread> helpers;
    try {
      for (int i = 1; i < std::min(threads, chunks); ++i) helpers.emplace_back(work);
    } catch (const std::system_error&) {  // the threads that started do all the work
    }
    work();
  }
  if (error) std::rethrow_exception(error);
}

class ArrayTracer {
 public:
  ArrayTracer(std::shared_ptr<const Mesh> mesh, int threads, Progress* progress)
      : threads_(or_one_a_core(threads)),
        tracer_(std::move(mesh), BuildOptions{.threads = threads_, .progress = progress}) {}

  nb::tuple closest_hits(const Floats3& origins, const Floats3& directions,
                         const std::optional<Floats>& t_max) const {
    const Rays rays = rays_of(origins, directions, t_max);
    auto* const t = new float[rays.count];
    const nb::capsule owns_t(t, [](void* p) noexcept { delete[] static_cast<float*>(p); });
    auto* const ids = new std::uint32_t[rays.count];
    const nb::capsule owns_ids(ids, [](void* p) noexcept { delete[] static_cast<std::uint32_t*>(p); });
    without_gil([&](Progress* progress) {
      for_chunks(rays.count, threads_, progress, [&](std::size_t first, std::size_t last) {
        static thread_local std::vector<Ray> some(kChunk);
        static thread_local std::vector<Hit> hits(kChunk);
        for (std::size_t i = first; i < last; ++i) some[i - first] = rays.ray(i);
        tracer_.closest_hits(std::span(some).first(last - first), std::span(hits).first(last - first));
        for (std::size_t i = first; i < last; ++i)
          t[i] = hits[i - first].t, ids[i] = hits[i - first].triangle;
      });
      return true;
    });
    return nb::make_tuple(view_of(t, {rays.count}, owns_t), view_of(ids, {rays.count}, owns_ids));
  }

  auto occluded(const Floats3& origins, const Floats3& directions, const std::optional<Floats>& t_max) const {
    const Rays rays = rays_of(origins, directions, t_max);
    auto* const blocked = new std::uint8_t[rays.count];
    const nb::capsule owns(blocked, [](void* p) noexcept { delete[] static_cast<std::uint8_t*>(p); });
    without_gil([&](Progress* progress) {
      for_chunks(rays.count, threads_, progress, [&](std::size_t first, std::size_t last) {
        static thread_local std::vector<Ray> some(kChunk);
        for (std::size_t i = first; i < last; ++i) some[i - first] = rays.ray(i);
        tracer_.occluded(std::span(some).first(last - first), {blocked + first, last - first});
      });
      return true;
    });
    return view_of(reinterpret_cast<bool*>(blocked), {rays.count}, owns);
  }

 private:
  int threads_;
  Tracer tracer_;
};

}  // namespace

void bind_tracer(nb::module_& module) {
  nb::class_<ArrayTracer>(module, "Tracer", "The ray tracer without a renderer: rays in, hits out.")
      .def(
          "__init__",
          [](ArrayTracer* self, const Floats3& vertices, const Words3& triangles, int threads) {
            const int wanted = threads_wanted(threads);
            const auto mesh = mesh_of(vertices, triangles);
            without_gil([&](Progress* progress) { return new (self) ArrayTracer(mesh, wanted, progress); });
          },
          "vertices"_a, "triangles"_a, "threads"_a = 0,
          "Builds the tree of a mesh.\n"
          "vertices: (n, 3) float32. triangles: (m, 3) uint32, indices of vertices.\n"
          "threads: as for Engine.\n"
          "Raises Error if an index is out of range or a vertex is not finite.")
      .def("closest_hits", &ArrayTracer::closest_hits, "origins"_a, "directions"_a, "t_max"_a = nb::none(),
           "The closest hit of each ray, as (t, triangle).\n"
           "origins: (n, 3), or (1, 3) for all rays. directions: (n, 3), of any length. t_max: (n,), or "
           "None: infinity.\n"
           "t: (n,) float32, in lengths of the ray's direction; inf where nothing is hit.\n"
           "triangle: (n,) uint32; 0xffffffff where nothing is hit.\n"
           "Raises Error if the numbers of rays differ.")
      .def("occluded", &ArrayTracer::occluded, "origins"_a, "directions"_a, "t_max"_a = nb::none(),
           "Whether a triangle is hit within each ray, as (n,) bool. Arguments and errors as for "
           "closest_hits.");
}

}  // namespace pinocchio::python
