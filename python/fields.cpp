// SPDX-License-Identifier: LGPL-3.0-or-later
// Fields of states, contact points and resultants, and MED files of fields.
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/resultants.hpp"
#include "rubato/study/stored_fields.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "model_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <algorithm>
#include <filesystem>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

using model::Model;
using results::CellField;
using results::OwnedField;
using step::State;

/// Throws InputError for a name of no field with values at such places.
void check_name(const std::string& name, int dimension, bool at_nodes) {
  std::vector<std::string> known;
  for (const auto& field : study::stored_fields(dimension))
    if ((field.place == study::FieldPlace::nodes) == at_nodes)
      known.push_back(field.name);
  if (std::ranges::find(known, name) == known.end())
    throw InputError(fmt::format("no field {} is called {}{}", at_nodes ? "at the nodes" : "in the cells",
                                 shown(name), suggestion(name, known)));
}

void check_found(const std::vector<OwnedField>& fields, const std::string& name) {
  if (std::ranges::find(fields, name, &OwnedField::name) == fields.end())
    throw InputError(fmt::format("the model has no field {}: it has no {}", shown(name),
                                 name == "temperature" ? "temperatures" : "contact"));
}

study::FieldOutput only(std::vector<std::string> names) {
  study::FieldOutput output;
  output.only = std::move(names);
  return output;
}

py::dict nodal_fields(const Model& model, const State& state,
                      const std::optional<std::vector<std::string>>& names) {
  check_fits(model, state);
  py::dict result;
  if (names && names->empty())
    return result;
  for (const auto& name : names.value_or(std::vector<std::string>()))
    check_name(name, model.mesh.dimension, true);
  const auto fields = [&] {
    const py::gil_scoped_release unlocked;
    return results::nodal_fields(model, state, only(names.value_or(std::vector<std::string>())));
  }();
  for (const auto& name : names.value_or(std::vector<std::string>()))
    check_found(fields, name);
  const auto nodes = static_cast<py::ssize_t>(model.mesh.node_count());
  for (const auto& field : fields)
    result[py::str(field.name)] = field.components == 1 ? copied(field.values)
                                                        : copied(std::span<const double>(field.values),
                                                                 {nodes, py::ssize_t{field.components}});
  return result;
}

CellField cell_field(const Model& model, const State& state, const std::string& name) {
  check_fits(model, state);
  check_name(name, model.mesh.dimension, false);
  auto fields = results::cell_fields(model, state, only({name}));
  if (fields.empty())
    throw InputError(fmt::format("the model has no field {}: it has no temperatures", shown(name)));
  return std::move(fields.front());
}

std::vector<std::string> components_of(const Model& model, const std::string& name) {
  const auto fields = study::stored_fields(model.mesh.dimension);
  const auto found = std::ranges::find(fields, name, &study::StoredField::name);
  if (found == fields.end())
    throw InputError(
        fmt::format("no field is called {}{}", shown(name), suggestion(name, study::stored_field_names())));
  return found->components;
}

py::dict contact_points(const Model& model, const py::object& which) {
  const auto& zone = model.zones[zone_of(model, which)];
  const auto count = static_cast<py::ssize_t>(zone.points.size());
  py::array_t<std::int32_t> nodes(count);
  py::array_t<double> places({count, py::ssize_t{3}});
  py::array_t<double> areas(count);
  py::array_t<bool> excluded(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    const auto& point = zone.points[static_cast<std::size_t>(i)];
    nodes.mutable_at(i) =
        point.node_position < 0 ? -1 : zone.slave.nodes[static_cast<std::size_t>(point.node_position)];
    for (int k = 0; k < 3; ++k)
      places.mutable_at(i, k) = point.place[k];
    areas.mutable_at(i) = point.area;
    excluded.mutable_at(i) = point.excluded;
  }
  py::dict result;
  result["node"] = nodes;
  result["place"] = places;
  result["area"] = areas;
  result["excluded"] = excluded;
  return result;
}

py::dict resultants(const Model& model, const State& state, const py::object& which) {
  check_fits(model, state);
  const auto sum = results::contact_resultants(state.zones[zone_of(model, which)]);
  py::dict result;
  result["in_contact"] = sum.in_contact;
  result["sticking"] = sum.sticking;
  result["force"] = py::cast(sum.force);
  result["normal"] = sum.normal;
  result["friction"] = sum.friction;
  result["largest_pressure"] = sum.largest_pressure;
  result["smallest_gap"] = sum.smallest_gap;
  return result;
}

// ---- fields in cells

py::array part_of(const CellField& field, std::size_t i, py::handle owner) {
  const auto& part = field.parts[i];
  const auto places = py::ssize_t{part.places};
  const auto size = static_cast<py::ssize_t>(part.values.size());
  return view(part.values.data(), {size / (places * field.components), places, field.components}, owner);
}

py::dict values_of(const py::object& self) {
  const auto& field = self.cast<const CellField&>();
  py::dict result;
  for (std::size_t i = 0; i < field.parts.size(); ++i)
    result[Codec<CellType>::to(field.parts[i].type)] = part_of(field, i, self);
  return result;
}

/// Of the volumes, which have no components.
py::dict volumes_of(const py::object& self) {
  const auto& field = self.cast<const CellField&>();
  py::dict result;
  std::size_t first = 0;
  for (const auto& part : field.parts) {
    const auto points = part.values.size() / static_cast<std::size_t>(field.components);
    if (field.volumes.empty())
      break;
    result[Codec<CellType>::to(part.type)] = view(
        field.volumes.data() + first, {static_cast<py::ssize_t>(points) / part.places, part.places}, self);
    first += points;
  }
  return result;
}

