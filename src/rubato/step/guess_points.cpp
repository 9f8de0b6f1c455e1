// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/guess_points.hpp"

#include <algorithm>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// A friction force this little below its limit, relatively, is at it.
constexpr double rounding = 1e-9;

void set_relations(const Model& model, const Compliance& compliance, const contact::Kinematics& k,
                   const VectorXd& moved, GuessPoint& guess) {
  const auto& position = compliance.position_of_dof();
  guess.frame << k.normal, k.tangents;
  guess.shares.clear();
  Eigen::Vector3d come = Eigen::Vector3d::Zero();
  for (std::size_t node = 0; node < k.nodes.size(); ++node) {
    const double weight = k.shape[static_cast<Index>(node)];
    for (int i = 0; weight != 0 && i < k.components; ++i) {
      const int at = position[static_cast<std::size_t>(model.dofs.dof(k.nodes[node], i))];
      if (at < 0)
        continue;
      guess.shares.push_back({at, i, weight});
      come[i] += weight * moved[at];
    }
  }
  guess.value << k.gap, k.slip;
  guess.value -= guess.frame.transpose() * come;
}

void set_forces(const contact::PointOutcome& outcome, const contact::SlavePoint& point,
                const contact::Kinematics& k, GuessPoint& guess) {
  guess.force.setZero();
  guess.force[0] = std::max(0.0, outcome.pressure * point.area);
  for (int a = 0; a + 1 < k.components; ++a)
    guess.force[1 + a] = outcome.tangential.dot(k.tangents.col(a));
}

} // namespace

bool measure_points(const Model& model, const ContactSide& side, const Held& held,
                    const Compliance& compliance, const ContactIterate& contact, const VectorXd& moved,
                    const State& state, GuessForces forces, std::vector<GuessPoint>& points) {
  std::size_t count = 0;
  bool same = true;
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const auto law = side.law_of(z, held);
    const bool soft = !contact::is_exact(zone.settings.method);
    for (std::size_t i = 0; held[z].status.empty() && i < zone.points.size(); ++i) {
      const auto& kinematics = contact.points[z][i].kinematics;
      if (!kinematics || zone.points[i].excluded)
        continue;
      const bool known = count < points.size() && points[count].zone == z && points[count].index == i;
      same = same && known;
      if (count == points.size())
        points.emplace_back();
      auto& guess = points[count++];
      guess.zone = z;
      guess.index = i;
      guess.friction = law.friction;
      guess.softness = soft ? 1 / (law.coefficients->normal[i] * zone.points[i].weight) : 0.0;
      set_relations(model, compliance, *kinematics, moved, guess);
      if (!known || forces == GuessForces::of_last_step)
        set_forces(state.zones[z].outcomes[i], zone.points[i], *kinematics, guess);
    }
  }
  same = same && count == points.size();
  points.resize(count);
  return same;
}

VectorXd force_on_surface(std::span<const GuessPoint> points, Index positions) {
  VectorXd force = VectorXd::Zero(positions);
  add_force(points, 0, 2, force);
  return -force;
}

void take_guess(const Model& model, std::span<const GuessPoint> points, State& state) {
  for (const auto& guess : points) {
    const auto& zone = model.zones[guess.zone];
    const auto& point = zone.points[guess.index];
    auto& of_zone = state.zones[guess.zone];
    const double limit = guess.friction * guess.force[0];
    const Eigen::Vector2d friction = guess.force.tail<2>();
    const bool sticks = friction.norm() < (1 - rounding) * limit;
    of_zone.status[guess.index] = guess.force[0] == 0 ? Status::open : sticks ? Status::stick : Status::slip;
    const Index count = zone.multipliers_per_node();
    Index next = static_cast<Index>(point.node_position) * count;
    for (const int variable : zone.multiplier_variables())
      of_zone.multipliers[next++] = variable == 0 ? guess.force[0] / point.weight
                                    : limit > 0   ? -friction[variable - 1] / limit
                                                  : 0.0;
  }
}

} // namespace rubato::step
