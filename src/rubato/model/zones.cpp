// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/integration.hpp"
#include "rubato/contact/tie.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"
#include "rubato/study/contact_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
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
  if (mesh.type_of(side.face) != side.type)
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

contact::Surface surface_of(const mesh::Mesh& mesh, std::span<const mesh::SurfaceFace> sides) {
  std::vector<contact::Face> faces;
  std::ranges::transform(sides, std::back_inserter(faces),
                         [&](const auto& side) { return face_of(mesh, side); });
  return contact::make_surface(mesh, std::move(faces));
}

/// Sides of cells with their outward normals, and sheets, for those who take them.
struct NamedFaces {
  std::vector<mesh::SurfaceFace> sides;
  mesh::Sheets sheets;
};

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

/// Slave faces as near as this, in parts of the nearest one's distance and of its size, tell on which side of
/// a sheet the slave is.
constexpr double about_nearest = 1.5;

/// Whether a sheet's normals look away from the slave: along the slave's own normals, where it is nearest.
bool looks_away(const mesh::Mesh& mesh, const mesh::Sheets& sheets, int sheet,
                std::span<const mesh::SurfaceFace> slave) {
  struct Seen {
    double distance = std::numeric_limits<double>::infinity();
    double along = 0;
  };
  std::vector<Seen> seen(slave.size());
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < slave.size(); ++s) {
    const auto centre = mesh::centre_of(mesh, slave[s]);
    const auto normal = mesh::normal_of(mesh, slave[s]);
    for (std::size_t f = 0; f < sheets.faces.size(); ++f) {
      if (sheets.sheet_of_face[f] != sheet)
        continue;
      const double distance = (mesh::centre_of(mesh, sheets.faces[f]) - centre).norm();
      if (distance < seen[s].distance)
        seen[s] = {distance, mesh::normal_of(mesh, sheets.faces[f]).normalized().dot(normal)};
    }
    nearest = std::min(nearest, seen[s].distance);
  }
  double along = 0;
  for (const auto& at : seen)
    if (at.distance <= about_nearest * nearest)
      along += at.along;
  return along > 0;
}

/// Sheets turned towards the slave.
void turn_to_slave(const mesh::Mesh& mesh, std::span<const mesh::SurfaceFace> slave, mesh::Sheets& sheets) {
  for (int sheet = 0; sheet < sheets.count; ++sheet)
    if (looks_away(mesh, sheets, sheet, slave))
      for (std::size_t f = 0; f < sheets.faces.size(); ++f)
        if (sheets.sheet_of_face[f] == sheet)
          mesh::turn(sheets.faces[f]);
}

/// Nothing but supports moves the nodes of a sheet.
void check_sheets(const mesh::Mesh& mesh, const Mention& name, const mesh::Sheets& sheets,
                  const domain::DofMap& dofs, const constraint::Reduction& reduction,
                  std::vector<Fault>& faults) {
  for (const auto& face : sheets.faces)
    for (const auto node : face.nodes())
      for (int i = 0; i < dofs.components; ++i)
        if (!reduction.is_prescribed(dofs.dof(node, i))) {
          faults.push_back(fault_at(
              name.path, fmt::format("contact surface '{}': {} of its faces bound no cell, and nothing holds "
                                     "node {} of them along {}; expected supports that hold or move every "
                                     "component of a surface without cells behind it",
                                     name.name, sheets.faces.size(), node_label(mesh, node),
                                     "xyz"[static_cast<std::size_t>(i)])));
          return;
        }
}

bool share_a_face(const contact::Surface& a, const contact::Surface& b) {
  std::vector<mesh::CellIndex> cells;
  for (const auto& face : a.faces)
    cells.push_back(face.cell);
  std::ranges::sort(cells);
  return std::ranges::any_of(b.faces,
                             [&](const auto& face) { return std::ranges::binary_search(cells, face.cell); });
}

