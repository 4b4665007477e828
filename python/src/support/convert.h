// Arrays and text for Python.
#pragma once

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

// As Python writes it: 'a text', 0.5, (1.0, 2.0, 3.0).
template <class T>
std::string shown(const T& value) {
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
