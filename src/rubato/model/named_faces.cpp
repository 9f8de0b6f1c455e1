// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/named_faces.hpp"

#include "rubato/mesh/orientation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubato::model {
namespace {

/// Whether `nodes` runs round the face the same way as `outward`.
bool same_sense(std::span<const mesh::NodeIndex> nodes, std::span<const mesh::NodeIndex> outward,
                int corners) {
  const auto corner = [&](std::span<const mesh::NodeIndex> list, int i) {
    return list[static_cast<std::size_t>(i % corners)];
  };
  int shift = 0;
  while (corner(nodes, 0) != corner(outward, shift))
    ++shift;
  return corner(nodes, 1) == corner(outward, shift + 1);
}

/// The side with the numbering of the mesh's own face, mirrored when that one looks inwards. Where a
/// projection leaves a triangle, the closest point of the reference cell depends on which corner is the first
/// one: it is the user's.
contact::Face face_of(const mesh::Mesh& mesh, const mesh::SurfaceFace& side) {
  contact::Face face;
  face.type = side.type;
  face.node_count = static_cast<int>(side.nodes().size());
  face.cell = side.face;
  std::ranges::copy(side.nodes(), face.nodes.begin());
  if (side.face == mesh::SurfaceFace::none || mesh.type_of(side.face) != side.type)
    return face;
  const auto own = mesh.nodes_of(side.face);
  const auto& topology = cell::topology(side.type);
  const auto mirrored = mesh::mirrored_numbering(side.type);
  const bool outwards = topology.dimension == 1 ? own[0] == side.nodes()[0]
                                                : same_sense(own, side.nodes(), topology.corner_count);
  for (std::size_t i = 0; i < own.size(); ++i)
    face.nodes[i] = own[outwards ? i : mirrored[i]];
  return face;
}

} // namespace

contact::Surface surface_of(const mesh::Mesh& mesh, std::span<const mesh::SurfaceFace> sides) {
  std::vector<contact::Face> faces;
  std::ranges::transform(sides, std::back_inserter(faces),
                         [&](const auto& side) { return face_of(mesh, side); });
  return contact::make_surface(mesh, std::move(faces));
}

std::optional<NamedFaces> faces_named(const mesh::Mesh& mesh, const Mention& name, bool takes_sheets,
                                      std::vector<Fault>& faults) {
  const auto* group = cells_named(mesh, name, faults);
  if (group == nullptr)
    return std::nullopt;
  auto oriented = mesh::oriented_faces(mesh, group->items);
  NamedFaces named;
  if (takes_sheets)
    named.sheets = mesh::sheets_of(mesh, std::exchange(oriented.unowned, {}));
  auto told = mesh::faults_of(mesh, oriented);
  std::ranges::move(named.sheets.faults, std::back_inserter(told));
  for (const auto& text : told)
    faults.push_back(fault_at(name.path, fmt::format("contact surface '{}': {}", name.name, text)));
  if (!told.empty())
    return std::nullopt;
  named.sides = std::move(oriented.faces);
  return named;
}

} // namespace rubato::model
