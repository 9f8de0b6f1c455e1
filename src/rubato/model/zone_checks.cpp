// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/zone_checks.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/contact/integration.hpp"
#include "rubato/contact/tie.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/study/contact_methods.hpp"
#include "rubato/study/fields.hpp"
#include "rubato/study/schemes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <span>
#include <vector>

namespace rubato::model {
namespace {

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

Fault overlap_at_start(const contact::Zone& zone, const contact::SlavePoint& point, double overlap,
                       const study::TimeStepping& time) {
  const auto is_overlap = [](const auto& term) { return term.sense == contact::GapOffset::Sense::overlaps; };
  const auto& path = std::ranges::find_if(zone.offset.terms, is_overlap)->length.path;
  const std::span<const double, 3> place(point.place.data(), 3);
  return fault_at(
      path, fmt::format("{}: found {} at {}, the first instant, but the scheme {} leaves overlaps of "
                        "the start as they are, expected 0 there",
                        path, overlap, shown_place(place, time.begin), study::entry_of(time.scheme).name));
}

} // namespace

Mention mention_of(const study::ContactZone& settings, const std::string& surface, std::string_view side) {
  const auto path = "contact." + settings.name;
  if (!settings.self.empty())
    return {surface, path + ".self"};
  for (std::size_t i = 0; i < settings.between.size(); ++i)
    if (settings.between[i] == surface)
      return {surface, fmt::format("{}.between.{}", path, i)};
  return {surface, fmt::format("{}.{}", path, side)};
}

Mention slave_of(const study::ContactZone& settings) {
  return mention_of(settings, settings.slave, "slave");
}

Mention master_of(const study::ContactZone& settings) {
  return mention_of(settings, settings.master, "master");
}

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

void check_edges(const contact::Zone& zone, const mesh::Mesh& mesh, std::vector<Fault>& faults) {
  const auto cells = contact::sharp_slave_edge(zone);
  if (!cells)
    return;
  faults.push_back(fault_at(slave_of(zone.settings).path,
                            fmt::format("{} and {} of slave '{}' make an edge of more than 60 degrees, "
                                        "whose nodes a tie cannot hold on both sides; expected a tie for "
                                        "each side of it",
                                        domain::cell_label(mesh, (*cells)[0]),
                                        domain::cell_label(mesh, (*cells)[1]), zone.settings.slave)));
}

void check_offset(const contact::Zone& zone, const study::TimeStepping& time, std::vector<Fault>& faults) {
  if (zone.offset.terms.empty())
    return;
  const bool keeps_overlaps = study::has_jumps(time.scheme);
  try {
    for (const auto& point : zone.points) {
      zone.offset.at(point.place, time.begin);
      if (const double overlap = zone.offset.overlap_at(point.place, time.begin);
          keeps_overlaps && overlap != 0) {
        faults.push_back(overlap_at_start(zone, point, overlap, time));
        return;
      }
      zone.offset.at(point.place, time.end);
    }
  } catch (const InputError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
}

std::vector<double> friction_shares(const contact::Zone& zone, const std::string& path,
                                    std::vector<Fault>& faults) {
  std::vector<double> shares;
  if (!zone.settings.friction_in_place)
    return shares;
  const auto friction = study::field_function(*zone.settings.friction_in_place, {}, {}, path);
  try {
    for (const auto& point : zone.points) {
      const std::span<const double, 3> place(point.place.data(), 3);
      shares.push_back(friction.at(place, zone.begin));
      if (shares.back() < 0)
        throw InputError({fault_at(path, fmt::format("{}: found {:.6g} at {}, expected a number >= 0", path,
                                                     shares.back(), shown_place(place, zone.begin)))});
    }
  } catch (const InputError& error) {
    faults.insert(faults.end(), error.faults().begin(), error.faults().end());
  }
  return shares;
}

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

} // namespace rubato::model
