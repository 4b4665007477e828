#include <pinocchio/load.h>
#include <pinocchio/scene.h>
#include <pinocchio/tracer.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <functional>
#include <mutex>
#include <system_error>
#include <thread>

#include "pinocchio/conversion.h"
#include "python/src/scene/scene.h"
#include "python/src/support/interrupt.h"
#include "python/src/support/parts.h"
#include "python/src/threads.h"

namespace pinocchio::python {
namespace {

constexpr std::size_t kChunk = 4096;  // rays that a thread traces at once

Scene scene_of(const Floats3& vertices, const Words3& triangles) {
  MeshData mesh;
  mesh.positions = copied<glm::vec3>(vertices.read("vertices"));
  mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
  mesh.triangles = copied<glm::uvec3>(triangles.read("triangles"));
  mesh.triangle_materials.resize(mesh.triangles.size(), 0u);
  mesh.materials.emplace_back();
  Scene scene(std::move(mesh));
  (void)value_or_throw(check_scene(scene).map([] { return true; }));
  return scene;
}

struct Rays {
  Floats3::Array o, d;
  std::optional<Floats::Array> t_max;
  const float *origins, *directions, *lengths;
  std::size_t count, origin_step, length_step;  // 0: one for all

  [[nodiscard]] Ray ray(std::size_t i) const {
    const float *o = origins + i * origin_step, *d = directions + 3 * i;
    return {{o[0], o[1], o[2]}, lengths ? lengths[i * length_step] : kInfinity, {d[0], d[1], d[2]}};
  }
};

Rays rays_of(const Floats3& origins, const Floats3& directions, const std::optional<Floats>& t_max) {
  Rays rays{.o = origins.read("origins"),
            .d = directions.read("directions"),
            .t_max = {},
            .origins = nullptr,
            .directions = nullptr,
            .lengths = nullptr,
            .count = 0,
            .origin_step = 0,
            .length_step = 1};
  const std::size_t n = rays.d.shape(0);
  if (rays.o.shape(0) != n && rays.o.shape(0) != 1)
    throw Error("there are " + std::to_string(rays.o.shape(0)) + " origins and " + std::to_string(n) +
                " directions; give the same number, or one origin");
  if (t_max) {
    const nb::object& given = t_max->source;
    const bool is_array = nb::hasattr(given, "ndim");
    const bool is_number = is_array ? nb::cast<int>(given.attr("ndim")) == 0 : !nb::hasattr(given, "__len__");
    rays.t_max = (is_number ? Floats{nb::make_tuple(t_max->source)} : *t_max).read("t_max");
  }
  if (rays.t_max && rays.t_max->shape(0) != n && rays.t_max->shape(0) != 1)
    throw Error("t_max must have one number for each ray, or one for all");
  if (rays.t_max && rays.t_max->shape(0) != n) rays.length_step = 0;
  rays.origins = rays.o.data();
  rays.directions = rays.d.data();
  rays.lengths = rays.t_max ? rays.t_max->data() : nullptr;
  rays.count = n;
  rays.origin_step = rays.o.shape(0) == n ? 3u : 0u;
  return rays;
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
  const auto chunks = as_int(std::min<std::size_t>((n + kChunk - 1) / kChunk, 1024));
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

// The hits of some rays. What `wanted` names is computed from them at first use.
struct Hits {
  std::shared_ptr<const Scene> scene;
  std::vector<Ray> rays;
  std::vector<float> t;
  std::vector<std::uint32_t> triangle;
};

// The point of a hit and its triangle.
struct HitPoint {
  glm::vec3 weights{0.0f};  // of the triangle's vertices
  glm::vec3 position{0.0f};
  glm::vec3 facet{0.0f}, shading{0.0f};  // unit normals towards the ray's origin
};

HitPoint point_of(const Mesh& mesh, const Ray& ray, float t, std::uint32_t triangle) {
  const glm::uvec3 corners = mesh.triangles[triangle];
  const glm::dvec3 a(mesh.positions[corners.x]), ab = glm::dvec3(mesh.positions[corners.y]) - a,
                                                 ac = glm::dvec3(mesh.positions[corners.z]) - a;
  const glm::dvec3 p = glm::dvec3(ray.origin) + as_double(t) * glm::dvec3(ray.direction);
  const glm::dvec3 n = glm::cross(ab, ac);
  const double area = glm::dot(n, n);
  HitPoint point;
  if (area > 0.0) {
    const double b = std::clamp(glm::dot(glm::cross(p - a, ac), n) / area, 0.0, 1.0);
    const double c = std::clamp(glm::dot(glm::cross(ab, p - a), n) / area, 0.0, 1.0 - b);
    point.weights = {1.0 - b - c, b, c};
    point.facet = glm::vec3(n / std::sqrt(area));
  }
  const glm::vec3& w = point.weights;
  point.position = glm::vec3(a + as_double(w.y) * ab + as_double(w.z) * ac);
  if (glm::dot(point.facet, ray.direction) > 0.0f) point.facet = -point.facet;
  const glm::vec3 smooth =
      w.x * mesh.normals[corners.x] + w.y * mesh.normals[corners.y] + w.z * mesh.normals[corners.z];
  point.shading = glm::length(smooth) > 0.0f ? glm::normalize(smooth) : point.facet;
  if (glm::dot(point.shading, point.facet) < 0.0f) point.shading = -point.shading;
  return point;
}

// An array (n, 3) of what `value` makes of each hit; 0 where nothing is hit.
template <class Value>
auto rows_of(const Hits& hits, Value value) {
  std::vector<glm::vec3> rows(hits.t.size(), glm::vec3(0.0f));
  {
    const nb::gil_scoped_release released;
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (hits.triangle[i] != kNoTriangle)
        rows[i] = value(point_of(*hits.scene->mesh, hits.rays[i], hits.t[i], hits.triangle[i]));
  }
  const std::size_t n = rows.size();
  return array_that_owns<float>(std::move(rows), {n, 3});
}

auto distances_of(const Hits& hits) {
  std::vector<float> distances(hits.t);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (hits.triangle[i] != kNoTriangle) distances[i] *= glm::length(hits.rays[i].direction);
  const std::size_t n = distances.size();
  return array_that_owns<float>(std::move(distances), {n});
}

// What `value` makes of each hit triangle, as (n,) uint32; 0xffffffff where nothing is hit.
template <class Value>
auto indices_of(const Hits& hits, Value value) {
  std::vector<std::uint32_t> indices(hits.triangle.size(), kNoTriangle);
  for (std::size_t i = 0; i < indices.size(); ++i)
    if (hits.triangle[i] != kNoTriangle) indices[i] = value(*hits.scene, hits.triangle[i]);
  const std::size_t n = indices.size();
  return array_that_owns<std::uint32_t>(std::move(indices), {n});
}

class ArrayTracer {
 public:
  ArrayTracer(Scene scene, int threads, Progress* progress)
      : threads_(or_one_a_core(threads)),
        scene_(std::make_shared<const Scene>(std::move(scene))),
        tracer_(scene_->mesh, BuildOptions{.threads = threads_, .progress = progress}) {}

  [[nodiscard]] std::size_t triangles() const { return scene_->mesh->triangles.size(); }

  Hits closest_hits(const Floats3& origins, const Floats3& directions,
                    const std::optional<Floats>& t_max) const {
    const Rays rays = rays_of(origins, directions, t_max);
    Hits found{.scene = scene_,
               .rays = std::vector<Ray>(rays.count),
               .t = std::vector<float>(rays.count),
               .triangle = std::vector<std::uint32_t>(rays.count)};
    without_gil([&](Progress* progress) {
      for_chunks(rays.count, threads_, progress, [&](std::size_t first, std::size_t last) {
        static thread_local std::vector<Hit> hits(kChunk);
        for (std::size_t i = first; i < last; ++i) found.rays[i] = rays.ray(i);
        tracer_.closest_hits(std::span(found.rays).subspan(first, last - first),
                             std::span(hits).first(last - first));
        for (std::size_t i = first; i < last; ++i)
          found.t[i] = hits[i - first].t, found.triangle[i] = hits[i - first].triangle;
      });
      return true;
    });
    return found;
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
  std::shared_ptr<const Scene> scene_;
  Tracer tracer_;
};

nb::object t_of(nb::handle self) {
  Hits& hits = nb::cast<Hits&>(self);
  return nb::cast(view_of(hits.t.data(), {hits.t.size()}, self));
}
nb::object triangle_of(nb::handle self) {
  const Hits& hits = nb::cast<const Hits&>(self);
  return nb::cast(view_of(hits.triangle.data(), {hits.triangle.size()}, self));
}

void bind_hits(nb::module_& module) {
  nb::class_<Hits>(
      module, "Hits",
      "What rays hit, an array each. `t, triangle = hits` unpacks the first two. The others are computed "
      "when they are\n"
      "read.")
      .def_prop_ro("t", &t_of, nb::sig("def t(self) -> numpy.typing.NDArray[numpy.float32]"),
                   "(n,) float32, in lengths of the ray's direction; inf where nothing is hit.")
      .def_prop_ro("triangle", &triangle_of,
                   nb::sig("def triangle(self) -> numpy.typing.NDArray[numpy.uint32]"),
                   "(n,) uint32; 0xffffffff where nothing is hit. Read-only.")
      .def_prop_ro("distance", &distances_of, nb::rv_policy::reference,
                   "(n,) float32: from the ray's origin, scene units; inf where nothing is "
                   "hit.")
      .def_prop_ro(
          "node", [](const Hits& hits) { return indices_of(hits, &object_of); }, nb::rv_policy::reference,
          "(n,) uint32: the index in Scene.nodes, 0 if the scene has no nodes; 0xffffffff where nothing is "
          "hit.")
      .def_prop_ro(
          "material",
          [](const Hits& hits) {
            return indices_of(hits,
                              [](const Scene& s, std::uint32_t t) { return s.mesh->triangle_materials[t]; });
          },
          nb::rv_policy::reference,
          "(n,) uint32: the index in Scene.materials; 0xffffffff where nothing is hit.")
      .def_prop_ro(
          "position",
          [](const Hits& hits) { return rows_of(hits, [](const HitPoint& p) { return p.position; }); },
          nb::rv_policy::reference,
          "(n, 3) float32: the point that is hit, in world space; 0 where nothing is hit.")
      .def_prop_ro(
          "barycentrics",
          [](const Hits& hits) { return rows_of(hits, [](const HitPoint& p) { return p.weights; }); },
          nb::rv_policy::reference,
          "(n, 3) float32: the weights of the triangle's vertices at that point; 0 where nothing is hit.")
      .def_prop_ro(
          "normal",
          [](const Hits& hits) { return rows_of(hits, [](const HitPoint& p) { return p.shading; }); },
          nb::rv_policy::reference,
          "(n, 3) float32: the vertices' normals there, unit, towards the ray's origin, without normal maps; "
          "0 where "
          "nothing\n"
          "is hit.")
      .def_prop_ro(
          "triangle_normal",
          [](const Hits& hits) { return rows_of(hits, [](const HitPoint& p) { return p.facet; }); },
          nb::rv_policy::reference,
          "(n, 3) float32: the triangle's own normal, unit, towards the ray's origin; 0 where nothing is "
          "hit.")
      .def("__len__", [](const Hits&) { return 2; })
      .def(
          "__iter__",
          [](nb::handle self) { return nb::make_tuple(t_of(self), triangle_of(self)).attr("__iter__")(); },
          nb::sig("def __iter__(self) -> collections.abc.Iterator[numpy.typing.NDArray[typing.Any]]"))
      .def(
          "__getitem__",
          [](nb::handle self, int i) -> nb::object {
            if (i < -2 || i > 1) throw nb::index_error("closest hits are (t, triangle)");
            return (i + 2) % 2 == 0 ? t_of(self) : triangle_of(self);
          },
          nb::sig("def __getitem__(self, index: int, /) -> numpy.typing.NDArray[typing.Any]"))
      .def("__repr__", [](const Hits& hits) {
        const auto missed = as_size(std::ranges::count(hits.triangle, kNoTriangle));
        return "<Hits: " + std::to_string(hits.t.size() - missed) + " of " + std::to_string(hits.t.size()) +
               " rays>";
      });
}

}  // namespace

void bind_tracer(nb::module_& module) {
  bind_hits(module);
  nb::class_<ArrayTracer> bound(module, "Tracer", "The ray tracer without a renderer: rays in, hits out.");
  bound
      .def(
          "__init__",
          [](ArrayTracer* self, const PyScene& scene, int threads) {
            const int wanted = threads_wanted(threads);
            without_gil([&, copy = scene.scene](Progress* progress) {
              return new (self) ArrayTracer(copy, wanted, progress);
            });
          },
          "scene"_a, "threads"_a = 0,
          "Builds the tree of a scene. If nodes move (Scene.posed), create another one.\n"
          "threads: as for Engine.")
      .def(
          "__init__",
          [](ArrayTracer* self, const Floats3& vertices, const Words3& triangles, int threads) {
            const int wanted = threads_wanted(threads);
            const Scene scene = scene_of(vertices, triangles);
            without_gil([&](Progress* progress) { return new (self) ArrayTracer(scene, wanted, progress); });
          },
          "vertices"_a, "triangles"_a, "threads"_a = 0,
          "Builds the tree of a mesh.\n"
          "vertices: (n, 3) float32. triangles: (m, 3) uint32, indices of vertices.\n"
          "threads: as for Engine.\n"
          "Raises Error if an index is out of range or a vertex is not finite.")
      .def("__repr__",
           [](const ArrayTracer& t) { return "<Tracer: " + std::to_string(t.triangles()) + " triangles>"; })
      .def(
          "closest_hits", &ArrayTracer::closest_hits, "origins"_a, "directions"_a, "t_max"_a = nb::none(),
          "The closest hit of each ray, as Hits: `t, triangle = tracer.closest_hits(...)`, or hits.distance, "
          "hits.node and so on.\n"
          "origins: (n, 3), or (1, 3) for all rays. directions: (n, 3), of any length. t_max: (n,), one "
          "number, or "
          "None: infinity.\n"
          "Raises Error if the numbers of rays differ.")
      .def("occluded", &ArrayTracer::occluded, "origins"_a, "directions"_a, "t_max"_a = nb::none(),
           "Whether a triangle is hit within each ray, as (n,) bool. Arguments and errors as for "
           "closest_hits.");
  def_no_pickle(bound, "a Tracer does not pickle: create one in each process, of a scene, which does");
}

}  // namespace pinocchio::python
