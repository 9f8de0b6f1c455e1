// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rubato::model {
namespace {

contact::Face face_of(const mesh::SurfaceFace& side) {
  contact::Face face;
  face.type = side.type;
  face.node_count = static_cast<int>(side.nodes().size());
  std::ranges::copy(side.nodes(), face.nodes.begin());
  face.cell = side.face;
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
  std::ranges::transform(oriented.faces, std::back_inserter(faces), face_of);
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
    auto master = surface_named(mesh, settings.master, faults);
    auto slave = surface_named(mesh, settings.slave, faults);
    const auto excluded = excluded_nodes(mesh, settings, faults);
    if (faults.size() == known && share_a_face(master, slave))
      faults.push_back(
          {settings.slave.at, fmt::format("master '{}' and slave '{}' share faces, expected two surfaces",
                                          settings.master.text, settings.slave.text)});
    check_rule(settings, slave, faults);
    if (faults.size() == known)
      zones.push_back(
          contact::make_zone(mesh, settings, std::move(master), std::move(slave), excluded, geometry));
  }
  return zones;
}

} // namespace rubato::model
