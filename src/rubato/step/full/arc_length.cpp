// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/arc_length.hpp"

#include "rubato/model/model.hpp"

#include <cmath>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// Of the length of the step.
constexpr double allowed_miss = 1e-6;
/// An iterate this near to the start of the step, in parts of its length, has no direction yet.
constexpr double no_direction = 0.1;
/// Cosine of the angle between two steps beyond which the second one is on the way back. Paths have sharp
/// bends where contact closes.
constexpr double turned_back = 0.7;

} // namespace

std::optional<ArcLength> ArcLength::of(const model::Model& model, const State& committed, double step) {
  const auto& time = model.study.time;
  if (!time.arc_length)
    return std::nullopt;
  return ArcLength(model, committed, time.arc_length->length * step / (time.end - time.begin));
}

ArcLength::ArcLength(const model::Model& model, const State& committed, double length)
    : committed_(&committed) {
  const auto& nodes = model.arc_nodes;
  for (const auto node : nodes)
    for (int i = 0; i < model.dofs.components; ++i)
      dofs_.push_back(model.dofs.dof(node, i));
  length_ = length * std::sqrt(static_cast<double>(nodes.size()));
}

VectorXd ArcLength::measured(const VectorXd& full) const {
  return full(dofs_);
}

/// a x² + 2 b x + c = 0 with the way w + x d, |w + x d| = length.
std::optional<double> ArcLength::change(const VectorXd& u, const VectorXd& correction,
                                        const VectorXd& by_load) const {
  const VectorXd moved = measured(u - committed_->motion.u);
  const VectorXd way = moved + measured(correction);
  const VectorXd along = measured(by_load);
  const double a = along.squaredNorm();
  if (!(a > 0))
    return std::nullopt;
  const double b = way.dot(along);
  const double c = way.squaredNorm() - length_ * length_;
  const double inside = b * b - a * c;
  if (inside < 0)
    return -b / a;
  const double root = std::sqrt(inside);
  const double first = (-b + root) / a;
  const double second = (-b - root) / a;
  // Of the two the one that goes the way that the iterate before has gone, or the last step.
  const bool begins = moved.norm() < no_direction * length_;
  if (begins && committed_->moved.size() == 0)
    return first;
  const VectorXd before = begins ? measured(committed_->moved) : moved;
  const auto on = [&](double x) { return before.dot(way + x * along); };
  return on(first) >= on(second) ? first : second;
}

bool ArcLength::is_met(const VectorXd& u) const {
  return std::abs(measured(u - committed_->motion.u).norm() - length_) <= allowed_miss * length_;
}

bool ArcLength::goes_back(const VectorXd& u) const {
  if (committed_->moved.size() == 0)
    return false;
  const VectorXd before = measured(committed_->moved);
  const VectorXd moved = measured(u - committed_->motion.u);
  return before.dot(moved) < -turned_back * before.norm() * moved.norm();
}

} // namespace rubato::step
