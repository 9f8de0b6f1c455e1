// SPDX-License-Identifier: LGPL-3.0-or-later
// Exceptions of the library as Python's.
#include "rubato/core/error.hpp"
#include "rubato/core/writing.hpp"

#include "bind.hpp"
#include <exception>
#include <filesystem>
#include <new>

namespace rubato::python {

namespace py = pybind11;

namespace {

void raise(const py::object& type, const py::tuple& arguments) {
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

void raise_input_error(const InputError& error) {
  const auto errors = py::module_::import("rubato._errors");
  py::list faults;
  for (const auto& fault : error.faults())
    faults.append(
        errors.attr("Fault")(fault.text, fault.at.file, fault.at.line, fault.at.column, fault.path));
  raise(errors.attr("InputError"), py::make_tuple(error.what(), py::tuple(faults)));
}

py::object builtin(const char* name) {
  return py::module_::import("builtins").attr(name);
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown)
      std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise_input_error(error);
  } catch (const WriteError& error) {
    raise(builtin("OSError"),
          error.reason == 0 ? py::make_tuple(error.what()) : py::make_tuple(error.reason, error.what()));
  } catch (const std::filesystem::filesystem_error& error) {
    raise(builtin("OSError"), py::make_tuple(error.code().value(), error.what()));
  }
}

} // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator(&translate);
}

} // namespace rubato::python
