// SPDX-License-Identifier: LGPL-3.0-or-later
// What is read of the folders of runs.
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/results/checks.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_fields.hpp"
#include "rubato/results/stored_run.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "mesh_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <filesystem>
#include <memory>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

using results::StoredFields;

py::dict columns_of(const results::Table& table) {
  py::dict result;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    py::array_t<double> values(static_cast<py::ssize_t>(table.rows.size()));
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      values.mutable_at(static_cast<py::ssize_t>(row)) = table.rows[row][column];
    result[py::str(table.columns[column])] = values;
  }
  return result;
}

/// (name, study as text, status, reason) of a run.
py::tuple stored_run(const std::filesystem::path& folder) {
  const auto run = results::read_stored_run(folder);
  return py::make_tuple(run.name, run.study, std::string(results::to_string(run.status)), run.reason);
}

/// The fields of a run, with the mesh that Python may keep.
struct Fields {
  std::shared_ptr<StoredFields> stored;
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& field : stored->fields)
      result.push_back(field.name);
    return result;
  }
};

std::optional<Fields> stored_fields(const std::filesystem::path& folder) {
  auto found = results::stored_fields(folder);
  if (!found)
    return std::nullopt;
  return Fields{std::make_shared<StoredFields>(std::move(*found))};
}

std::vector<std::string> components_of(const Fields& fields, const std::string& name) {
  for (const auto& field : fields.stored->fields)
    if (field.name == name)
      return field.components;
  throw InputError(fmt::format("the run has no field {}{}", shown(name), suggestion(name, fields.names())));
}

py::dict values_at(const Fields& fields, const py::object& index) {
  const auto& stored = *fields.stored;
  const auto instant = static_cast<std::size_t>(
      indices_of(py::make_tuple(index), static_cast<std::int64_t>(stored.instants.size()), "instants")
          .front());
  const auto values = [&] {
    const py::gil_scoped_release unlocked;
    return stored.values_at(instant);
  }();
  const auto nodes = static_cast<py::ssize_t>(stored.mesh.node_count());
  py::dict result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto components = static_cast<py::ssize_t>(stored.fields[i].components.size());
    result[py::str(stored.fields[i].name)] =
        components == 1 ? copied(values[i]) : copied(std::span<const double>(values[i]), {nodes, components});
  }
  return result;
}

void bind_fields_of_runs(py::module_& module) {
  py::class_<Fields>(module, "StoredFields", "The fields that a run stored, read instant by instant.")
      .def_property_readonly(
          "mesh", [](const Fields& fields) { return SharedMesh(fields.stored, &fields.stored->mesh); },
          "The mesh that they are on.")
      .def_property_readonly(
          "instants", [](const Fields& fields) { return copied(fields.stored->instants); },
          "Ascending [time].")
      .def_property_readonly("names", &Fields::names, "Of the fields.")
      .def("components", &components_of, py::arg("name"),
           "Names of a field's components; one empty of a scalar.")
      .def("at", &values_at, py::arg("index"),
           "Every field at the instant of that index: arrays, nodes or nodes x components, by their names.");
}

} // namespace

void bind_stored(py::module_& module) {
  bind_fields_of_runs(module);
  module.def("_stored_run", &stored_run);
  module.def("_stored_fields", &stored_fields);
  module.def("_contact_zones", &results::contact_zones);
  module.def("_parse_echo", [](const std::string& text, const std::string& file) {
    return Codec<study::Study>::to(deck::parse_echo(text, file));
  });
  module.def("_evaluate_checks", [](const py::object& study, const std::filesystem::path& folder) {
    const auto checks = Codec<study::Study>::from(study, "").checks;
    return results::evaluate_checks(checks, results::read_stored_run(folder).probes, folder);
  });
  module.def(
      "checks_text", [](const std::vector<results::CheckResult>& checks) { return results::to_text(checks); },
      py::arg("checks"), "The checks as the program prints them: a list of CheckResult.");
  module.def(
      "read_csv", [](const std::filesystem::path& path) { return columns_of(results::read_csv(path)); },
      py::arg("path"),
      "A table of numbers that a run wrote: arrays of its columns by their names. Raises InputError.");
  module.def("run_folders", &results::run_folders, py::arg("folder"),
             "The folder itself when it holds a run, else its subfolders that do, by name. Raises InputError "
             "when none "
             "does.");
}

} // namespace rubato::python
