// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/frozen_points.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/mortar/points.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/tie.hpp"

#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// As a zone has them that follows its surfaces.
std::vector<PointEvaluation> points_at(const Zone& zone, const Configuration& configuration) {
  std::vector<PointEvaluation> points;
  const VectorXd none = VectorXd::Zero(zone.multiplier_count());
  if (zone.mortar) {
    mortar::Points by(zone);
    mortar::measure(by, none, configuration, points);
  } else {
    NeighbourList by(zone);
    measure(by, none, configuration, points);
  }
  points = with_frozen_frames(std::move(points));
  for (auto& point : points)
    if (point.kinematics)
      point.kinematics->slip_origin.setZero();
  return points;
}

} // namespace

void FrozenPoints::make_frames(const Configuration& configuration) {
  if (!frames_.empty())
    return;
  const VectorXd rest = VectorXd::Zero(configuration.displacement->size());
  const Configuration undeformed{configuration.mesh, configuration.dofs, &rest, &rest,
                                 zone_->begin,       zone_->begin};
  if (!zone_->settings.tie) {
    frames_ = points_at(*zone_, undeformed);
    return;
  }
  auto ties = make_ties(*zone_, undeformed);
  frames_ = std::move(ties.points);
  if (zone_->finite_rotations)
    gaps_ = std::move(ties.gaps);
}

void FrozenPoints::measure(std::size_t point, const VectorXd& multipliers, const Configuration& configuration,
                           PointEvaluation& into) const {
  into = frames_[point];
  if (into.kinematics) {
    auto& k = *into.kinematics;
    if (zone_->obstacle) {
      add_scaled(1, zone_->obstacle->translation(zone_->begin, configuration.t), k.closest_point);
      k.obstacle_displacement = zone_->obstacle->translation(configuration.start_t, configuration.t);
    }
    k.gap_origin -= zone_->offset.change(zone_->points[point].place, zone_->begin, configuration.t);
    if (zone_->settings.tie) {
      const auto start = k.stencil.gather(*configuration.start, *configuration.dofs);
      for (int a = 0; a < 2; ++a)
        k.slip_origin[a] = -dot(column_of(k.tangents, a), start);
      if (!gaps_.empty())
        follow_turning(gaps_[point], configuration, k);
    }
    measure_in_frozen_frame(k, configuration);
  }
  into.variables = variables_of(*zone_, zone_->points[point], multipliers, into.kinematics);
}

void FrozenPoints::measure(const VectorXd& multipliers, const Configuration& configuration,
                           std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into) {
  make_frames(configuration);
  for (const auto point : chosen)
    measure(point, multipliers, configuration, into[point]);
}

void FrozenPoints::measure(const VectorXd& multipliers, const Configuration& configuration,
                           std::vector<PointEvaluation>& into) {
  make_frames(configuration);
  into.resize(frames_.size());
  for (std::size_t point = 0; point < frames_.size(); ++point)
    measure(point, multipliers, configuration, into[point]);
}

void evaluate(FrozenPoints& points, const VectorXd& multipliers, const Configuration& configuration,
              std::vector<PointEvaluation>& into) {
  points.measure(multipliers, configuration, into);
}

void measure(FrozenPoints& points, const VectorXd& multipliers, const Configuration& configuration,
             std::vector<PointEvaluation>& into) {
  points.measure(multipliers, configuration, into);
}

void measure(FrozenPoints& points, const VectorXd& multipliers, const Configuration& configuration,
             std::span<const std::size_t> chosen, std::vector<PointEvaluation>& into) {
  points.measure(multipliers, configuration, chosen, into);
}

} // namespace rubato::contact
