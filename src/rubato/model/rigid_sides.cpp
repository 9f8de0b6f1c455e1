// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/rigid_sides.hpp"

#include <fmt/format.h>

#include <set>

namespace rubato::model {

bool is_rigid(std::span<const mesh::NodeIndex> nodes, const domain::DofMap& dofs,
              const constraint::Reduction& reduction) {
  if (reduction.dependents().empty())
    return false;
  const std::size_t motions = dofs.components == 3 ? 6 : 3;
  std::set<int> unknowns;
  bool related = false;
  for (const auto node : nodes)
    for (int i = 0; i < dofs.components; ++i) {
      const int dof = dofs.dof(node, i);
      related = related || (reduction.unknown_of(dof) < 0 && !reduction.is_prescribed(dof));
      reduction.for_each_unknown(dof, [&](int unknown, double) { unknowns.insert(unknown); });
      if (unknowns.size() > motions)
        return false;
    }
  return related;
}

std::vector<std::string> notes_on_rigid_slaves(const Model& model) {
  std::vector<std::string> notes;
  for (const auto& zone : model.zones)
    if (!zone.obstacle && is_rigid(zone.slave.nodes, model.dofs, model.reduction) &&
        !is_rigid(zone.master.nodes, model.dofs, model.reduction))
      notes.push_back(
          fmt::format("contact zone '{}': a relation makes its slave '{}' rigid; its pressures are not "
                      "unique where its faces are finer than the master's: 'master: {}, slave: {}' "
                      "gives them to the side that deforms",
                      zone.settings.name, zone.settings.slave, zone.settings.slave, zone.settings.master));
  return notes;
}

} // namespace rubato::model
