// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces of bodies for surfaces of nodes that are slaves.
#include "rubato/cell/topology.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/io/inp_content.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace rubato::mesh::inp {
namespace {

/// Corners first, then the nodes between them.
std::vector<NodeIndex> nodes_of_face(const Content& content, const ElementFace& face) {
  const auto& element = content.elements[static_cast<std::size_t>(face.element)];
  const auto nodes = content.nodes_of(element);
  std::vector<NodeIndex> of_face;
  for (const auto i : cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)].nodes)
    of_face.push_back(nodes[i]);
  return of_face;
}

std::size_t corner_count(const Content& content, const ElementFace& face) {
  const auto& element = content.elements[static_cast<std::size_t>(face.element)];
  const auto& side = cell::topology(*element.type->cell).sides[static_cast<std::size_t>(face.side)];
  return static_cast<std::size_t>(cell::topology(side.type).corner_count);
}

/// Faces whose corners are all among the nodes, and faces with those nodes that no such face has.
std::vector<ElementFace> faces_with(const Content& content, std::span<const ElementFace> skin,
                                    const std::vector<NodeIndex>& nodes) {
  std::vector<char> wanted(content.points.size(), 0);
  for (const auto node : nodes)
    wanted[static_cast<std::size_t>(node)] = 1;
  std::vector<ElementFace> faces;
  for (const auto& face : skin) {
    auto corners = nodes_of_face(content, face);
    corners.resize(corner_count(content, face));
    if (std::ranges::all_of(corners,
                            [&](NodeIndex node) { return wanted[static_cast<std::size_t>(node)] > 0; }))
      faces.push_back(face);
  }
  for (const auto& face : faces)
    for (const auto node : nodes_of_face(content, face))
      wanted[static_cast<std::size_t>(node)] = 0;
  const auto whole = faces.size();
  for (const auto& face : skin) {
    const auto of_face = nodes_of_face(content, face);
    if (std::ranges::any_of(of_face,
                            [&](NodeIndex node) { return wanted[static_cast<std::size_t>(node)] > 0; }) &&
        std::none_of(faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(whole),
                     [&](const ElementFace& other) {
                       return other.element == face.element && other.side == face.side;
                     }))
      faces.push_back(face);
  }
  return faces;
}

void find_faces_of(Content& content, std::span<const ElementFace> skin, Surface& surface) {
  const auto faces = faces_with(content, skin, surface.nodes);
  if (faces.empty())
    return;
  surface.slave_faces = surface.group + ".faces";
  content.loaded_faces[surface.slave_faces] = faces;
  std::vector<NodeIndex> beside;
  for (const auto& face : faces)
    for (const auto node : nodes_of_face(content, face))
      if (!std::ranges::binary_search(surface.nodes, node))
        beside.push_back(node);
  if (beside.empty())
    return;
  sort_without_repeats(beside);
  surface.beside = surface.group + ".beside";
  content.made_nodes[surface.beside] = std::move(beside);
}

/// Elements that share a node with the surface, and the mean of its faces.
void cut_at(Content& content, Surface& surface) {
  std::vector<char> on_surface(content.points.size(), 0);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& face : surface.faces) {
    const auto nodes = nodes_of_face(content, face);
    const auto count = corner_count(content, face);
    const auto point = [&](std::size_t i) -> const Eigen::Vector3d& {
      return content.points[static_cast<std::size_t>(nodes[i])];
    };
    Eigen::Vector3d normal = Eigen::Vector3d::Zero(), middle = normal;
    for (std::size_t i = 0; i < count; ++i) {
      middle += point(i) / static_cast<double>(count);
      normal += point(i).cross(point((i + 1) % count)) / 2;
    }
    if (count == 2) { // an edge of a plane model
      const Eigen::Vector3d way = point(1) - point(0);
      normal = {way.y(), -way.x(), 0};
    }
    sum += normal.norm() * middle;
    area += normal.norm();
    surface.cut_normal += normal;
    for (const auto node : nodes)
      on_surface[static_cast<std::size_t>(node)] = 1;
  }
  if (!(area > 0) || !(surface.cut_normal.norm() > 0))
    return;
  surface.cut_point = sum / area;
  surface.cut_normal.normalize();
  std::vector<std::int32_t> elements;
  for (std::size_t i = 0; i < content.elements.size(); ++i)
    if (is_continuum(content.elements[i].type->family) &&
        std::ranges::any_of(content.nodes_of(content.elements[i]),
                            [&](NodeIndex node) { return on_surface[static_cast<std::size_t>(node)] != 0; }))
      elements.push_back(static_cast<std::int32_t>(i));
  surface.cut_cells = surface.group + ".cut";
  content.made_cells[surface.cut_cells] = std::move(elements);
}

} // namespace

void find_cuts(Content& content) {
  Faults told_elsewhere;
  for (const auto& placed : content.layout.blocks) {
    const auto* const name = placed.block->find("SURFACE");
    if (!placed.block->is("PRE-TENSION SECTION") || name == nullptr)
      continue;
    const auto* const found = find_surface(content, placed.scope, name->value, told_elsewhere);
    if (found != nullptr && found->cut_cells.empty())
      cut_at(content, content.surfaces.at({found->scope, folded(found->label)}));
  }
}

void find_slave_faces(Content& content, Faults& faults) {
  std::vector<ElementFace> skin;
  Faults told_elsewhere;
  for (const auto& placed : content.layout.blocks) {
    if (!placed.block->is("CONTACT PAIR") && !placed.block->is("TIE"))
      continue;
    for (const auto& line : placed.block->lines) {
      const auto fields = fields_of(line);
      const auto* const found =
          fields.empty() ? nullptr : find_surface(content, placed.scope, fields[0], told_elsewhere);
      if (found == nullptr || !found->of_nodes || !found->slave_faces.empty())
        continue;
      if (skin.empty())
        skin = free_faces(content);
      auto& surface = content.surfaces.at({found->scope, folded(found->label)});
      find_faces_of(content, skin, surface);
      if (surface.slave_faces.empty())
        faults.add(fields[0], fmt::format("found the surface {} of nodes that no body has at its boundary, "
                                          "expected nodes of faces of elements",
                                          shown(surface.label)));
    }
  }
}

} // namespace rubato::mesh::inp
