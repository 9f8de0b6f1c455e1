// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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
  if (mesh.type_of(side.face) != side.type)
    return face;
  const auto own = mesh.nodes_of(side.face);
  const auto& topology = mesh::topology(side.type);
  const auto mirrored = mesh::mirrored_numbering(side.type);
  const bool outwards = topology.dimension == 1 ? own[0] == side.nodes()[0]
                                                : same_sense(own, side.nodes(), topology.corner_count);
  for (std::size_t i = 0; i < own.size(); ++i)
    face.nodes[i] = own[outwards ? i : mirrored[i]];
  return face;
}

contact::Surface surface_named(const mesh::Mesh& mesh, const deck::Name& name, std::vector<Fault>& faults) {
  const auto* group = cells_named(mesh, name, faults);
  if (group == nullptr)
    return {};
  const auto oriented = mesh::oriented_faces(mesh, group->items);
  for (const auto& text : mesh::faults_of(mesh, oriented))
    faults.push_back({name.at, fmt::format("contact surface '{}': {}", name.text, text)});
  if (!oriented.sound())
    return {};
  std::vector<contact::Face> faces;
  std::ranges::transform(oriented.faces, std::back_inserter(faces),
                         [&](const auto& side) { return face_of(mesh, side); });
  return contact::make_surface(mesh, std::move(faces));
}

bool share_a_face(const contact::Surface& a, const contact::Surface& b) {
  std::vector<mesh::CellIndex> cells;
  for (const auto& face : a.faces)
    cells.push_back(face.cell);
  std::ranges::sort(cells);
  return std::ranges::any_of(b.faces,
                             [&](const auto& face) { return std::ranges::binary_search(cells, face.cell); });
}

std::vector<mesh::NodeIndex> excluded_nodes(const mesh::Mesh& mesh, const deck::ContactZone& zone,
                                            std::vector<Fault>& faults) {
  std::vector<mesh::NodeIndex> all;
  for (const auto& name : zone.exclude_nodes) {
    const auto nodes = nodes_or_fault(mesh, name, faults);
    all.insert(all.end(), nodes.begin(), nodes.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// With fewer Gauss points than the multipliers of a face can tell apart, their equations would be dependent.
void check_rule(const deck::ContactZone& zone, const contact::Surface& slave, std::vector<Fault>& faults) {
  if (zone.gauss_points == 0)
    return;
  for (const auto& face : slave.faces) {
    const int least = mesh::topology(face.type).order + 1;
    if (zone.gauss_points >= least)
      continue;
    faults.push_back(
        {zone.at,
         fmt::format("found {} Gauss points a direction, expected at least {} on the {} faces of '{}'",
                     zone.gauss_points, least, mesh::topology(face.type).name, zone.slave.text)});
    return;
  }
}

} // namespace

std::vector<contact::Zone> make_zones(const deck::Study& study, const mesh::Mesh& mesh,
                                      const fem::DofMap& dofs, std::vector<Fault>& faults) {
  const bool plane =
      study.physics == deck::Physics::plane_stress || study.physics == deck::Physics::plane_strain;
  const contact::ZoneGeometry geometry{dofs.components, plane ? study.thickness : 1.0,
                                       study.physics == deck::Physics::axisymmetric ? contact::Measure::ring
                                                                                    : contact::Measure::unit};
  std::vector<contact::Zone> zones;
  for (const auto& settings : study.contact) {
    const auto known = faults.size();
    auto master = settings.obstacle ? contact::Surface() : surface_named(mesh, settings.master, faults);
    auto slave = surface_named(mesh, settings.slave, faults);
    const auto excluded = excluded_nodes(mesh, settings, faults);
    if (faults.size() == known && share_a_face(master, slave))
      faults.push_back(
          {settings.slave.at, fmt::format("master '{}' and slave '{}' share faces, expected two surfaces",
                                          settings.master.text, settings.slave.text)});
    check_rule(settings, slave, faults);
    if (faults.size() > known)
      continue;
    if (settings.obstacle)
      zones.push_back(contact::make_zone(
          mesh, settings, contact::make_obstacle(*settings.obstacle, study.physics, study.functions),
          std::move(slave), excluded, geometry));
    else
      zones.push_back(
          contact::make_zone(mesh, settings, std::move(master), std::move(slave), excluded, geometry));
  }
  return zones;
}

} // namespace rubato::model
