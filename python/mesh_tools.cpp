// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes made of others, and built by programs.
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/quality.hpp"
#include "rubato/mesh/refine.hpp"
#include "rubato/mesh/skin.hpp"

#include <fmt/format.h>

#include "mesh_class.hpp"
#include "values.hpp"
#include "views.hpp"
#include <algorithm>
#include <memory>
#include <pybind11/stl.h>
#include <stdexcept>

namespace rubato::python {
namespace {

using mesh::Mesh;
using mesh::MeshBuilder;

SharedMesh shared(Mesh mesh) {
  return std::make_shared<Mesh>(std::move(mesh));
}

mesh::Group group_of(const std::string& name, std::vector<std::int32_t> items, bool ordered) {
  mesh::Group group{name, items, {}};
  std::ranges::sort(group.items);
  group.items.erase(std::unique(group.items.begin(), group.items.end()), group.items.end());
  if (ordered && group.items.size() != items.size())
    throw std::invalid_argument("found an index twice, expected an order without repeats");
  if (ordered)
    group.ordered = std::move(items);
  return group;
}

void put_group(std::vector<mesh::Group>& groups, mesh::Group group) {
  const auto found = std::ranges::find(groups, group.name, &mesh::Group::name);
  if (found != groups.end())
    *found = std::move(group);
  else
    groups.push_back(std::move(group));
}

SharedMesh with_node_group(const Mesh& mesh, const std::string& name, const py::object& nodes, bool ordered) {
  auto group = group_of(name, indices_of(nodes, mesh.node_count(), "nodes"), ordered);
  auto result = shared(mesh);
  put_group(result->node_groups, std::move(group));
  return result;
}

SharedMesh with_cell_group(const Mesh& mesh, const std::string& name, const py::object& cells) {
  auto group = group_of(name, indices_of(cells, mesh.cell_count(), "cells"), false);
  auto result = shared(mesh);
  put_group(result->cell_groups, std::move(group));
  return result;
}

SharedMesh with_node_groups(const Mesh& mesh, const py::dict& groups) {
  auto result = shared(mesh);
  for (const auto& [name, nodes] : groups)
    put_group(result->node_groups,
              group_of(name.cast<std::string>(),
                       indices_of(nodes.cast<py::object>(), mesh.node_count(), "nodes"), false));
  return result;
}

SharedMesh with_cell_groups(const Mesh& mesh, const py::dict& groups) {
  auto result = shared(mesh);
  for (const auto& [name, cells] : groups)
    put_group(result->cell_groups,
              group_of(name.cast<std::string>(),
                       indices_of(cells.cast<py::object>(), mesh.cell_count(), "cells"), false));
  return result;
}

SharedMesh without_group(const Mesh& mesh, const std::string& name) {
  auto result = shared(mesh);
  const auto is_meant = [&](const mesh::Group& group) { return group.name == name; };
  if (std::erase_if(result->node_groups, is_meant) + std::erase_if(result->cell_groups, is_meant) == 0)
    throw py::key_error(name);
  return result;
}

SharedMesh with_points(const Mesh& mesh, const Numbers& points) {
  auto places = places_of(points);
  if (places.size() != mesh.points.size())
    throw std::invalid_argument(
        fmt::format("found {} places, expected one a node: {}", places.size(), mesh.points.size()));
  auto result = shared(mesh);
  result->points = std::move(places);
  return result;
}

/// Sides of cells, those of one type together.
py::dict skin_of(const Mesh& mesh) {
  std::map<CellType, std::vector<mesh::SurfaceFace>> of_type;
  for (const auto& face : mesh::skin(mesh))
    of_type[face.type].push_back(face);
  py::dict result;
  for (const auto& [type, faces] : of_type) {
    const auto count = static_cast<py::ssize_t>(faces.size());
    py::array_t<std::int32_t> nodes({count, static_cast<py::ssize_t>(cell::topology(type).node_count)});
    py::array_t<std::int32_t> owners(count);
    for (py::ssize_t i = 0; i < count; ++i) {
      const auto& face = faces[static_cast<std::size_t>(i)];
      std::ranges::copy(face.nodes(), nodes.mutable_data(i, 0));
      owners.mutable_at(i) = face.owner;
    }
    result[Codec<CellType>::to(type)] = py::make_tuple(nodes, owners);
  }
  return result;
}

/// A builder until it has built.
class Building {
public:
  explicit Building(int dimension) : builder_(in_space(dimension)) {}

