#include "python/src/support/arguments.h"

#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <limits>

#include "pinocchio/conversion.h"

namespace pinocchio::python {
namespace {

std::string text_of(nb::handle value) {
  return nb::str(value).c_str();
}

// "(n, 3)", "(4, 4)"
std::string named_shape(const std::vector<int>& shape) {
  static constexpr const char* kLetters[] = {"n", "m", "k"};
  std::string text = "(";
  std::size_t letter = 0;
  for (const int n : shape)
    text += (text.size() > 1 ? ", " : "") + (n < 0 ? kLetters[letter++] : std::to_string(n));
  return text + (shape.size() == 1 ? ",)" : ")");
}

bool fits(nb::handle array, const std::vector<int>& shape) {
  const nb::tuple has = nb::cast<nb::tuple>(array.attr("shape"));
  if (has.size() != shape.size()) return false;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (shape[i] >= 0 && nb::cast<long long>(has[i]) != shape[i]) return false;
  return true;
}

// Whole numbers of the type's range; the error names one that is not.
void check_whole(nb::handle array, const std::string& name, const std::string& type) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const nb::object range = numpy.attr("iinfo")(type), floor = numpy.attr("floor")(array);
  const nb::object good = (array.attr("__eq__")(floor)) & (array.attr("__ge__")(range.attr("min"))) &
                          (array.attr("__le__")(range.attr("max")));
  if (nb::cast<bool>(nb::bool_(good.attr("all")()))) return;
  const nb::object wrong = array[numpy.attr("logical_not")(good)];
  throw Error(name + " holds " + text_of(wrong[0]) + "; it is an array of whole numbers from " +
              text_of(range.attr("min")) + " to " + text_of(range.attr("max")));
}

}  // namespace

nb::object array_of(nb::handle source, const std::string& name, const char* type,
                    const std::vector<int>& shape) {
  const nb::module_ numpy = nb::module_::import_("numpy");
  const std::string wanted = "it is an array " + named_shape(shape) + " of numbers";
  nb::object array;
  try {
    array = numpy.attr("asarray")(source);
  } catch (nb::python_error& error) {
    if (!error.matches(PyExc_ValueError) && !error.matches(PyExc_TypeError)) throw;
    throw Error(name + " cannot be converted to an array (" + text_of(error.value()) + "); " + wanted);
  }
  const std::string kind = text_of(array.attr("dtype").attr("kind"));
  const bool empty = nb::cast<long long>(array.attr("size")) == 0;
  if (kind != "f" && kind != "i" && kind != "u" && !empty)
    throw Error(name + " is of the type " + text_of(array.attr("dtype")) + "; " + wanted);
  if (!fits(array, shape)) {
    if (nb::cast<nb::tuple>(array.attr("shape")).size() == 0) throw Error(name + " is one number; " + wanted);
    throw Error(name + " has the shape " + text_of(array.attr("shape")) + "; " + wanted);
  }
  const bool whole = type[0] == 'u';
  if (whole && !empty && text_of(array.attr("dtype")) != type) check_whole(array, name, type);
  return numpy.attr("ascontiguousarray")(array, type);
}

std::vector<float> numbers_of(nb::handle source, const std::string& name, int count) {
  const nb::object array = array_of(source, name, "float32", {count});
  const auto numbers =
      nb::cast<nb::ndarray<const float, nb::ndim<1>, nb::c_contig, nb::device::cpu>>(array, false);
  for (int i = 0; i < count; ++i)
    if (!std::isfinite(numbers.data()[i]))
      throw Error(name + " holds " + text_of(array[i]) + "; it needs finite numbers");
  return {numbers.data(), numbers.data() + count};
}

float number_within(double value, const char* name, double lo, double hi) {
  if (std::isfinite(value) && value >= lo && value <= hi) return as_float(value);
  const auto text = [](double number) { return text_of(nb::float_(number)); };
  const bool has_end = std::isfinite(hi) && hi < std::numeric_limits<float>::max();
  throw Error(std::string(name) + " is " + text(value) + "; it is a finite number" +
              (lo > std::numeric_limits<float>::lowest() ? ", " + text(lo) + " or more" : "") +
              (has_end ? " and at most " + text(hi) : ""));
}

glm::mat4 Matrix::read(const std::string& name) const {
  const nb::object array = array_of(source, name, "float64", {4, 4});
  const auto m =
      nb::cast<nb::ndarray<const double, nb::ndim<2>, nb::c_contig, nb::device::cpu>>(array, false);
  glm::mat4 result;
  for (int i = 0; i < 16; ++i) {
    const auto number = as_float(m.data()[i]);
    if (!std::isfinite(number))
      throw Error(name + " holds " + text_of(array[nb::make_tuple(i / 4, i % 4)]) +
                  "; it needs finite numbers");
    result[i % 4][i / 4] = number;
  }
  constexpr float kRounding = 1e-5f;
  const glm::vec4 last(0, 0, 0, 1);
  if (glm::any(glm::greaterThan(glm::abs(glm::row(result, 3) - last), glm::vec4(kRounding))))
    throw Error(name + " has the last row " + text_of(array[3]) +
                "; it is (0, 0, 0, 1) of a matrix that places something (is it transposed?)");
  return glm::row(result, 3, last);
}

glm::vec3 Three::read_color(const char* name) const {
  const glm::vec3 color = read(name);
  if (glm::any(glm::lessThan(color, glm::vec3(0.0f))))
    throw Error(std::string(name) + " is " + text_of(source) + "; it needs numbers from 0 on");
  return color;
}

nb::dict Dict::read(const std::string& name) const {
  const nb::module_ abc = nb::module_::import_("collections.abc");
  if (!nb::isinstance(source, abc.attr("Mapping")))
    throw Error(name + " is a " + text_of(source.type().attr("__name__")) + "; it is a dict");
  return nb::borrow<nb::dict>(nb::module_::import_("builtins").attr("dict")(source));
}

glm::ivec2 Size::read() const {
  const nb::object array = array_of(source, "size", "uint32", {2});
  const auto n =
      nb::cast<nb::ndarray<const std::uint32_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>>(array, false);
  if (n.data()[0] < 1 || n.data()[1] < 1 || n.data()[0] > 65536 || n.data()[1] > 65536)
    throw Error("size is " + std::to_string(n.data()[0]) + "x" + std::to_string(n.data()[1]) +
                "; it must be (width, height) in pixels");
  return {as_int(n.data()[0]), as_int(n.data()[1])};
}

}  // namespace pinocchio::python
