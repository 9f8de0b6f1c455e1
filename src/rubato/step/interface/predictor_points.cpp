// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/predictor_points.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/contact_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// A friction force this little below its limit, relatively, is at it.
constexpr double nearly_at_limit = 1e-9;
/// Where gaps close on average, more points than the surface has motions share each node: what keeps the
/// forces of points unique, in parts of what the nodes give.
constexpr double averaged_compliance = 0.1;
/// The same of friction: more would let points that stick slip.
constexpr double averaged_friction_compliance = 0.01;
/// Part of its gap that leaves a point without doubt open where frames are frozen.
constexpr double still_open = 0.5;

void set_relations(const Model& model, const Compliance& compliance, const contact::Kinematics& k,
                   const VectorXd& moved, PredictorPoint& predicted) {
  std::copy_n(k.normal.data(), 3, predicted.frame.data());
  for (Index a = 0; a < 2; ++a)
    for (Index c = 0; c < 3; ++c)
      predicted.frame(c, 1 + a) = k.tangents(c, a);
  predicted.stencil.take(k.stencil, model.dofs, compliance.interface_dof_of_dof());
  predicted.gap = k.gap - predicted.rest_gap;
  const Eigen::Vector3d at = predicted.stencil.gather(moved);
  for (Index a = 0; a < 3; ++a) {
    const double* const axis = &predicted.frame(0, a);
    predicted.value[a] =
        (a == 0 ? predicted.gap : k.slip[a - 1]) - (axis[0] * at[0] + axis[1] * at[1] + axis[2] * at[2]);
  }
}

/// Takes the normal spring of a point as it is at the force predicted so far.
void follow_spring(const contact::ZoneLaw& law, const contact::PointEvaluation& evaluation,
                   PredictorPoint& predicted) {
  predicted.weight = contact::weight_of(law.zone->points[predicted.index], evaluation);
  const auto spring = contact::penetration(law, predicted.index, predicted.weight, predicted.force[0],
                                           evaluation.kinematics->gap, predicted.averaged_compliance);
  predicted.rest_gap = spring.rest_gap;
  predicted.penalty_compliance = spring.compliance;
}

/// Nothing faces it.
void release(PredictorPoint& predicted) {
  predicted.stencil.nodes.clear();
  predicted.value[0] = std::numeric_limits<double>::infinity();
  predicted.force.setZero();
}

void set_forces(const contact::PointOutcome& outcome, const contact::Kinematics& k,
                PredictorPoint& predicted) {
  predicted.force.setZero();
  predicted.force[0] = outcome.normal.norm();
  for (int a = 0; a + 1 < k.stencil.components; ++a)
    predicted.force[1 + a] = outcome.tangential[0] * k.tangents(0, a) +
                             outcome.tangential[1] * k.tangents(1, a) +
                             outcome.tangential[2] * k.tangents(2, a);
}

bool holds_both_ways(const contact::Zone& zone) {
  return zone.settings.tie || zone.settings.bilateral;
}

/// The prediction knows of pushing forces only: what holds whatever its force begins with that of the last
/// step.
bool starts_from_last_step(const contact::Zone& zone) {
  if (holds_both_ways(zone))
    return true;
  return zone.settings.friction > 0 &&
         contact::friction_law(zone.settings.friction_method).starts_from_last_step;
}

double friction_limit(const PredictorPoint& predicted) {
  return predicted.friction * predicted.force[0];
}

Status status_of(const PredictorPoint& predicted) {
  if (predicted.force[0] == 0)
    return Status::open;
  const double friction =
      std::sqrt(predicted.force[1] * predicted.force[1] + predicted.force[2] * predicted.force[2]);
  return friction < (1 - nearly_at_limit) * friction_limit(predicted) ? Status::stick : Status::slip;
}

/// λ, Λ₁, Λ₂ of a point with that force.
Eigen::Vector3d multipliers_of(const PredictorPoint& predicted) {
  Eigen::Vector3d values = Eigen::Vector3d::Zero();
  values[0] = predicted.force[0] / predicted.weight;
  if (const double limit = friction_limit(predicted); limit > 0)
    for (int a = 1; a <= 2; ++a)
      values[a] = -predicted.force[a] / limit;
  return values;
}

/// Of nodes that several points share: their mean, each counted with its weight and the node's part of it.
void take_mean_multipliers(const contact::Zone& zone, std::size_t z, std::span<const PredictorPoint> points,
                           VectorXd& multipliers) {
  const auto variables = zone.multiplier_variables();
  const auto count = static_cast<Index>(variables.size());
  VectorXd weights = VectorXd::Zero(multipliers.size());
  VectorXd sums = VectorXd::Zero(multipliers.size());
  for (const auto& predicted : points) {
    if (predicted.zone != z)
      continue;
    const auto& point = zone.points[predicted.index];
    const auto values = multipliers_of(predicted);
    for (std::size_t j = 0; j < point.multipliers.size(); ++j)
      for (Index k = 0; k < count; ++k) {
        const int variable = variables[static_cast<std::size_t>(k)];
        const double part =
            std::abs(point.weight * point.multiplier_shape[j]) * (variable == 0 ? 1.0 : predicted.force[0]);
        weights[point.multipliers[j] * count + k] += part;
        sums[point.multipliers[j] * count + k] += part * values[variable];
      }
  }
  for (Index i = 0; i < multipliers.size(); ++i)
    multipliers[i] = weights[i] > 0 ? sums[i] / weights[i] : 0.0;
}

} // namespace