  MeshBuilder& builder() {
    if (!builder_)
      throw std::logic_error("the mesh is built: this builder has nothing any more");
    return *builder_;
  }

  int add_node(const Numbers& place, std::int64_t number, std::string name) {
    if (place.ndim() != 1 || (place.size() != 2 && place.size() != 3))
      throw std::invalid_argument("found another shape, expected a place: 3 coordinates, or 2 in the plane");
    return builder().add_node({place.at(0), place.at(1), place.size() == 3 ? place.at(2) : 0.0}, number,
                              std::move(name));
  }

  py::array add_nodes(const Numbers& places) {
    std::vector<std::int32_t> nodes;
    for (const auto& place : places_of(places))
      nodes.push_back(builder().add_node(place));
    return copied(nodes);
  }

  int add_cell(const py::object& type, const py::object& nodes, std::int64_t number, std::string name) {
    const auto cell_type = Codec<CellType>::from(type, "type");
    const auto of_cell = checked_nodes(nodes);
    if (of_cell.size() != nodes_of(cell_type))
      throw std::invalid_argument(fmt::format("found {} nodes, expected {} of a {}", of_cell.size(),
                                              nodes_of(cell_type), word(cell_type)));
    return builder().add_cell(cell_type, of_cell, number, std::move(name));
  }

  py::array add_cells(const py::object& type, const py::array& nodes) {
    const auto cell_type = Codec<CellType>::from(type, "type");
    const auto count = nodes_of(cell_type);
    if (nodes.ndim() != 2 || static_cast<std::size_t>(nodes.shape(1)) != count)
      throw std::invalid_argument(fmt::format("found an array of another shape, expected cells x {} of a {}",
                                              count, word(cell_type)));
    const auto of_cells = checked_nodes(nodes);
    std::vector<std::int32_t> cells;
    for (std::size_t first = 0; first < of_cells.size(); first += count)
      cells.push_back(builder().add_cell(cell_type, std::span(of_cells).subspan(first, count)));
    return copied(cells);
  }

  void add_to_node_group(const std::string& name, const py::object& nodes) {
    builder().add_to_node_group(name, checked_nodes(nodes));
  }
  void add_to_cell_group(const std::string& name, const py::object& cells) {
    builder().add_to_cell_group(name, indices_of(cells, builder().cell_count(), "cells"));
  }

  SharedMesh build() {
    auto mesh = shared(std::move(builder()).build());
    builder_.reset();
    return mesh;
  }

private:
  static MeshBuilder in_space(int dimension) {
    if (dimension != 2 && dimension != 3)
      throw std::invalid_argument(fmt::format("dimension: found {}, expected 2 or 3", dimension));
    return MeshBuilder(dimension);
  }
  static std::size_t nodes_of(CellType type) {
    return static_cast<std::size_t>(cell::topology(type).node_count);
  }
  static const std::string& word(CellType type) {
    return words_of<CellType>().words[static_cast<std::size_t>(type)];
  }
  std::vector<std::int32_t> checked_nodes(const py::object& nodes) {
    return indices_of(nodes, static_cast<std::int64_t>(builder().points().size()), "nodes");
  }

