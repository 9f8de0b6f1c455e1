// SPDX-License-Identifier: LGPL-3.0-or-later
#include "values.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <pybind11/numpy.h>

namespace rubato::python {

Path step_into(const Path& path, std::string_view name) {
  return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

void refuse(const Path& path, py::handle found, std::string_view expected) {
  const auto text = py::repr(found).cast<std::string>();
  const auto type = py::str(py::type::handle_of(found).attr("__name__")).cast<std::string>();
  throw py::type_error(fmt::format("{}{}found {} ({}), expected {}", path, path.empty() ? "" : ": ",
                                   text.size() > 60 ? "a value" : text, type, expected));
}

py::object class_named(std::string_view name) {
  return py::module_::import("rubato._records").attr(py::str(name.data(), name.size()));
}

namespace {

bool is_truth(py::handle value) {
  return PyBool_Check(value.ptr()) != 0 ||
         py::str(py::type::handle_of(value).attr("__name__")).cast<std::string>().starts_with("bool");
}

bool is_text(py::handle value) {
  return PyUnicode_Check(value.ptr()) != 0 || PyBytes_Check(value.ptr()) != 0;
}

} // namespace

double Codec<double>::from(py::handle value, const Path& path) {
  if (is_truth(value) || is_text(value))
    refuse(path, value, "a number");
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    refuse(path, value, "a number");
  }
  return number;
}

int Codec<int>::from(py::handle value, const Path& path) {
  if (is_truth(value) || PyIndex_Check(value.ptr()) == 0)
    refuse(path, value, "a whole number");
  const auto number = PyNumber_AsSsize_t(value.ptr(), nullptr);
  if (number < std::numeric_limits<int>::min() || number > std::numeric_limits<int>::max())
    refuse(path, value, "a whole number of at most 32 bits");
  return static_cast<int>(number);
}

bool Codec<bool>::from(py::handle value, const Path& path) {
  if (!is_truth(value))
    refuse(path, value, "True or False");
  return PyObject_IsTrue(value.ptr()) == 1;
}

std::string Codec<std::string>::from(py::handle value, const Path& path) {
  if (PyUnicode_Check(value.ptr()) != 0)
    return py::str(value).cast<std::string>();
  if (py::hasattr(value, "__fspath__"))
    return py::str(value.attr("__fspath__")()).cast<std::string>();
  refuse(path, value, "a text");
}

std::size_t place_of_word(const WordList& list, py::handle value, const Path& path) {
  const auto word = Codec<std::string>::from(value, path);
  const auto found = std::ranges::find(list.words, word);
  if (found == list.words.end())
    throw InputError({fault_at(path, fmt::format("{}{}found {}{}", path, path.empty() ? "" : ": ",
                                                 shown(word), suggestion(word, list.words)))});
  return static_cast<std::size_t>(found - list.words.begin());
}

py::object shown_word(const WordList& list, std::size_t place) {
  return class_named(list.class_name)(list.words.at(place));
}

py::tuple items_of(py::handle value, const Path& path) {
  if (is_text(value) || PyDict_Check(value.ptr()) != 0 || PySequence_Check(value.ptr()) == 0)
    refuse(path, value, "a list");
  auto* items = PySequence_Tuple(value.ptr());
  if (items == nullptr)
    throw py::error_already_set();
  return py::reinterpret_steal<py::tuple>(items);
}

py::tuple items_of_array(py::handle value, std::size_t size, const Path& path) {
  constexpr std::size_t axes = 3;
  auto items = items_of(value, path);
  if (items.size() != size && !(size == axes && items.size() == axes - 1))
    refuse(path, value, size == axes ? "3 items, or 2 in the plane" : fmt::format("{} items", size));
  return items;
}

py::dict entries_of(py::handle value, const Path& path) {
  if (PyDict_Check(value.ptr()) == 0)
    refuse(path, value, "a dictionary");
  return py::reinterpret_borrow<py::dict>(value);
}

} // namespace rubato::python