void take_points(const Model& model, const ContactEvaluator& side, const Frozen& frozen,
                 const Compliance& compliance, const ContactIterate& contact, const VectorXd& moved,
                 const State& state, std::vector<PredictorPoint>& points) {
  std::size_t count = 0;
  for (std::size_t z = 0; z < model.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const auto law = side.law_of(z, frozen);
    const bool averaged = !zone.points_own_multipliers;
    for (std::size_t i = 0; frozen[z].status.empty() && i < zone.points.size(); ++i) {
      const auto& evaluation = contact.points[z][i];
      if (!evaluation.kinematics || zone.points[i].excluded)
        continue;
      if (count == points.size())
        points.emplace_back();
      auto& predicted = points[count++];
      predicted.zone = z;
      predicted.index = i;
      predicted.friction = law.of_point(i).friction;
      if (averaged || side.system().has_free_bodies)
        predicted.point_compliance =
            1 / contact::resistance(zone.points[i], model.dofs, side.system().diagonal);
      predicted.tangential_compliance =
          averaged ? averaged_friction_compliance * predicted.point_compliance : 0;
      predicted.averaged_compliance = averaged ? averaged_compliance * predicted.point_compliance : 0.0;
      if (const auto& outcome = state.zones[z].outcomes[i]; zone.points[i].shares.empty())
        set_forces(outcome, *evaluation.kinematics, predicted);
      else
        set_forces(contact::whole_outcome(zone, i, outcome), *evaluation.kinematics, predicted);
      follow_spring(law, evaluation, predicted);
      set_relations(model, compliance, *evaluation.kinematics, moved, predicted);
    }
  }
  points.resize(count);
}

void find_touching(std::span<const PredictorPoint> points, const VectorXd& d, PointsOfZones& touching) {
  for (auto& of_zone : touching)
    of_zone.clear();
  for (const auto& point : points)
    if (point.force[0] > 0 || measures_of(point, d)[0] <= std::max(0.0, still_open * point.gap))
      touching[point.zone].push_back(point.index);
}

void move_frames(const Model& model, const ContactEvaluator& side, const Frozen& frozen,
                 const Compliance& compliance, const ContactIterate& contact, const VectorXd& moved,
                 const PointsOfZones& touching, std::span<PredictorPoint> points) {
  auto point = points.begin();
  for (std::size_t z = 0; z < touching.size(); ++z) {
    const auto law = side.law_of(z, frozen);
    for (const auto index : touching[z]) {
      while (point->zone != z || point->index != index)
        ++point;
      if (const auto& evaluation = contact.points[z][index]; evaluation.kinematics) {
        follow_spring(law, evaluation, *point);
        set_relations(model, compliance, *evaluation.kinematics, moved, *point);
      } else {
        release(*point);
      }
    }
  }
}

VectorXd force_on_surface(std::span<const PredictorPoint> points, Index interface_dofs) {
  VectorXd force = VectorXd::Zero(interface_dofs);
  add_force(points, 0, 2, force);
  return -force;
}

bool prediction_is_exact(const Model& model) {
  return !model.zones.empty() && study::entry_of(model.zones.front().settings.method).exact_prediction;
}

bool starts_from_prediction(const Model& model, Start start) {
  return prediction_is_exact(model) ||
         (start == Start::predicted && std::ranges::none_of(model.zones, holds_both_ways)) ||
         (start == Start::usual && std::ranges::none_of(model.zones, starts_from_last_step));
}

void take_prediction(const Model& model, std::span<const PredictorPoint> points, State& state) {
  for (const auto& predicted : points)
    state.zones[predicted.zone].status[predicted.index] = status_of(predicted);
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (!model.zones[z].points_own_multipliers)
      take_mean_multipliers(model.zones[z], z, points, state.zones[z].multipliers);
  for (const auto& predicted : points) {
    const auto& zone = model.zones[predicted.zone];
    if (!zone.points_own_multipliers)
      continue;
    const auto values = multipliers_of(predicted);
    Index next = static_cast<Index>(zone.points[predicted.index].node_position) * zone.multipliers_per_node();
    for (const int variable : zone.multiplier_variables())
      state.zones[predicted.zone].multipliers[next++] = values[variable];
  }
}

} // namespace rubato::step