std::vector<mesh::NodeIndex> excluded_nodes(const mesh::Mesh& mesh, const study::ContactZone& zone,
                                            std::vector<Fault>& faults) {
  std::vector<mesh::NodeIndex> all;
  for (std::size_t i = 0; i < zone.exclude_nodes.size(); ++i) {
    const auto nodes = nodes_or_fault(
        mesh, {zone.exclude_nodes[i], fmt::format("contact.{}.exclude_nodes.{}", zone.name, i)}, faults);
    all.insert(all.end(), nodes.begin(), nodes.end());
  }
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Supports that hold a component of a node keep its normal across: planes of symmetry have no part in it.
std::vector<contact::mortar::HeldComponents> held_components(const contact::Surface& surface,
                                                             const domain::DofMap& dofs,
                                                             const constraint::Reduction& reduction) {
  std::vector<contact::mortar::HeldComponents> held;
  for (const auto node : surface.nodes) {
    unsigned bits = 0;
    for (int i = 0; i < dofs.components; ++i)
      bits |= reduction.is_prescribed(dofs.dof(node, i)) ? 1U << static_cast<unsigned>(i) : 0U;
    held.push_back(static_cast<contact::mortar::HeldComponents>(bits));
  }
  return held;
}

/// With fewer points than the multipliers of a face can tell apart, their equations would be dependent; and a
/// rule that misses the shape functions would hand on no uniform pressure.
void check_rule(const study::ContactZone& zone, const contact::Surface& slave, std::vector<Fault>& faults) {
  std::set<CellType> types;
  for (const auto& face : slave.faces)
    types.insert(face.type);
  for (const auto type : types) {
    const auto least = contact::least_order(zone.integration.by, type);
    if (least && zone.integration.order >= *least)
      continue;
    faults.push_back(
        fault_at("contact." + zone.name,
                 fmt::format("found {{{}: {}}}, expected {} on the {} faces of '{}'",
                             study::entry_of(zone.integration.by).name, zone.integration.order,
                             least ? fmt::format("at least {}", *least) : std::string("nodes or gauss"),
                             cell::topology(type).name, zone.slave)));
    return;
  }
}

Mention slave_of(const study::ContactZone& settings) {
  return {settings.slave, "contact." + settings.name + ".slave"};
}

Mention master_of(const study::ContactZone& settings) {
  return {settings.master, "contact." + settings.name + ".master"};
}

std::pair<contact::Surface, contact::Surface> surfaces_of(const study::ContactZone& settings,
                                                          const mesh::Mesh& mesh, const domain::DofMap& dofs,
                                                          const constraint::Reduction& reduction,
                                                          std::vector<Fault>& faults) {
  const auto slave = faces_named(mesh, slave_of(settings), false, faults);
  if (settings.obstacle)
    return {contact::Surface(), slave ? surface_of(mesh, slave->sides) : contact::Surface()};
  auto master = faces_named(mesh, master_of(settings), true, faults);
  if (!master || !slave)
    return {};
  check_sheets(mesh, master_of(settings), master->sheets, dofs, reduction, faults);
  turn_to_slave(mesh, slave->sides, master->sheets);
  master->sides.insert(master->sides.end(), master->sheets.faces.begin(), master->sheets.faces.end());
  return {surface_of(mesh, master->sides), surface_of(mesh, slave->sides)};
}

/// A component that supports hold on the whole of the slave, but not of the master: there is nothing that a
/// traction could be a function of.
std::optional<int> held_component(const contact::Zone& zone, const domain::DofMap& dofs,
                                  const constraint::Reduction& reduction) {
  const auto is_held = [&](const contact::Surface& surface, int component) {
    return std::ranges::all_of(surface.nodes,
                               [&](auto node) { return reduction.is_prescribed(dofs.dof(node, component)); });
  };
  for (int c = 0; c < dofs.components; ++c)
    if (is_held(zone.slave, c) && !is_held(zone.master, c))
      return c;
  return std::nullopt;
}

/// A tie has to hold something.
void check_tie(const contact::Zone& zone, const mesh::Mesh& mesh, const domain::DofMap& dofs,
               const constraint::Reduction& reduction, std::vector<Fault>& faults) {
  const auto& settings = zone.settings;
  const auto path = fmt::format("contact.{}.tie", settings.name);
  if (!zone.points_own_multipliers) {
    faults.push_back(fault_at(path, fmt::format("found a tie by nodes, but nodes of '{}' share pressures, "
                                                "expected integration: mortar",
                                                settings.slave)));
    return;
  }
  if (const auto held = held_component(zone, dofs, reduction)) {
    faults.push_back(fault_at(
        path,
        fmt::format("supports hold every node of the slave '{}' along {}, so that nothing is left to tie "
                    "there, expected it as the master",
                    settings.slave, "xyz"[static_cast<std::size_t>(*held)])));
    return;
  }
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs.dof_count));
  const auto points = contact::tied_points(zone, {&mesh, &dofs, &rest, &rest, zone.begin, zone.begin});
  if (std::ranges::none_of(points, [](const auto& point) { return point.kinematics.has_value(); }))
    faults.push_back(fault_at(
        path, fmt::format("nothing of the slave '{}' faces the master '{}' within {:.3g}, the longest of "
                          "its faces, expected surfaces that touch",
                          settings.slave, settings.master,
                          zone.mortar ? zone.mortar->longest_face : zone.slave.longest_edge)));
}

} // namespace

