// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/rigid_sides.hpp"

#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
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

namespace {

/// By unknown: whether it moves a node that keeps its mass.
std::vector<char> massive_unknowns(const Model& model, const std::vector<char>& is_massless) {
  std::vector<char> massive(static_cast<std::size_t>(model.reduction.unknown_count()), 0);
  for (const auto node : model.dofs.nodes)
    if (is_massless[static_cast<std::size_t>(node)] == 0)
      for (int i = 0; i < model.dofs.components; ++i)
        model.reduction.for_each_unknown(model.dofs.dof(node, i), [&](int unknown, double) {
          massive[static_cast<std::size_t>(unknown)] = 1;
        });
  return massive;
}

} // namespace

void check_massless_slaves(const Model& model, std::vector<Fault>& faults) {
  if (model.study.time.contact_mass != study::ContactMass::redistributed ||
      model.reduction.dependents().empty())
    return;
  std::vector<char> is_massless(model.mesh.points.size(), 0);
  for (const auto& zone : model.zones)
    if (!zone.settings.tie)
      for (const auto node : zone.slave.nodes)
        is_massless[static_cast<std::size_t>(node)] = 1;
  const auto massive = massive_unknowns(model, is_massless);
  const auto has_mass = [&](mesh::NodeIndex node) {
    bool found = false;
    for (int i = 0; i < model.dofs.components; ++i)
      model.reduction.for_each_unknown(model.dofs.dof(node, i), [&](int unknown, double) {
        found = found || massive[static_cast<std::size_t>(unknown)] != 0;
      });
    return found;
  };
  for (const auto& zone : model.zones)
    if (const auto node = std::ranges::find_if(zone.slave.nodes, has_mass);
        !zone.settings.tie && node != zone.slave.nodes.end())
      faults.push_back(fault_at(
          "contact." + zone.settings.name,
          fmt::format("node {} of the slave '{}' moves by a relation with nodes that have mass, which "
                      "contact_mass: redistributed (the default of moreau_jean and energy_momentum) cannot "
                      "take off it; expected "
                      "time: {{contact_mass: consistent}}, or this side as the master",
                      node_label(model.mesh, *node), zone.settings.slave)));
}

} // namespace rubato::model
