// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/integration.hpp"
#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/naming.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/named_faces.hpp"
#include "rubato/model/rotations.hpp"
#include "rubato/model/slave_side.hpp"
#include "rubato/model/touching_parts.hpp"
#include "rubato/model/zone_checks.hpp"
#include "rubato/study/contact_methods.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace rubato::model {
namespace {

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
      const double distance =
          contact::length_of(contact::difference_of(mesh::centre_of(mesh, sheets.faces[f]), centre));
      if (distance < seen[s].distance)
        seen[s] = {distance, contact::dot(contact::unit_of(mesh::normal_of(mesh, sheets.faces[f])), normal)};
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

/// A zone as it is made: its master and slave have names, and why.
struct ChosenZone {
  study::ContactZone settings;
  contact::Surface master;
  contact::Surface slave;
  std::string choice;
};

/// Makes the zones of a study. Faults are those of all of them.
class ZoneMaker {
public:
  ZoneMaker(const study::Study& study, const mesh::Mesh& mesh, const domain::Bulk& bulk,
            const domain::DofMap& dofs, const constraint::Reduction& reduction, std::vector<Fault>& faults)
      : study_(study), mesh_(mesh), bulk_(bulk), dofs_(dofs), reduction_(reduction), faults_(faults) {}

  std::vector<contact::Zone> make() {
    for (const auto& settings : study_.contact) {
      known_faults_ = faults_.size();
      at_hand_ = settings.name;
      for (auto& chosen : chosen_zones(settings))
        add(std::move(chosen));
    }
    contact::join_shared_points(zones_);
    return std::move(zones_);
  }

private:
  std::vector<ChosenZone> chosen_zones(const study::ContactZone& settings) {
    if (settings.all)
      return zones_between_bodies(settings);
    if (!settings.between.empty())
      return {given_zone(with_sides(settings))};
    if (!settings.self.empty())
      return {self_zone(settings)};
    return {given_zone({settings, {}, {}, {}})};
  }

  const SideMeasures& measures() {
    if (!measures_)
      measures_.emplace(mesh_, bulk_, dofs_, reduction_);
    return *measures_;
  }

  SideMeasures::Side measured(const NamedFaces& faces) {
    auto all = faces.sides;
    all.insert(all.end(), faces.sheets.faces.begin(), faces.sheets.faces.end());
    return measures().of(all);
  }

  /// Names the master and the slave of a zone that has two surfaces.
  ChosenZone with_sides(const study::ContactZone& settings) {
    ChosenZone zone{settings, {}, {}, {}};
    std::vector<SideMeasures::Side> sides;
    std::vector<Fault> unnamed;
    for (const auto& name : settings.between)
      if (const auto faces = faces_named(mesh_, mention_of(settings, name, {}), true, unnamed))
        sides.push_back(measured(*faces));
    const auto choice = sides.size() == 2 ? choose_slave(sides[0], sides[1]) : SlaveChoice{};
    zone.settings.slave = settings.between[choice.slave];
    zone.settings.master = settings.between[1 - choice.slave];
    zone.choice = choice.reason;
    return zone;
  }

  ChosenZone given_zone(ChosenZone zone) {
    const auto& settings = zone.settings;
    const auto slave = faces_named(mesh_, slave_of(settings), false, faults_);
    if (settings.obstacle) {
      zone.slave = slave ? surface_of(mesh_, slave->sides) : contact::Surface();
      return zone;
    }
    auto master = faces_named(mesh_, master_of(settings), true, faults_);
    if (!master || !slave)
      return zone;
    check_sheets(mesh_, master_of(settings), master->sheets, dofs_, reduction_, faults_);
    turn_to_slave(mesh_, slave->sides, master->sheets);
    master->sides.insert(master->sides.end(), master->sheets.faces.begin(), master->sheets.faces.end());
    zone.master = surface_of(mesh_, master->sides);
    zone.slave = surface_of(mesh_, slave->sides);
    return zone;
  }

  /// Master and slave are the same faces.
  ChosenZone self_zone(const study::ContactZone& settings) {
    ChosenZone zone{settings, {}, {}, {}};
    zone.settings.master = zone.settings.slave = settings.self;
    if (const auto faces = faces_named(mesh_, slave_of(zone.settings), false, faults_)) {
      zone.slave = zone.master = surface_of(mesh_, faces->sides);
      if (!can_meet_itself(mesh_, faces->sides))
        faults_.push_back(
            fault_at(slave_of(zone.settings).path,
                     fmt::format("found '{}', no two faces of which can come to face each other, "
                                 "expected a surface that can touch itself",
                                 settings.self)));
    }
    return zone;
  }

  std::vector<ChosenZone> zones_between_bodies(const study::ContactZone& settings) {
    const auto touching = touching_parts(mesh_, bulk_, measures());
    if (touching.empty())
      faults_.push_back(fault_at("contact." + settings.name + ".all",
                                 "no two bodies of the mesh have surfaces that face each other, expected two "
                                 "bodies at least; 'self' is for one that touches itself"));
    std::vector<ChosenZone> zones;
    for (const auto& pair : touching) {
      ChosenZone zone{settings, surface_of(mesh_, pair.master), surface_of(mesh_, pair.slave), pair.choice};
      zone.settings.name = settings.name + "_" + pair.name;
      zone.settings.master = pair.master_name;
      zone.settings.slave = pair.slave_name;
      zones.push_back(std::move(zone));
    }
    return zones;
  }