  std::optional<MeshBuilder> builder_;
};

void bind_builder(py::module_& module) {
  py::class_<Building>(
      module, "MeshBuilder",
      "Collects nodes, cells and groups in any order and makes a Mesh of them. Cells are named by "
      "the order in which they were added, from 0: their handles.")
      .def(py::init<int>(), py::arg("dimension"), "dimension: of space, 2 or 3.")
      .def("add_node", &Building::add_node, py::arg("place"), py::arg("number") = 0, py::arg("name") = "",
           "Index of the new node. number 0 and an empty name mean not given.")
      .def("add_nodes", &Building::add_nodes, py::arg("places"),
           "places: n x 3, or n x 2 [length]. Their indices.")
      .def("add_cell", &Building::add_cell, py::arg("type"), py::arg("nodes"), py::arg("number") = 0,
           py::arg("name") = "", "Handle of the new cell.")
      .def("add_cells", &Building::add_cells, py::arg("type"), py::arg("nodes"),
           "nodes: cells x nodes, whole numbers. Handles of the new cells.")
      .def("add_to_node_group", &Building::add_to_node_group, py::arg("name"), py::arg("nodes"),
           "Adding to a group that is there makes the union.")
      .def("add_to_cell_group", &Building::add_to_cell_group, py::arg("name"), py::arg("cells"),
           "cells: handles. Adding to a group that is there makes the union.")
      .def(
          "append", [](Building& building, const Mesh& mesh) { building.builder().append(mesh); },
          py::arg("mesh"), "Everything of another mesh but its numbers and names, on nodes of its own.")
      .def("build", &Building::build, "The mesh; the builder is empty then.");
}

} // namespace

void bind_mesh_tools(py::module_& module, MeshClass& type) {
  bind_builder(module);
  type.def(
          "copy", [](const Mesh& mesh) { return shared(mesh); }, "Another mesh with the same content.")
      .def("with_node_group", &with_node_group, py::arg("name"), py::arg("nodes"), py::arg("ordered") = false,
           "The mesh with this group of nodes, in the place of one of that name. ordered: the order counts.")
      .def("with_cell_group", &with_cell_group, py::arg("name"), py::arg("cells"),
           "The mesh with this group of cells, in the place of one of that name.")
      .def("with_node_groups", &with_node_groups, py::arg("groups"),
           "The mesh with groups of nodes by their names, in the place of those of these names: one copy for "
           "all.")
      .def("with_cell_groups", &with_cell_groups, py::arg("groups"), "The same with groups of cells.")
      .def("without_group", &without_group, py::arg("name"),
           "The mesh without the groups of that name, of nodes and of cells. Raises KeyError when there is "
           "none.")
      .def("with_points", &with_points, py::arg("points"),
           "The mesh with its nodes at these places: nodes x 3, or nodes x 2 in the plane [length].")
      .def(
          "with_groups",
          [](const Mesh& mesh, const py::object& groups) {
            return shared(
                mesh::with_groups(mesh, Codec<std::vector<study::MadeGroup>>::from(groups, "groups")));
          },
          py::arg("groups"), "The mesh with groups that are made, a list of MadeGroup. Raises InputError.")
      .def(
          "refined", [](const Mesh& mesh, int parts) { return shared(mesh::refined(mesh, parts)); },
          py::arg("parts"), "Every edge cut into parts equal ones, a power of two. Raises InputError.")
      .def(
          "converted",
          [](const Mesh& mesh, const py::object& order) {
            return shared(mesh::converted(mesh, Codec<study::MeshConversion>::from(order, "order")));
          },
          py::arg("order"),
          "The same with cells of another order: \"linear\", \"quadratic\", \"full_quadratic\".")
      .def(
          "mended",
          [](const Mesh& mesh) {
            auto result = shared(mesh);
            mesh::mend_orientation(*result);
            return result;
          },
          "The mesh with every cell of positive volume: those of negative one are mirrored.")
      .def("skin", &skin_of,
           "Sides of bodies that belong to one cell only, by their type: (nodes, faces x nodes, with normals "
           "that "
           "point out; owners, the index of each face's cell). Cells must have a positive volume.")
      .def("quality", &mesh::examine, py::call_guard<py::gil_scoped_release>(),
           "What the mesh holds, how good its cells are and what looks wrong: a MeshReport.");
}

} // namespace rubato::python
