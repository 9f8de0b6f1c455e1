// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/explicit/tie_forces.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/tie.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <cmath>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// The force of the master on each tied point of one zone after the other: equations have the multipliers in
/// this order.
std::vector<std::vector<Vector3d>> forces_on_slaves(std::span<const TiedZone> ties,
                                                    const VectorXd& multipliers) {
  std::vector<std::vector<Vector3d>> forces;
  Index next = 0;
  for (const auto& tie : ties) {
    auto& of_zone = forces.emplace_back(tie.points.size(), Vector3d::Zero());
    contact::for_each_relation(tie.points, [&](std::size_t point, int component) {
      of_zone[point][component] = multipliers[next++];
    });
  }
  return forces;
}

/// Of a point's node in the nodes of the slave surface.
std::size_t position_of(const contact::Zone& zone, std::size_t point) {
  return zone.mortar ? point : static_cast<std::size_t>(zone.points[point].node_position);
}

/// Multipliers are tractions along the axes, as in implicit steps.
contact::ZoneState state_of_tie(const contact::Zone& zone, const TiedZone& tie,
                                const std::vector<Vector3d>& forces) {
  auto state = contact::initial_state(zone);
  state.outcomes.assign(tie.points.size(), {});
  for (std::size_t i = 0; i < tie.points.size(); ++i) {
    auto& outcome = state.outcomes[i];
    const auto& kinematics = tie.points[i].kinematics;
    if (!kinematics) {
      outcome.gap = INFINITY;
      state.status[i] = contact::Status::open;
      continue;
    }
    state.status[i] = contact::Status::stick;
    const double normal = contact::dot(forces[i], kinematics->facing);
    const auto first = static_cast<Index>(position_of(zone, i)) * zone.multipliers_per_node();
    const double weight = contact::weight_of(zone.points[i], tie.points[i]);
    for (int c = 0; c < zone.multipliers_per_node() && weight > 0; ++c)
      state.multipliers[first + c] = forces[i][c] / weight;
    outcome.area = zone.points[i].area * tie.points[i].cover;
    outcome.pressure = outcome.area > 0 ? normal / outcome.area : 0;
    outcome.normal = contact::scaled(normal, kinematics->facing);
    outcome.tangential = contact::difference_of(forces[i], outcome.normal);
  }
  return state;
}

} // namespace

std::vector<TiedZone> tied_zones(const model::Model& model) {
  std::vector<TiedZone> ties;
  const VectorXd rest = VectorXd::Zero(static_cast<Index>(model.dofs.dof_count));
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (const auto& zone = model.zones[z]; zone.settings.tie)
      ties.push_back(
          {z, contact::tied_points(zone, {&model.mesh, &model.dofs, &rest, &rest, zone.begin, zone.begin})});
  return ties;
}

std::vector<contact::ZoneState> states_of_ties(const model::Model& model, std::span<const TiedZone> ties,
                                               const VectorXd& multipliers) {
  const auto forces = forces_on_slaves(ties, multipliers);
  std::vector<contact::ZoneState> states;
  for (std::size_t i = 0; i < ties.size(); ++i)
    states.push_back(state_of_tie(model.zones[ties[i].zone], ties[i], forces[i]));
  return states;
}

VectorXd forces_of_ties(const model::Model& model, std::span<const TiedZone> ties,
                        const VectorXd& multipliers) {
  const auto forces = forces_on_slaves(ties, multipliers);
  VectorXd internal = VectorXd::Zero(static_cast<Index>(model.dofs.dof_count));
  for (std::size_t i = 0; i < ties.size(); ++i)
    for (std::size_t p = 0; p < ties[i].points.size(); ++p)
      if (const auto& kinematics = ties[i].points[p].kinematics)
        kinematics->stencil.scatter(contact::scaled(-1, forces[i][p]), model.dofs, internal);
  return internal;
}

} // namespace rubato::step
