// Conversions between Python's types and ours: vectors, matrices, arrays, errors.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <pinocchio/error.h>
#include <pinocchio/image.h>

#include <glm/glm.hpp>
#include <stdexcept>

namespace nb = nanobind;
using namespace nb::literals;

namespace pinocchio::python {

// pinocchio_renderer.Error
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <class T>
T value_or_throw(Expected<T>&& expected) {
  if (!expected) throw Error(expected.error().message());
  if constexpr (!std::is_void_v<T>) return std::move(*expected);
}

// Anything that NumPy can convert to such an array. An array of the right type is not copied.
template <class T, class Shape>
struct Like {
  nb::ndarray<const T, Shape, nb::c_contig, nb::device::cpu> array;

  [[nodiscard]] const T* data() const { return array.data(); }
  [[nodiscard]] std::size_t shape(std::size_t i) const { return array.shape(i); }
};
using Floats3 = Like<float, nb::shape<-1, 3>>;
using Floats2 = Like<float, nb::shape<-1, 2>>;
using Floats = Like<float, nb::shape<-1>>;
using Words3 = Like<std::uint32_t, nb::shape<-1, 3>>;
using Words = Like<std::uint32_t, nb::shape<-1>>;
using Matrix = Like<double, nb::shape<4, 4>>;
using Texels = Like<std::uint8_t, nb::ndim<3>>;

template <class To, class Array>
std::vector<To> copied(const Array& array) {
  const auto* const first = reinterpret_cast<const To*>(array.data());
  return {first, first + array.shape(0)};
}

// NumPy has rows, GLM columns.
inline glm::mat4 matrix_of(const Matrix& m) {
  glm::mat4 result;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result[column][row] = static_cast<float>(m.data()[4 * row + column]);
  return result;
}

// An array for NumPy, without a copy. `owner` keeps the memory alive.
template <class T>
nb::ndarray<nb::numpy, T> view_of(T* data, std::initializer_list<std::size_t> shape, nb::handle owner) {
  return {data, shape, owner};
}

}  // namespace pinocchio::python

namespace nanobind::detail {

template <class T, class Shape>
struct type_caster<pinocchio::python::Like<T, Shape>> {
  using Wanted = pinocchio::python::Like<T, Shape>;
  NB_TYPE_CASTER(Wanted, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    constexpr const char* kType = std::is_same_v<T, float>           ? "float32"
                                  : std::is_same_v<T, double>        ? "float64"
                                  : std::is_same_v<T, std::uint32_t> ? "uint32"
                                                                     : "uint8";
    try {
      const object array = module_::import_("numpy").attr("ascontiguousarray")(source, kType);
      return try_cast(array, value.array, false);
    } catch (const std::exception&) {
      return false;
    }
  }
};

// A vector is converted from any sequence of that many numbers, and to a tuple.
template <int N>
struct vec_caster {
  using Vec = glm::vec<N, float, glm::defaultp>;
  NB_TYPE_CASTER(Vec, const_name("collections.abc.Sequence[float]"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    if (!PySequence_Check(source.ptr()) || PySequence_Size(source.ptr()) != N) return PyErr_Clear(), false;
    for (int i = 0; i < N; ++i) {
      PyObject* const item = PySequence_GetItem(source.ptr(), i);
      const double number = item ? PyFloat_AsDouble(item) : -1.0;
      Py_XDECREF(item);
      if (PyErr_Occurred()) return PyErr_Clear(), false;
      value[i] = static_cast<float>(number);
    }
    return true;
  }
  static handle from_cpp(const Vec& v, rv_policy, cleanup_list*) noexcept {
    PyObject* const tuple = PyTuple_New(N);
    for (int i = 0; i < N; ++i) PyTuple_SET_ITEM(tuple, i, PyFloat_FromDouble(static_cast<double>(v[i])));
    return tuple;
  }
};
template <>
struct type_caster<glm::vec3> : vec_caster<3> {};
template <>
struct type_caster<glm::vec2> : vec_caster<2> {};

// A size, (width, height).
template <>
struct type_caster<glm::ivec2> {
  NB_TYPE_CASTER(glm::ivec2, const_name("tuple[int, int]"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    if (!PySequence_Check(source.ptr()) || PySequence_Size(source.ptr()) != 2) return PyErr_Clear(), false;
    for (int i = 0; i < 2; ++i) {
      PyObject* const item = PySequence_GetItem(source.ptr(), i);
      const long number = item ? PyLong_AsLong(item) : -1;
      Py_XDECREF(item);
      if (PyErr_Occurred()) return PyErr_Clear(), false;
      value[i] = static_cast<int>(number);
    }
    return true;
  }
  static handle from_cpp(const glm::ivec2& v, rv_policy, cleanup_list*) noexcept {
    return Py_BuildValue("(ii)", v.x, v.y);
  }
};

}  // namespace nanobind::detail
