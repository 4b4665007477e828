// Arguments that are arrays or vectors. They are converted when they are read, so that an error names the
// argument and says which shape it needs.
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

#include "pinocchio/conversion.h"

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

// The object as a C-contiguous NumPy array of `type` and `shape`, where -1 is any length. An array that is
// one already is not copied. Text, numbers out of range and fractions where whole numbers are needed are
// errors.
[[nodiscard]] nb::object array_of(nb::handle source, const std::string& name, const char* type,
                                  const std::vector<int>& shape);
// The same for `count` finite numbers in a row.
[[nodiscard]] std::vector<float> numbers_of(nb::handle source, const std::string& name, int count);

// The number, or an Error that names it if it is not finite or not from lo to hi.
[[nodiscard]] float number_within(double value, const char* name, double lo, double hi);

template <class T>
constexpr const char* kTypeName = nullptr;
template <>
inline constexpr const char* kTypeName<float> = "float32";
template <>
inline constexpr const char* kTypeName<double> = "float64";
template <>
inline constexpr const char* kTypeName<std::uint32_t> = "uint32";
template <>
inline constexpr const char* kTypeName<std::uint8_t> = "uint8";

// An array argument. N: its shape, where -1 is any length.
template <class T, int... N>
struct Like {
  nb::object source;

  using Array = nb::ndarray<const T, nb::ndim<sizeof...(N)>, nb::c_contig, nb::device::cpu>;
  [[nodiscard]] Array read(const char* name) const {
    return nb::cast<Array>(array_of(source, name, kTypeName<T>, {N...}), false);
  }
};
using Floats3 = Like<float, -1, 3>;
using Floats2 = Like<float, -1, 2>;
using Floats = Like<float, -1>;
using Words3 = Like<std::uint32_t, -1, 3>;
using Words = Like<std::uint32_t, -1>;
using Texels = Like<std::uint8_t, -1, -1, -1>;
using Pixels = Like<float, -1, -1, 3>;

// A 4x4 matrix of finite numbers, whose last row is (0, 0, 0, 1). NumPy has rows, GLM columns.
struct Matrix {
  nb::object source;
  [[nodiscard]] glm::mat4 read(const std::string& name) const;
};

// Three finite numbers.
struct Three {
  nb::object source;
  [[nodiscard]] glm::vec3 read(const char* name) const {
    const std::vector<float> v = numbers_of(source, name, 3);
    return {v[0], v[1], v[2]};
  }
  // Light, or a share of it: none of the numbers is negative.
  [[nodiscard]] glm::vec3 read_color(const char* name) const;
};

// A dict, or another mapping.
struct Dict {
  nb::object source;
  [[nodiscard]] nb::dict read(const std::string& name) const;
};

// A picture's size in pixels, (width, height).
struct Size {
  nb::object source;
  [[nodiscard]] glm::ivec2 read() const;
};

template <class To, class Array>
std::vector<To> copied(const Array& array) {
  const auto* const first = reinterpret_cast<const To*>(array.data());
  return {first, first + array.shape(0)};
}

// A property of three numbers, read by `read`: `get(object)` is a reference to them.
template <class Class, class Get>
void def_three(Class& bound, const char* name, Get get, const char* doc = "",
               glm::vec3 (Three::*read)(const char*) const = &Three::read) {
  using T = typename Class::Type;
  bound.def_prop_rw(
      name, [get](const T& object) -> glm::vec3 { return get(const_cast<T&>(object)); },
      [get, name, read](T& object, const Three& value) { get(object) = (value.*read)(name); }, doc);
}

// A property that is a number from lo to hi. `member`: pointer to it.
template <class Class, class Member>
void def_number(Class& bound, const char* name, Member member, double lo, double hi, const char* doc = "") {
  using T = typename Class::Type;
  bound.def_prop_rw(
      name, [member](const T& object) { return object.*member; },
      [member, name, lo, hi](T& object, double value) {
        object.*member = number_within(value, name, lo, hi);
      },
      doc);
}

}  // namespace pinocchio::python

namespace nanobind::detail {

// Any object, which is converted when it is read.
#define PINOCCHIO_UNREAD(TYPE, NAME)                                                \
  NB_TYPE_CASTER(TYPE, const_name(NAME))                                            \
  bool from_python(handle source, uint32_t, cleanup_list*) noexcept {               \
    value.source = borrow(source);                                                  \
    return true;                                                                    \
  }                                                                                 \
  static handle from_cpp(const TYPE& argument, rv_policy, cleanup_list*) noexcept { \
    return argument.source.inc_ref();                                               \
  }

template <class T, int... N>
struct type_caster<pinocchio::python::Like<T, N...>> {
  using Argument = pinocchio::python::Like<T, N...>;
  PINOCCHIO_UNREAD(Argument, "numpy.typing.ArrayLike")
};
template <>
struct type_caster<pinocchio::python::Matrix> {
  PINOCCHIO_UNREAD(pinocchio::python::Matrix, "numpy.typing.ArrayLike")
};
template <>
struct type_caster<pinocchio::python::Three> {
  PINOCCHIO_UNREAD(pinocchio::python::Three, "numpy.typing.ArrayLike")
};
template <>
struct type_caster<pinocchio::python::Size> {
  PINOCCHIO_UNREAD(pinocchio::python::Size, "collections.abc.Sequence[int]")
};
template <>
struct type_caster<pinocchio::python::Dict> {
  PINOCCHIO_UNREAD(pinocchio::python::Dict, "collections.abc.Mapping[typing.Any, typing.Any]")
};
#undef PINOCCHIO_UNREAD

// A vector that is returned, or a default value, becomes a tuple.
template <>
struct type_caster<glm::vec3> {
  NB_TYPE_CASTER(glm::vec3, const_name("tuple[float, float, float]"))

  bool from_python(handle, uint32_t, cleanup_list*) noexcept { return false; }
  static handle from_cpp(const glm::vec3& v, rv_policy, cleanup_list*) noexcept {
    return Py_BuildValue("(ddd)", static_cast<double>(v.x), static_cast<double>(v.y),
                         static_cast<double>(v.z));
  }
};
template <>
struct type_caster<glm::ivec2> {
  NB_TYPE_CASTER(glm::ivec2, const_name("tuple[int, int]"))

  bool from_python(handle, uint32_t, cleanup_list*) noexcept { return false; }
  static handle from_cpp(const glm::ivec2& v, rv_policy, cleanup_list*) noexcept {
    return Py_BuildValue("(ii)", v.x, v.y);
  }
};

}  // namespace nanobind::detail
