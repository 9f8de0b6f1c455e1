// SPDX-License-Identifier: LGPL-3.0-or-later
// Two runs side by side.
#include "rubato/results/compare.hpp"
#include "rubato/results/stored_run.hpp"

#include "bind.hpp"
#include "mesh_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <filesystem>
#include <memory>
#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

using results::Extent;
using results::FieldComparison;
using results::HistoryComparison;
using SharedComparison = std::shared_ptr<FieldComparison>;

/// Views of one of the two fields, or of their difference.
auto numbers(std::vector<double> FieldComparison::*which) {
  return [which](const py::object& self) {
    const auto& fields = self.cast<const FieldComparison&>();
    const auto components = static_cast<py::ssize_t>(fields.components.size());
    return view((fields.*which).data(), {static_cast<py::ssize_t>(fields.mesh.node_count()), components},
                self);
  };
}

std::vector<Extent> extents_of(const FieldComparison& fields, const std::optional<std::string>& on) {
  const auto nodes = on ? results::nodes_of(fields.mesh, *on) : results::all_nodes(fields.mesh);
  return results::extents(fields, nodes);
}

std::vector<HistoryComparison> compare_histories(const std::filesystem::path& a,
                                                 const std::filesystem::path& b, const std::string& probe,
                                                 const std::optional<double>& at) {
  return results::compare_histories(results::read_stored_run(a).probes, results::read_stored_run(b).probes,
                                    probe, at);
}

void bind_fields_compared(py::module_& module) {
  py::class_<Extent>(module, "Extent", "How far one component of a field differs over some nodes.")
      .def_readonly("component", &Extent::component, "Its name; empty of a scalar.")
      .def_readonly("difference", &Extent::difference, "A - B where it is largest.")
      .def_readonly("node", &Extent::node, "Index of the node where that is.")
      .def_readonly("rms", &Extent::rms, "Root of the mean square of A - B.")
      .def_readonly("largest_a", &Extent::largest_a, "Largest magnitude of A.")
      .def_readonly("largest_b", &Extent::largest_b, "Largest magnitude of B.");
  py::class_<FieldComparison, SharedComparison>(module, "FieldComparison",
                                                "A field of two runs at one instant.")
      .def_readonly("field", &FieldComparison::field, "Its name.")
      .def_readonly("components", &FieldComparison::components, "Their names; one empty of a scalar.")
      .def_readonly("at", &FieldComparison::at, "The stored instant [time].")
      .def_property_readonly(
          "mesh", [](const SharedComparison& fields) { return SharedMesh(fields, &fields->mesh); },
          "Of both runs.")
      .def_property_readonly("a", numbers(&FieldComparison::a), "Nodes x components, a view.")
      .def_property_readonly("b", numbers(&FieldComparison::b), "Nodes x components, a view.")
      .def_property_readonly("difference", numbers(&FieldComparison::difference), "A - B, a view.")
      .def("extents", &extents_of, py::arg("on") = py::none(),
           "An Extent a component, over a group or a node; over all nodes when not given.");
}

} // namespace

void bind_comparison(py::module_& module) {
  bind_fields_compared(module);
  py::class_<HistoryComparison>(module, "HistoryComparison",
                                "How far one column of the probes of two runs differs.")
      .def_readonly("quantity", &HistoryComparison::quantity, "\"tip.y\"")
      .def_readonly("instants", &HistoryComparison::instants, "That were compared.")
      .def_readonly("at", &HistoryComparison::at, "Instant where the difference is largest [time].")
      .def_readonly("a", &HistoryComparison::a, "Value of A there.")
      .def_readonly("b", &HistoryComparison::b, "Value of B there.")
      .def_readonly("largest_a", &HistoryComparison::largest_a, "Largest magnitude of A.")
      .def_property_readonly("difference", &HistoryComparison::difference, "A - B there.");
  module.def("compare_fields", &results::compare_fields, py::arg("a"), py::arg("b"), py::arg("field"),
             py::arg("at"), py::call_guard<py::gil_scoped_release>(),
             "A field at the nodes of two run folders that have fields.med, at a stored instant. Raises "
             "InputError.");
  module.def("compare_histories", &compare_histories, py::arg("a"), py::arg("b"), py::arg("probe"),
             py::arg("at") = py::none(),
             "A probe (\"tip\": every component, or \"tip.y\") of two run folders, at one instant or at all "
             "that both "
             "have: a HistoryComparison a column. Raises InputError.");
}

} // namespace rubato::python