void bind_cell_field(py::module_& module) {
  py::class_<CellField>(module, "CellField", "A field with values of its own in every cell of the bodies.")
      .def_readonly("name", &CellField::name, "Of the field.")
      .def_readonly("components", &CellField::component_names, "Names of the components.")
      .def_property_readonly(
          "place",
          [](const CellField& field) {
            switch (field.place) {
            case study::FieldPlace::gauss_points:
              return "gauss_points";
            case study::FieldPlace::cells:
              return "cells";
            default:
              return "element_nodes";
            }
          },
          "\"gauss_points\", \"element_nodes\" or \"cells\".")
      .def_property_readonly("values", &values_of,
                             "By cell type: cells x places x components, in the order of the mesh; views.")
      .def_property_readonly("volumes", &volumes_of,
                             "Of Gauss points, by cell type: cells x places [volume]; empty at nodes; views.")
      .def(
          "means",
          [](const CellField& field) {
            const auto means = results::cell_means(field);
            return copied(
                std::span<const double>(means),
                {static_cast<py::ssize_t>(means.size()) / field.components, py::ssize_t{field.components}});
          },
          "Of each cell over its volume, at nodes over these: cells x components.");
}

// ---- MED files

struct MedInput {
  std::vector<Numbers> kept;
  std::vector<results::NodalField> fields;
};

MedInput nodal_input(const py::dict& nodal,
                     const std::map<std::string, std::vector<std::string>>& components) {
  MedInput input;
  for (const auto& [name, values] : nodal) {
    const auto array = Numbers::ensure(values);
    if (!array || array.ndim() < 1 || array.ndim() > 2)
      throw std::invalid_argument(fmt::format("{}: expected numbers, one a node or nodes x components",
                                              py::str(name).cast<std::string>()));
    input.kept.push_back(array);
    const auto text = py::str(name).cast<std::string>();
    const auto named = components.find(text);
    input.fields.push_back(
        {.name = text,
         .components = array.ndim() == 1 ? 1 : static_cast<int>(array.shape(1)),
         .values = {array.data(), static_cast<std::size_t>(array.size())},
         .component_names = named == components.end() ? std::vector<std::string>() : named->second,
         .unit = ""});
  }
  return input;
}

void write_fields(const std::filesystem::path& path, const std::string& mesh_name, int number, double time,
                  const py::dict& nodal, const std::vector<CellField>& cells,
                  const std::map<std::string, std::vector<std::string>>& components,
                  const std::string& time_unit) {
  const auto input = nodal_input(nodal, components);
  const py::gil_scoped_release unlocked;
  results::append_med_fields(path, mesh_name, {.number = number, .time = time}, input.fields, time_unit,
                             cells);
}

} // namespace

void bind_model_fields(ModelClass& type) {
  type.def("nodal_fields", &nodal_fields, py::arg("state"), py::arg("names") = py::none(),
           "Fields of a state at the nodes by their names: nodes, or nodes x components. names: those that "
           "are wanted, "
           "of displacement, velocity, acceleration, stress, von_mises, cumulated_plastic_strain, strain, "
           "plastic_strain, tresca, mean_stress, principal_stress, reaction, internal_force, contact_force, "
           "temperature, contact_pressure, contact_gap and so on; not given: the usual ones that a run "
           "writes. "
           "Raises InputError.")
      .def("cell_field", &cell_field, py::arg("state"), py::arg("name"),
           py::call_guard<py::gil_scoped_release>(),
           "A field of each cell by itself: a CellField. \"stress_elga\" and so on at the Gauss points, "
           "\"stress_elno\" at the nodes of each cell, \"stress_elem\" their mean by volume; of stress, "
           "strain, "
           "plastic_strain (components xx yy zz xy yz xz), cumulated_plastic_strain, von_mises, tresca, "
           "mean_stress, principal_stress (1 2 3, the largest first), temperature. Raises InputError.")
      .def("field_components", &components_of, py::arg("name"),
           "Names of a field's components; none of a scalar.")
      .def("contact_points", &contact_points, py::arg("zone"),
           "Of a zone, by its name or index, a dictionary of arrays: node (index in the mesh, -1 where the "
           "point stands "
           "on no node), place (points x 3, undeformed [length]), area, excluded.")
      .def("contact_resultants", &resultants, py::arg("state"), py::arg("zone"),
           "Of a zone, by its name or index: in_contact, sticking (points), force of the master on the "
           "slave, normal, "
           "friction [force], largest_pressure, smallest_gap.");
}

void bind_fields(py::module_& module) {
  bind_cell_field(module);
  module.def("write_med", &mesh::write_med, py::arg("path"), py::arg("mesh"), py::arg("name") = "mesh",
             py::call_guard<py::gil_scoped_release>(),
             "Writes a mesh of that name into a new MED file. Raises InputError and OSError.");
  module.def("write_med_fields", &write_fields, py::arg("path"), py::arg("mesh_name"), py::arg("number"),
             py::arg("time"), py::arg("nodal") = py::dict(), py::arg("cells") = std::vector<CellField>(),
             py::arg("components") = py::dict(), py::arg("time_unit") = "",
             R"(Appends fields at one instant to a MED file that has the mesh of that name (write_med).

number: of the instant, at least 0, another one for each. nodal: arrays by the names of fields, one number a node or
nodes x components. cells: a list of CellField. components: names of the components by the names of fields; x, y, z
or 1, 2, … where they are not given. Raises InputError, ValueError for a wrong size and OSError.)");
}

} // namespace rubato::python