std::vector<mesh::CellIndex> rigid_faces(const study::Study& study, const mesh::Mesh& mesh) {
  std::vector<mesh::CellIndex> faces;
  for (const auto& settings : study.contact)
    if (const auto* group = settings.obstacle ? nullptr : mesh.cell_group(settings.master)) {
      const auto unowned = mesh::oriented_faces(mesh, group->items).unowned;
      faces.insert(faces.end(), unowned.begin(), unowned.end());
    }
  return faces;
}

std::vector<contact::Zone> make_zones(const study::Study& study, const mesh::Mesh& mesh,
                                      const domain::DofMap& dofs, const constraint::Reduction& reduction,
                                      std::vector<Fault>& faults) {
  const bool plane =
      study.physics == study::Physics::plane_stress || study.physics == study::Physics::plane_strain;
  const contact::ZoneGeometry geometry{
      dofs.components, plane ? study.thickness : 1.0,
      study.physics == study::Physics::axisymmetric ? contact::Measure::ring : contact::Measure::unit};
  std::vector<contact::Zone> zones;
  for (const auto& settings : study.contact) {
    const auto known = faults.size();
    auto [master, slave] = surfaces_of(settings, mesh, dofs, reduction, faults);
    const auto excluded = excluded_nodes(mesh, settings, faults);
    if (faults.size() == known && share_a_face(master, slave))
      faults.push_back(fault_at(slave_of(settings).path,
                                fmt::format("master '{}' and slave '{}' share faces, expected two surfaces",
                                            settings.master, settings.slave)));
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
    if (const auto cells = contact::sharp_slave_edge(zones.back()))
      faults.push_back(fault_at(slave_of(settings).path,
                                fmt::format("{} and {} of slave '{}' make an edge of more than 60 degrees, "
                                            "whose nodes have no normal for the integration mortar; expected "
                                            "a zone for each side of it",
                                            domain::cell_label(mesh, (*cells)[0]),
                                            domain::cell_label(mesh, (*cells)[1]), settings.slave)));
    zones.back().offset = contact::make_gap_offset(settings, study.functions);
    zones.back().begin = study.time.begin;
    zones.back().held = held_components(zones.back().slave, dofs, reduction);
    if (settings.tie)
      check_tie(zones.back(), mesh, dofs, reduction, faults);
  }
  return zones;
}

} // namespace rubato::model
