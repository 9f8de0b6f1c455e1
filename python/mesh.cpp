// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes: what they have, read and written.
#include "rubato/mesh/mesh.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/generate.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include "bind.hpp"
#include "mesh_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <memory>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

namespace rubato::python {
namespace {

using mesh::Mesh;
/// Cells of one type of a mesh that it keeps alive.
struct Block {
  SharedMesh mesh;
  std::size_t index = 0;
  mesh::CellIndex first = 0;
  const mesh::CellBlock& cells() const { return mesh->blocks[index]; }
};

std::vector<Block> blocks_of(const SharedMesh& mesh) {
  std::vector<Block> blocks;
  mesh::CellIndex first = 0;
  for (std::size_t i = 0; i < mesh->blocks.size(); ++i) {
    blocks.push_back({mesh, i, first});
    first += mesh->blocks[i].cell_count();
  }
  return blocks;
}

py::dict groups_of(const std::vector<mesh::Group>& groups, py::handle owner) {
  py::dict result;
  for (const auto& group : groups) {
    const auto items = group.in_order();
    result[py::str(group.name)] = view(items.data(), {static_cast<py::ssize_t>(items.size())}, owner);
  }
  return result;
}

const Mesh& mesh_of(py::handle self) {
  return self.cast<const Mesh&>();
}

py::array nodes_named(const Mesh& mesh, const std::string& name) {
  const auto found = mesh::find_nodes(mesh, name);
  if (!found.fault.empty())
    throw InputError(found.fault);
  return copied(found.nodes);
}

std::string shown_mesh(const Mesh& mesh) {
  return fmt::format("<rubato.Mesh: {} nodes, {} cells, dimension {}>", mesh.node_count(), mesh.cell_count(),
                     mesh.dimension);
}

void bind_block(py::module_& module) {
  py::class_<Block>(module, "CellBlock", "The cells of one type of a mesh.")
      .def_property_readonly(
          "type", [](const Block& block) { return Codec<CellType>::to(block.cells().type); }, "CellType")
      .def_property_readonly(
          "first", [](const Block& block) { return block.first; }, "Index of the first cell in the mesh.")
      .def("__len__", [](const Block& block) { return block.cells().cell_count(); })
      .def_property_readonly(
          "nodes",
          [](const py::object& self) {
            const auto& block = self.cast<const Block&>();
            const auto& cells = block.cells();
            return view(cells.nodes.data(), {cells.cell_count(), cell::topology(cells.type).node_count},
                        py::cast(block.mesh));
          },
          "Indices of the nodes of each cell: cells x nodes, int32, a view. Corners come first, in VTK's "
          "order.")
      .def_property_readonly(
          "numbers", [](const Block& block) { return view(block.cells().numbers, py::cast(block.mesh)); },
          "The file's own numbers: one a cell, int64, a view.")
      .def_property_readonly(
          "names", [](const Block& block) { return block.cells().names; },
          "The names that the file gives its cells, one a cell; empty when it gives none.")
      .def("__repr__", [](const Block& block) {
        return fmt::format("<rubato.CellBlock: {} {}>", block.cells().cell_count(),
                           words_of<CellType>().words[static_cast<std::size_t>(block.cells().type)]);
      });
}

void bind_members(MeshClass& type) {
  type.def_property_readonly(
          "dimension", [](const Mesh& mesh) { return mesh.dimension; },
          "Of space: 2 (z = 0 everywhere) or 3.")
      .def_property_readonly("node_count", &Mesh::node_count, "Number of nodes.")
      .def_property_readonly("cell_count", &Mesh::cell_count, "Number of cells.")
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            const auto& points = mesh_of(self).points;
            return view(points.empty() ? nullptr : points.front().data(),
                        {static_cast<py::ssize_t>(points.size()), 3}, self);
          },
          "Coordinates of the nodes: nodes x 3 [length], a view.")
      .def_property_readonly("blocks", &blocks_of,
                             "The cells by their types, a CellBlock each; cell indices run through them.")
      .def_property_readonly(
          "node_numbers", [](const py::object& self) { return view(mesh_of(self).node_numbers, self); },
          "The file's own numbers: one a node, int64, a view.")
      .def_property_readonly(
          "node_names", [](const Mesh& mesh) { return mesh.node_names; },
          "The names that the file gives its nodes, one a node; empty when it gives none.")
      .def_property_readonly(
          "node_groups", [](const py::object& self) { return groups_of(mesh_of(self).node_groups, self); },
          "Node indices of each group by its name: int32, views; ascending unless the group has an order.")
      .def_property_readonly(
          "cell_groups", [](const py::object& self) { return groups_of(mesh_of(self).cell_groups, self); },
          "Cell indices of each group by its name: int32, views.")
      .def("group_names", &mesh::group_names, "Names of all groups, of nodes and of cells, sorted.")
      .def("nodes_named", &nodes_named, py::arg("name"),
           "Indices of the nodes of a group of nodes or cells, or of one node: \"N90\". Raises InputError.")
      .def(
          "node_name",
          [](const Mesh& mesh, int node) {
            if (node < 0 || node >= mesh.node_count())
              throw py::index_error(
                  fmt::format("found the node {}, expected 0 to {}", node, mesh.node_count() - 1));
            return mesh::node_name(mesh, node);
          },
          py::arg("node"), "What decks call the node of that index.")
      .def("__repr__", &shown_mesh);
}

} // namespace

void bind_mesh(py::module_& module) {
  bind_block(module);
  MeshClass type(
      module, "Mesh",
      "Nodes, cells and groups. A mesh does not change: methods that change something give another mesh.");
  bind_members(type);
  bind_mesh_tools(module, type);
  module.def(
      "read_mesh",
      [](const std::filesystem::path& path, const std::string& name) {
        return std::make_shared<Mesh>(mesh::read_mesh(path, name));
      },
      py::arg("path"), py::arg("name") = "", py::call_guard<py::gil_scoped_release>(),
      "A mesh file (.med, .mmed, .rmed, .msh, .mail, .geo where this build has Gmsh). name chooses among the "
      "meshes of a MED file. Raises InputError.");
  module.def("write_mesh", &mesh::write_mesh, py::arg("path"), py::arg("mesh"),
             py::call_guard<py::gil_scoped_release>(),
             "Writes the format that the ending of the path says. Raises InputError and OSError.");
  module.def(
      "generate",
      [](const py::object& bodies, int refine) {
        const auto list = Codec<std::vector<study::Body>>::from(bodies, "bodies");
        return std::make_shared<Mesh>(mesh::generate(list, refine));
      },
      py::arg("bodies"), py::arg("refine") = 1,
      "One mesh of all bodies, a list of Body, with refine times their divisions. Raises InputError.");
  module.def(
      "load_mesh",
      [](const py::object& source) {
        const auto of = Codec<study::MeshSource>::from(source, "mesh");
        const py::gil_scoped_release unlocked;
        return std::make_shared<Mesh>(model::load_mesh(of));
      },
      py::arg("source"),
      "The mesh that a MeshSource names or describes, as a run has it: mended, converted, refined, with the "
      "groups that are made. Raises InputError.");
}

} // namespace rubato::python
