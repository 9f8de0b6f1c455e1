// SPDX-License-Identifier: LGPL-3.0-or-later
#include "given_field.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "values.hpp"
#include <cmath>
#include <memory>
#include <utility>

namespace rubato::python {

CalledField::CalledField(std::string name, py::object function, bool varies_in_time)
    : name_(std::move(name)), function_(std::move(function)), varies_in_time_(varies_in_time) {}

CalledField::~CalledField() {
  if (Py_IsInitialized() == 0) {
    (void)function_.release();
    return;
  }
  const py::gil_scoped_acquire lock;
  function_ = py::object();
}

double CalledField::at(std::span<const double, 3> place, double t) const {
  const py::gil_scoped_acquire lock;
  const auto refused = [&](const std::string& what) {
    return InputError(fmt::format("the field {} {} at {}", shown(name_), what, shown_place(place, t)));
  };
  double value = 0;
  try {
    value = function_(place[0], place[1], place[2], t).cast<double>();
  } catch (py::error_already_set& error) {
    if (error.matches(PyExc_KeyboardInterrupt) || error.matches(PyExc_SystemExit))
      throw;
    const auto type = py::str(error.type().attr("__name__")).cast<std::string>();
    throw refused(fmt::format("raised {} ({})", type, py::str(error.value()).cast<std::string>()));
  } catch (const py::cast_error&) {
    throw refused("is no number");
  }
  if (!std::isfinite(value))
    throw refused(std::isnan(value) ? "is not a number" : "is infinite");
  return value;
}

namespace {

const CalledField& called(const study::GivenField& field) {
  return dynamic_cast<const CalledField&>(*field.values);
}

study::GivenField made(const std::string& name, const py::object& function, bool varies_in_time) {
  if (PyCallable_Check(function.ptr()) == 0)
    refuse("function", function, "a function of x, y, z and t");
  return {name, std::make_shared<const CalledField>(name, function, varies_in_time)};
}

} // namespace

study::GivenField Codec<study::GivenField>::from(py::handle value, const Path& path) {
  return tidy(value, path).cast<study::GivenField>();
}
py::object Codec<study::GivenField>::to(const study::GivenField& value) {
  return py::cast(value);
}
py::object Codec<study::GivenField>::tidy(py::handle value, const Path& path) {
  if (!py::isinstance<study::GivenField>(value))
    refuse(path, value, "GivenField");
  return py::reinterpret_borrow<py::object>(value);
}

void bind_given_field(py::module_& module) {
  const auto whole = [](const study::GivenField& field, const py::args&) { return field; };
  py::class_<study::GivenField>(module, "GivenField", R"(A field that a function of Python gives.

It stands wherever a study takes a field: supports, loads, gaps, temperatures, frictions, materials. The function
is called as function(x, y, z, t) with the undeformed place [length] and the instant [time] and returns a finite
number. What it raises ends the run with InputError, which names the field. It is called for one place at a time:
expressions are faster. No deck can have it; an echo has the name only.)")
      .def(py::init(&made), py::arg("name"), py::arg("function"), py::arg("varies_in_time") = false,
           "varies_in_time: whether it depends on t; materials and friction take only fields that do not.")
      .def_property_readonly(
          "name", [](const study::GivenField& field) { return field.name; }, "By which messages call it.")
      .def_property_readonly(
          "function", [](const study::GivenField& field) { return called(field).function(); },
          "The function of x, y, z and t.")
      .def_property_readonly(
          "varies_in_time", [](const study::GivenField& field) { return called(field).varies_in_time(); },
          "Whether it depends on t.")
      .def("__eq__", [](const study::GivenField& a, const study::GivenField& b) { return a == b; })
      .def("__eq__", [](const study::GivenField&, const py::object&) { return false; })
      .def("__hash__", [](const study::GivenField& field) { return std::hash<std::string>{}(field.name); })
      .def("__repr__",
           [](const study::GivenField& field) { return fmt::format("GivenField(name='{}')", field.name); })
      .def("__copy__", whole)
      .def("__deepcopy__", whole)
      .def(py::pickle(
          [](const study::GivenField& field) {
            return py::make_tuple(field.name, called(field).function(), called(field).varies_in_time());
          },
          [](const py::tuple& members) {
            return made(members[0].cast<std::string>(), members[1], members[2].cast<bool>());
          }));
}

} // namespace rubato::python
