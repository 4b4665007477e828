// Arrays and text for Python.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "python/src/support/arguments.h"

namespace pinocchio::python {

// An array for NumPy, without a copy. `owner` keeps the memory alive.
template <class T>
nb::ndarray<nb::numpy, T> view_of(T* data, std::initializer_list<std::size_t> shape, nb::handle owner) {
  return {data, shape, owner};
}

// The vector as an array that owns it.
template <class T, class From>
nb::ndarray<nb::numpy, T> array_that_owns(std::vector<From>&& values,
                                          std::initializer_list<std::size_t> shape) {
  auto* const kept = new std::vector<From>(std::move(values));
  const nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<From>*>(p); });
  return {reinterpret_cast<T*>(kept->data()), shape, owner};
}

// A file's text. What is no UTF-8 in it becomes U+FFFD, as the encoding of OBJ, MTL and paths is not known.
inline nb::str text(std::string_view from) {
  PyObject* const decoded =
      PyUnicode_DecodeUTF8(from.data(), static_cast<Py_ssize_t>(from.size()), "replace");
  if (!decoded) throw nb::python_error();
  return nb::steal<nb::str>(decoded);
}

// As Python writes it: 'a text', 0.5, (1.0, 2.0, 3.0).
template <class T>
std::string shown(const T& value) {
  if constexpr (std::is_same_v<T, std::string>)
    return nb::repr(text(value)).c_str();
  else
    return nb::repr(nb::cast(value)).c_str();
}

// A method that says why objects of the class do not pickle, and what to do instead.
template <class Class>
void def_no_pickle(Class& bound, const char* why) {
  bound.def(
      "__reduce__", [why](nb::handle) -> nb::object { throw nb::type_error(why); },
      nb::sig("def __reduce__(self) -> typing.NoReturn"));
}

}  // namespace pinocchio::python
