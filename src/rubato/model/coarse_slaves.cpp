// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/coarse_slaves.hpp"

#include "rubato/cell/topology.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/rigid_sides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::model {
namespace {

/// Distances of nodes on slave and master. At 5/4 a squeezed soft master has half of its force, at 1 all of
/// it.
constexpr double most_ratio = 1.2;

/// The shortest distance of neighbouring nodes on the edges of faces [length].
double distance_of_nodes(const contact::Surface& surface) {
  int order = 1;
  for (const auto& face : surface.faces)
    order = std::max(order, cell::topology(face.type).order);
  return surface.shortest_edge / order;
}

bool is_on_nodes(const contact::Zone& zone) {
  return !zone.mortar && !zone.points.empty() && zone.points.front().node_position >= 0;
}

bool deforms(const Model& model, const contact::Surface& surface) {
  const auto moves = [&](auto node) {
    for (int i = 0; i < model.dofs.components; ++i)
      if (!model.reduction.is_prescribed(model.dofs.dof(node, i)))
        return true;
    return false;
  };
  return std::ranges::any_of(surface.nodes, moves) && !is_rigid(surface.nodes, model.dofs, model.reduction);
}

} // namespace

std::vector<std::string> notes_on_coarse_slaves(const Model& model) {
  std::vector<std::string> notes;
  for (const auto& zone : model.zones) {
    if (zone.obstacle || zone.meets_itself() || !is_on_nodes(zone) || !deforms(model, zone.master))
      continue;
    const double slave = distance_of_nodes(zone.slave), master = distance_of_nodes(zone.master);
    if (slave > most_ratio * master)
      notes.push_back(fmt::format(
          "contact zone '{}': nodes of its slave '{}' are {:.4g} apart, those of its master {:.4g}; by nodes "
          "the master may bulge between them, and forces be too small: expected 'slave: {}, master: {}', or "
          "'integration: mortar'",
          zone.settings.name, zone.settings.slave, slave, master, zone.settings.master, zone.settings.slave));
  }
  return notes;
}

} // namespace rubato::model
