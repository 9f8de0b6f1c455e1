// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/guess_points.hpp"

#include <algorithm>
#include <limits>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// A friction force this little below its limit, relatively, is at it.
constexpr double rounding = 1e-9;
/// Part of its gap that leaves a point without doubt open where frames are held.
constexpr double still_open = 0.5;

void set_relations(const Model& model, const Compliance& compliance, const contact::Kinematics& k,
                   const VectorXd& moved, GuessPoint& guess) {
  const auto& position = compliance.position_of_dof();
  guess.frame << k.normal, k.tangents;
  guess.shares.clear();
  Eigen::Vector3d come = Eigen::Vector3d::Zero();
  for (std::size_t node = 0; node < k.nodes.size(); ++node) {
    Share share{.weight = k.shape[static_cast<Index>(node)]};
    bool free = false;
    for (int c = 0; c < k.components; ++c) {
      const int at = position[static_cast<std::size_t>(model.dofs.dof(k.nodes[node], c))];
      share.positions[static_cast<std::size_t>(c)] = at;
      free = free || at >= 0;
    }
    if (share.weight == 0 || !free)
      continue;
    guess.shares.push_back(share);
    add_moved(share, moved, come);
  }
  guess.gap = k.gap;
  guess.value << k.gap, k.slip;
  guess.value -= guess.frame.transpose() * come;
}

/// Nothing faces it.
void release(GuessPoint& guess) {
  guess.shares.clear();
  guess.value[0] = std::numeric_limits<double>::infinity();
  guess.force.setZero();
}

void set_forces(const contact::PointOutcome& outcome, const contact::SlavePoint& point,
                const contact::Kinematics& k, GuessPoint& guess) {
  guess.force.setZero();
  guess.force[0] = std::max(0.0, outcome.pressure * point.area);
  for (int a = 0; a + 1 < k.components; ++a)
    guess.force[1 + a] = outcome.tangential.dot(k.tangents.col(a));
}

} // namespace

void take_points(const Model& model, const ContactSide& side, const Held& held, const Compliance& compliance,
                 const ContactIterate& contact, const VectorXd& moved, const State& state,
                 std::vector<GuessPoint>& points) {
  std::size_t count = 0;
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const auto law = side.law_of(z, held);
    const bool soft = !contact::is_exact(zone.settings.method);
    for (std::size_t i = 0; held[z].status.empty() && i < zone.points.size(); ++i) {
      const auto& kinematics = contact.points[z][i].kinematics;
      if (!kinematics || zone.points[i].excluded)
        continue;
      if (count == points.size())
        points.emplace_back();
      auto& guess = points[count++];
      guess.zone = z;
      guess.index = i;
      guess.friction = law.friction;
      guess.softness = soft ? 1 / (law.coefficients->normal[i] * zone.points[i].weight) : 0.0;
      set_relations(model, compliance, *kinematics, moved, guess);
      set_forces(state.zones[z].outcomes[i], zone.points[i], *kinematics, guess);
    }
  }
  points.resize(count);
}

void find_touching(std::span<const GuessPoint> points, const VectorXd& d, PointsOfZones& touching) {
  for (auto& of_zone : touching)
    of_zone.clear();
  for (const auto& point : points)
    if (point.force[0] > 0 || measures_of(point, d)[0] <= std::max(0.0, still_open * point.gap))
      touching[point.zone].push_back(point.index);
}

void move_frames(const Model& model, const Compliance& compliance, const ContactIterate& contact,
                 const VectorXd& moved, const PointsOfZones& touching, std::span<GuessPoint> points) {
  auto point = points.begin();
  for (std::size_t z = 0; z < touching.size(); ++z)
    for (const auto index : touching[z]) {
      while (point->zone != z || point->index != index)
        ++point;
      if (const auto& kinematics = contact.points[z][index].kinematics)
        set_relations(model, compliance, *kinematics, moved, *point);
      else
        release(*point);
    }
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
