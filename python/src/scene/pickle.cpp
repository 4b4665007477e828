#include "python/src/scene/pickle.h"

#include <pinocchio/animation.h>
#include <pinocchio/load.h>

#include <cstring>
#include <type_traits>

#include "pinocchio/conversion.h"

namespace pinocchio::python {
namespace {

// Changes whenever the order of what is written does.
constexpr std::string_view kFormat = "pinocchio_renderer " PINOCCHIO_VERSION " 3";

// Copied as they lie in memory.
template <class T>
concept Plain = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

// Writer and Reader take each value by operator(); `parts` lists those of a structure, once for both.
class Writer {
 public:
  void raw(const void* data, std::size_t bytes) { bytes_.append(static_cast<const char*>(data), bytes); }
  void size(std::size_t n) { raw(&n, sizeof n); }

  template <Plain T>
  void operator()(T& value) {
    raw(&value, sizeof value);
  }
  void operator()(std::string& text) {
    size(text.size());
    raw(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    size(values.size());
    if constexpr (Plain<T>)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (T& value : values) (*this)(value);
  }
  template <class T>
  void operator()(Image<T>& image) {
    glm::ivec2 size = image.size();
    (*this)(size);
    raw(image.pixels().data(), image.pixels().size_bytes());
  }
  void operator()(Textures& textures) {
    std::vector<Texture> all;
    for (const Texture& texture : textures) all.push_back({texture.name, texture.image()});
    (*this)(all);
  }
  template <class T>
  void operator()(std::shared_ptr<const T>& shared) {
    bool is_there = shared != nullptr;
    (*this)(is_there);
    if (is_there) (*this)(const_cast<T&>(*shared));
  }
  void operator()(Environment& environment) {
    (*this)(const_cast<Image<glm::vec3>&>(environment.radiance()));
    std::string source = environment.source();
    (*this)(source);
  }
  template <class T>
  requires(!Plain<T>) void operator()(T& structure) { parts(*this, structure); }

  [[nodiscard]] nb::bytes bytes() const { return nb::bytes(bytes_.data(), bytes_.size()); }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const nb::bytes& bytes) : at_(bytes.c_str()), left_(bytes.size()) {}

  void raw(void* data, std::size_t bytes) {
    if (bytes > left_) throw Error("the pickle is damaged: it ends too early");
    if (bytes > 0) std::memcpy(data, at_, bytes);
    at_ += bytes;
    left_ -= bytes;
  }
  std::size_t size(std::size_t bytes_each) {
    std::size_t n = 0;
    raw(&n, sizeof n);
    if (n > left_ / bytes_each) throw Error("the pickle is damaged: it ends too early");
    return n;
  }

