// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/inp.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace rubato::mesh {
namespace inp {
namespace {

/// Cells of faces, one for each face of the mesh.
class FaceMaker {
public:
  FaceMaker(const Content& content, MeshBuilder& builder) : content_(content), builder_(builder) {}

  /// A face that the file draws itself, as a surface element.
  void note(std::span<const NodeIndex> nodes, int corners, MeshBuilder::CellHandle handle) {
    known_.try_emplace(key_of(nodes.first(static_cast<std::size_t>(corners))), handle);
  }

  MeshBuilder::CellHandle cell_of(const ElementFace& face) {
    const auto& element = content_.elements[static_cast<std::size_t>(face.element)];
    const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
    std::vector<NodeIndex> nodes;
    for (const auto node : side.nodes)
      nodes.push_back(content_.nodes_of(element)[node]);
    const auto corners = static_cast<std::size_t>(cell::topology(side.type).corner_count);
    const auto [found, is_new] = known_.try_emplace(key_of(std::span(nodes).first(corners)), 0);
    if (is_new)
      found->second = builder_.add_cell(side.type, nodes);
    return found->second;
  }

private:
  using Key = std::array<NodeIndex, 4>;
  static Key key_of(std::span<const NodeIndex> corners) {
    Key key{-1, -1, -1, -1};
    std::ranges::copy(corners, key.begin());
    std::ranges::sort(key);
    return key;
  }

  const Content& content_;
  MeshBuilder& builder_;
  std::map<Key, MeshBuilder::CellHandle> known_;
};

/// The cell of each element, none where it is no cell.
std::vector<std::optional<MeshBuilder::CellHandle>> add_cells(const Content& content, MeshBuilder& builder,
                                                              FaceMaker& faces) {
  std::vector<std::optional<MeshBuilder::CellHandle>> cells;
  for (std::size_t i = 0; i < content.elements.size(); ++i) {
    const auto& element = content.elements[i];
    cells.emplace_back();
    if (!element.type->cell)
      continue;
    const auto nodes = content.nodes_of(element);
    cells.back() = builder.add_cell(*element.type->cell, nodes, content.element_numbers[i]);
    const auto& shape = cell::topology(*element.type->cell);
    if (shape.dimension == content.dimension - 1)
      faces.note(nodes, shape.corner_count, *cells.back());
  }
  return cells;
}

} // namespace

Mesh mesh_of(const Content& content) {
  MeshBuilder builder(content.dimension);
  for (std::size_t i = 0; i < content.points.size(); ++i)
    builder.add_node(content.points[i], content.node_numbers[i]);
  FaceMaker faces(content, builder);
  const auto cells = add_cells(content, builder, faces);
  for (const auto& [key, set] : content.node_sets)
    builder.add_to_node_group(set.group, set.items);
  const auto add_elements = [&](const std::string& group, std::span<const std::int32_t> items) {
    std::vector<MeshBuilder::CellHandle> members;
    for (const auto index : items)
      if (cells[static_cast<std::size_t>(index)])
        members.push_back(*cells[static_cast<std::size_t>(index)]);
    if (!members.empty())
      builder.add_to_cell_group(group, members);
  };
  for (const auto& [key, set] : content.element_sets)
    add_elements(set.group, set.items);
  const auto add_faces = [&](const std::string& group, std::span<const ElementFace> of_group) {
    std::vector<MeshBuilder::CellHandle> members;
    for (const auto& face : of_group)
      members.push_back(faces.cell_of(face));
    builder.add_to_cell_group(group, members);
  };
  for (const auto& [key, surface] : content.surfaces) {
    if (surface.of_nodes)
      builder.add_to_node_group(surface.group, surface.nodes);
    else
      add_faces(surface.group, surface.faces);
  }
  for (const auto& [group, of_group] : content.loaded_faces)
    add_faces(group, of_group);
  for (const auto& [group, items] : content.made_cells)
    add_elements(group, items);
  for (const auto& [group, nodes] : content.made_nodes)
    builder.add_to_node_group(group, nodes);
  return std::move(builder).build();
}

} // namespace inp

Mesh read_inp(const std::filesystem::path& path) {
  return inp::mesh_of(inp::read_content(path));
}

} // namespace rubato::mesh
