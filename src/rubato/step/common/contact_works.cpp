// SPDX-License-Identifier: LGPL-3.0-or-later
// What contact forces did in a step, point by point: works of obstacles that move, and of friction.
#include "rubato/model/model.hpp"
#include "rubato/step/common/contact_evaluator.hpp"

namespace rubato::step {
namespace {

using contact::PointEvaluation;
using contact::Status;

} // namespace

/// Of an obstacle that rotates: [o]·{p} of the forces that it pushes the bodies with, o its way at the
/// points, as their forces at that end of the step were spread; [o]·p₁ where p₁ is the mean over the step.
void ContactEvaluator::add_obstacle_work(std::size_t z, std::span<const PointEvaluation> points,
                                         State& trial) const {
  auto& now = trial.zones[z];
  now.pressing_forces.clear();
  now.obstacle_work = {};
  // Of one that is only translated the ledger multiplies the sum of its forces.
  if (const auto& obstacle = model_.zones[z].obstacle; !obstacle || !obstacle->rotation)
    return;
  const auto& before = committed_.zones[z];
  const bool mean_force = !frames_.empty();
  if (!mean_force)
    now.obstacle_work = {0.5 * work_by_way(z, before.pressing_forces, trial),
                         0.5 * work_by_way(z, before.friction_forces, trial)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& outcome = now.outcomes[i];
    if (outcome.normal.isZero(0))
      continue;
    const auto& k = *points[i].kinematics;
    const double part = mean_force ? 1.0 : 0.5;
    now.obstacle_work.normal += part * k.obstacle_displacement.dot(outcome.normal);
    now.obstacle_work.tangential += part * k.obstacle_displacement.dot(outcome.tangential);
    now.pressing_forces.add(i, outcome.normal, k.stencil);
  }
}

double ContactEvaluator::work_by_way(std::size_t z, const contact::PointForces& forces,
                                     const State& trial) const {
  double work = 0;
  for (std::size_t e = 0; e < forces.count(); ++e)
    work += forces.force(e).dot(way_of_obstacle(z, forces, e, trial));
  return work;
}

/// Under the place that an earlier force stood at.
Eigen::Vector3d ContactEvaluator::way_of_obstacle(std::size_t z, const contact::PointForces& forces,
                                                  std::size_t entry, const State& trial) const {
  const auto& obstacle = model_.zones[z].obstacle;
  if (!obstacle)
    return Eigen::Vector3d::Zero();
  const auto configuration = at_end(trial);
  return obstacle->way(forces.sum(entry, [&](auto node) { return configuration.start_position(node); }),
                       forces.sum(entry, [&](auto node) { return configuration.position(node); }),
                       configuration.start_t, configuration.t);
}

/// Works are those that the energy ledger counts, [r]·{τ} with r the motion of a point relative to the place
/// it faces, as its force at that end of the step was spread; [r]·τ₁ where τ₁ is the mean over the step.
void ContactEvaluator::add_friction_history(std::size_t z, std::span<const PointEvaluation> points,
                                            State& trial) const {
  const auto& zone = model_.zones[z];
  const auto& before = committed_.zones[z];
  auto& now = trial.zones[z];
  auto& history = now.friction_history;
  history = before.friction_history;
  history.resize(points.size());
  now.friction_forces.clear();
  if (zone.settings.tie)
    return;
  const auto configuration = at_end(trial);
  const auto increment = [&](mesh::NodeIndex node) { return configuration.increment(node); };
  const bool mean_force = !frames_.empty();
  const auto& earlier = before.friction_forces;
  for (std::size_t e = 0; !mean_force && e < earlier.count(); ++e)
    history[earlier.point(e)].work -=
        0.5 * earlier.force(e).dot(earlier.sum(e, increment) - way_of_obstacle(z, earlier, e, trial));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& outcome = now.outcomes[i];
    if (now.status[i] != Status::open)
      history[i].slip += outcome.slip.norm();
    if (outcome.tangential.isZero(0))
      continue;
    const auto& k = *points[i].kinematics;
    history[i].work -=
        (mean_force ? 1.0 : 0.5) * outcome.tangential.dot(k.stencil.sum(increment) - k.obstacle_displacement);
    now.friction_forces.add(i, outcome.tangential, k.stencil);
  }
}

} // namespace rubato::step