  template <Plain T>
  void operator()(T& value) {
    raw(&value, sizeof value);
  }
  void operator()(std::string& text) {
    text.resize(size(1));
    raw(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    values.resize(size(Plain<T> ? sizeof(T) : 1));
    if constexpr (Plain<T>)
      raw(values.data(), values.size() * sizeof(T));
    else
      for (T& value : values) (*this)(value);
  }
  template <class T>
  void operator()(Image<T>& image) {
    glm::ivec2 size{};
    (*this)(size);
    if (size.x < 0 || size.y < 0 || as_size(size.x) * as_size(size.y) > left_ / sizeof(T))
      throw Error("the pickle is damaged: a picture's size is impossible");
    image = Image<T>(size);
    raw(image.pixels().data(), image.pixels().size_bytes());
  }
  void operator()(Textures& textures) {
    std::vector<Texture> all;
    (*this)(all);
    if (!all.empty()) textures.edit() = std::move(all);
  }
  template <class T>
  void operator()(std::shared_ptr<const T>& shared) {
    bool is_there = false;
    (*this)(is_there);
    shared = nullptr;
    if (!is_there) return;
    if constexpr (std::is_same_v<T, Environment>) {
      Image<glm::vec3> radiance;
      std::string source;
      (*this)(radiance);
      (*this)(source);
      if (radiance.empty()) throw Error("the pickle is damaged: the environment is empty");
      shared = std::make_shared<const Environment>(std::move(radiance), std::move(source));
    } else if constexpr (std::is_same_v<T, Mesh>) {
      MeshData data;
      (*this)(data);
      shared = std::make_shared<const Mesh>(std::move(data));
    } else {
      auto made = std::make_shared<T>();
      (*this)(*made);
      shared = std::move(made);
    }
  }
  template <class T>
  requires(!Plain<T>) void operator()(T& structure) { parts(*this, structure); }

 private:
  const char* at_;
  std::size_t left_;
};

template <class Archive, class... T>
void each(Archive& archive, T&... values) {
  (archive(values), ...);
}

// The structured bindings name every member: a structure with a new one does not compile here until it is
// written, too.
template <class A>
void parts(A& a, Camera& value) {
  auto& [name, eye, target, up, fov, lens, focus, aspect, shift, projection, height, distortion] = value;
  each(a, name, eye, target, up, fov, lens, focus, aspect, shift, projection, height, distortion);
}
template <class A>
void parts(A& a, Light& value) {
  auto& [name, kind, position, direction, color, intensity, falloff, range, inner, outer, casts, radius,
         angle, u, v] = value;
  each(a, name, kind, position, direction, color, intensity, falloff, range, inner, outer, casts, radius,
       angle, u, v);
}
template <class A>
void parts(A& a, Material& value) {
  auto& [name, ambient, diffuse, specular, shininess, alpha, grazing, layer, layers, reflectance, gloss,
         transmittance, ior, color, distance, fresnel, emission, brdf, sides, maps] = value;
  each(a, name, ambient, diffuse, specular, shininess, alpha, grazing, layer, layers, reflectance, gloss,
       transmittance, ior, color, distance, fresnel, emission, brdf, sides, maps);
}
template <class A>
void parts(A& a, Texture& value) {
  auto& [name, texels, blocks, least, most, least_green] = value;  // a mesh makes the last four of the texels
  each(a, name, texels);
}
template <class A>
void parts(A& a, MeshData& value) {
  auto& [positions, normals, texcoords, texcoords1, colors, tangents, triangles, of_triangles, materials,
         maps, textures] = value;
  each(a, positions, normals, texcoords, texcoords1, colors, tangents, triangles, of_triangles, materials,
       maps, textures);
}
template <class A>
void parts(A& a, Node& value) {
  auto& [name, parent, local, first_vertex, vertices, first_triangle, triangles] = value;
  each(a, name, parent, local, first_vertex, vertices, first_triangle, triangles);
}
template <class A, class T>
void parts(A& a, Attached<T>& value) {
  auto& [node, index, at_rest] = value;
  each(a, node, index, at_rest);
}
template <class A>
void parts(A& a, MorphTarget& value) {
  auto& [vertices, positions, normals, tangents] = value;
  each(a, vertices, positions, normals, tangents);
}
template <class A>
void parts(A& a, Skin& value) {
  auto& [joints, matrices] = value;
  each(a, joints, matrices);
}
template <class A>
void parts(A& a, Deformation& value) {
  auto& [node, targets, skin, influences, per_vertex] = value;
  each(a, node, targets, skin, influences, per_vertex);
}
template <class A>
void parts(A& a, MeshCopy& value) {
  auto& [node, mesh, first_vertex, vertices, first_triangle, triangles, node_from_mesh] = value;
  each(a, node, mesh, first_vertex, vertices, first_triangle, triangles, node_from_mesh);
}
template <class A>
void parts(A& a, RestPose& value) {
  auto& [positions, normals, tangents, lights, cameras, skins, deformations, copies, pool] =
      value;  // a new pool is made
  each(a, positions, normals, tangents, lights, cameras, skins, deformations, copies);
}
template <class A>
void parts(A& a, NodeTree& value) {
  auto& [nodes, weights, rest] = value;
  each(a, nodes, weights, rest);
}
template <class A>
void parts(A& a, Track& value) {
  auto& [path, interpolation, times, values, width, clip] = value;
  each(a, path, interpolation, times, values, width, clip);
}
template <class A>
void parts(A& a, AnimatedNode& value) {
  auto& [node, at_rest, tracks] = value;
  each(a, node, at_rest, tracks);
}
template <class A>
void parts(A& a, Animation::Clip& value) {
  auto& [name, duration] = value;
  each(a, name, duration);
}
template <class A>
void parts(A& a, Animation& value) {
  auto& [clips, nodes, duration] = value;
  each(a, clips, nodes, duration);
}
template <class A>
void parts(A& a, Scene& value) {
  auto& [mesh, lights, cameras, ambient, environment, rotation, strength, nodes, animation, variants, source,
         files] = value;
  each(a, mesh, lights, cameras, ambient, environment, rotation, strength, nodes, animation, variants, source,
       files);
}
template <class A>
void parts(A& a, TexturedMaterial& value) {
  auto& [material, texture] = value;
  each(a, material, texture);
}

template <class T>
nb::bytes written(const T& value) {
  Writer writer;
  std::string format(kFormat);
  each(writer, format, const_cast<T&>(value));  // a Writer changes nothing
  return writer.bytes();
}

template <class T>
void read(const nb::bytes& bytes, T& value) {
  Reader reader(bytes);
  std::string format;
  reader(format);
  if (format != kFormat)
    throw Error("the pickle is of '" + format + "'; this is '" + std::string(kFormat) + "'");
  reader(value);
}

}  // namespace

nb::bytes pickled(const Scene& scene) {
  return written(scene);
}
nb::bytes pickled(const Camera& camera) {
  return written(camera);
}
nb::bytes pickled(const Light& light) {
  return written(light);
}
nb::bytes pickled(const TexturedMaterial& material) {
  return written(material);
}

void unpickle(const nb::bytes& bytes, Scene& scene) {
  read(bytes, scene);
  (void)value_or_throw(check_scene(scene).map([] { return true; }));
}
void unpickle(const nb::bytes& bytes, Camera& camera) {
  read(bytes, camera);
}
void unpickle(const nb::bytes& bytes, Light& light) {
  read(bytes, light);
}
void unpickle(const nb::bytes& bytes, TexturedMaterial& material) {
  read(bytes, material);
}

}  // namespace pinocchio::python