  /// Names of zones that the model finds are its own choice.
  void check_name(const std::string& name) {
    const auto is_same = [&](const auto& zone) { return zone.settings.name == name; };
    if (!is_name(name) || std::ranges::any_of(zones_, is_same))
      faults_.push_back(
          fault_at("contact", fmt::format("found two zones named {}, one of them of 'all', or a "
                                          "name that is too long; expected other names",
                                          shown(name))));
  }

  void check_apart(const ChosenZone& zone) {
    if (zone.settings.self.empty() && !zone.settings.all && share_a_face(zone.master, zone.slave))
      faults_.push_back(fault_at(slave_of(zone.settings).path,
                                 fmt::format("master '{}' and slave '{}' share faces, expected two surfaces",
                                             zone.settings.master, zone.settings.slave)));
  }

  void add(ChosenZone chosen) {
    const auto& settings = chosen.settings;
    const auto excluded = excluded_nodes(mesh_, settings, faults_);
    if (faults_.size() == known_faults_)
      check_apart(chosen);
    check_name(settings.name);
    check_rule(settings, chosen.slave, faults_);
    if (faults_.size() > known_faults_)
      return;
    const auto geometry = zone_geometry();
    if (settings.obstacle)
      zones_.push_back(contact::make_zone(mesh_, settings, obstacle_of(*settings.obstacle),
                                          std::move(chosen.slave), excluded, geometry));
    else
      zones_.push_back(contact::make_zone(mesh_, settings, std::move(chosen.master), std::move(chosen.slave),
                                          excluded, geometry));
    complete(zones_.back(), std::move(chosen.choice));
  }

  contact::Obstacle obstacle_of(const study::Obstacle& given) {
    auto obstacle = contact::make_obstacle(given, study_.physics, study_.functions);
    if (given.rotate)
      try {
        const auto path = fmt::format("contact.{}.obstacle.rotate", at_hand_);
        obstacle.rotation = *shared_rotation({study_, mesh_, dofs_, {}}, *given.rotate, path);
      } catch (const InputError& error) {
        std::ranges::copy(error.faults(), std::back_inserter(faults_));
      }
    return obstacle;
  }

  void complete(contact::Zone& zone, std::string choice) {
    check_edges(zone, mesh_, faults_);
    zone.offset = contact::make_gap_offset(zone.settings, study_.functions, "contact." + at_hand_);
    check_offset(zone, study_.time, faults_);
    zone.friction_shares = friction_shares(zone, "contact." + at_hand_ + ".friction", faults_);
    zone.begin = study_.time.begin;
    zone.finite_rotations = zone.settings.tie && study::takes_large_rotations(study_);
    zone.held = held_components(zone.slave, dofs_, reduction_);
    zone.choice = std::move(choice);
    if (zone.settings.tie)
      check_tie(zone, mesh_, dofs_, reduction_, faults_);
  }

  contact::ZoneGeometry zone_geometry() const {
    const bool plane =
        study_.physics == study::Physics::plane_stress || study_.physics == study::Physics::plane_strain;
    return {dofs_.components, plane ? study_.thickness : 1.0,
            study_.physics == study::Physics::axisymmetric ? contact::Measure::ring : contact::Measure::unit};
  }

  const study::Study& study_;
  const mesh::Mesh& mesh_;
  const domain::Bulk& bulk_;
  const domain::DofMap& dofs_;
  const constraint::Reduction& reduction_;
  std::vector<Fault>& faults_;
  std::optional<SideMeasures> measures_;
  std::size_t known_faults_ = 0; ///< before the zone at hand
  std::string at_hand_;          ///< its name in the study: those of 'all' have others
  std::vector<contact::Zone> zones_;
};

/// The groups that may be a zone's master.
std::vector<std::string> masters_named(const study::ContactZone& settings) {
  if (settings.obstacle || settings.all || !settings.self.empty())
    return {};
  return settings.between.empty() ? std::vector{settings.master} : settings.between;
}

} // namespace

std::vector<mesh::CellIndex> rigid_faces(const study::Study& study, const mesh::Mesh& mesh) {
  std::vector<mesh::CellIndex> faces;
  for (const auto& settings : study.contact)
    for (const auto& name : masters_named(settings))
      if (const auto* group = mesh.cell_group(name)) {
        const auto unowned = mesh::oriented_faces(mesh, group->items).unowned;
        faces.insert(faces.end(), unowned.begin(), unowned.end());
      }
  return faces;
}

std::vector<contact::Zone> make_zones(const study::Study& study, const mesh::Mesh& mesh,
                                      const domain::Bulk& bulk, const domain::DofMap& dofs,
                                      const constraint::Reduction& reduction, std::vector<Fault>& faults) {
  return ZoneMaker(study, mesh, bulk, dofs, reduction, faults).make();
}

std::vector<std::string> chosen_sides(std::span<const contact::Zone> zones) {
  std::vector<std::string> sentences;
  for (const auto& zone : zones)
    if (!zone.choice.empty())
      sentences.push_back(
          fmt::format("contact zone {}: '{}' ({} faces) is the slave of '{}' ({} faces), because {}",
                      zone.settings.name, zone.settings.slave, zone.slave.faces.size(), zone.settings.master,
                      zone.master.faces.size(), zone.choice));
  return sentences;
}

} // namespace rubato::model
