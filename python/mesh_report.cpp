// SPDX-License-Identifier: LGPL-3.0-or-later
// What a mesh holds and what looks wrong with it.
#include "rubato/mesh/quality.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "values.hpp"
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

namespace rubato::python {

using mesh::Findings;
using mesh::MeshReport;
using mesh::TypeQuality;

void bind_mesh_report(py::module_& module) {
  py::class_<Findings>(module, "Findings", "How many, and what the file calls the first few of them.")
      .def_readonly("count", &Findings::count, "How many.")
      .def_readonly("first", &Findings::first, "Names or numbers of the first few.")
      .def("__repr__",
           [](const Findings& findings) { return fmt::format("<rubato.Findings: {}>", findings.count); });
  py::class_<TypeQuality>(module, "TypeQuality", "The cells of one type.")
      .def_property_readonly(
          "type", [](const TypeQuality& quality) { return Codec<CellType>::to(quality.type); }, "CellType")
      .def_readonly("count", &TypeQuality::count, "How many.")
      .def_readonly("has_jacobian", &TypeQuality::has_jacobian, "Not of points and segments.")
      .def_readonly("smallest_jacobian", &TypeQuality::smallest_jacobian,
                    "Scaled: 1 for the ideal cell, 0 for a flat one, below when inverted somewhere.")
      .def_readonly("mean_jacobian", &TypeQuality::mean_jacobian, "Scaled.")
      .def_readonly("worst_cell", &TypeQuality::worst_cell, "Its name or number in the file.");
  py::class_<MeshReport>(
      module, "MeshReport",
      "What a mesh holds, how good its cells are and what looks wrong. str() is the program's text.")
      .def_readonly("types", &MeshReport::types, "The cells by type: list of TypeQuality.")
      .def_readonly("lower", &MeshReport::lower, "Of the bounding box [length].")
      .def_readonly("upper", &MeshReport::upper, "Of the bounding box [length].")
      .def_readonly("shortest_edge", &MeshReport::shortest_edge, "Between corners [length]; 0 without edges.")
      .def_readonly("longest_edge", &MeshReport::longest_edge, "Between corners [length].")
      .def_readonly("bulk_measure", &MeshReport::bulk_measure, "Volume, in the plane area, of the bodies.")
      .def_readonly("connected_bodies", &MeshReport::connected_bodies, "Sets of cells that share nodes.")
      .def_readonly("lost_nodes", &MeshReport::lost_nodes, "With a coordinate that is not finite.")
      .def_readonly("free_nodes", &MeshReport::free_nodes, "Nodes of no cell.")
      .def_readonly("inverted_cells", &MeshReport::inverted_cells,
                    "Whose Jacobian is not positive at some corner, reversed or not.")
      .def_readonly("duplicate_nodes", &MeshReport::duplicate_nodes,
                    "At the place of another one of the body.")
      .def_readonly("loose_cells", &MeshReport::loose_cells, "Not connected to any bulk cell.")
      .def_readonly("unowned_faces", &MeshReport::unowned_faces, "Faces that are no side of a bulk cell.")
      .def_readonly("reversed_cells", &MeshReport::reversed_cells, "Whose nodes ran the wrong way round.")
      .def_readonly("empty_groups", &MeshReport::empty_groups, "Names of groups with nothing in them.")
      .def_readonly("has_bulk_cells", &MeshReport::has_bulk_cells, "Whether there are bodies.")
      .def_readonly("coincident_between_bodies", &MeshReport::coincident_between_bodies,
                    "Nodes at the place of a node of another body.")
      .def("looks_right", &MeshReport::looks_right, "Whether nothing looks wrong.")
      .def("__str__", [](const MeshReport& report) { return mesh::to_text(report); });
}

} // namespace rubato::python
