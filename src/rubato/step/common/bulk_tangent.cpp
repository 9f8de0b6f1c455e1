// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/bulk_tangent.hpp"

#include <memory>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// What an iteration may leave of the residual before a kept factor is given up.
constexpr double kept_progress = 0.3;
/// Of the way that the step would go by itself: cells that yield have their tangent for the direction of it.
/// Far along that way they would be too soft for a step that turns out shorter.
constexpr double small_part = 1e-3;

} // namespace

BulkTangent::BulkTangent(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                         const State& committed, double t)
    : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t) {}

BulkStart BulkTangent::start() {
  BulkStart start{VectorXd::Zero(committed_.motion.u.size()), {}};
  put(at_start(start.forces));
  start.tangent = system_.tangent;
  return start;
}

Tangent BulkTangent::at_start(VectorXd& forces) {
  const auto& u = committed_.motion.u;
  if (committed_.tangent && committed_.step == system_.step) {
    at(u, &forces);
    return committed_.tangent;
  }
  auto here = at(u, &forces);
  const VectorXd on = slightly_on();
  auto there = on == u ? nullptr : at(on, nullptr);
  return there ? there : here;
}

/// By the velocity, or by the move of the last step.
VectorXd BulkTangent::slightly_on() const {
  const double length = small_part * (t_ - committed_.t);
  if (scheme_.dynamic)
    return committed_.motion.u + length * committed_.motion.v;
  if (committed_.moved.size() == 0 || committed_.step <= 0)
    return committed_.motion.u;
  return committed_.motion.u + length / committed_.step * committed_.moved;
}

/// Null where a cell has no answer.
Tangent BulkTangent::at(const VectorXd& u, VectorXd* forces) {
  if (matrix_.nonZeros() == 0)
    matrix_ = model_.domain.initial_tangent();
  const auto failed =
      model_.domain.evaluate({committed_.motion.u, u, committed_.t, t_}, committed_.bulk_points, unused_,
                             {.forces = forces, .tangent = &matrix_});
  return failed ? nullptr : values_of(matrix_);
}

bool BulkTangent::put(const Tangent& tangent) {
  if (!tangent)
    return false;
  if (same_values(system_.tangent, tangent))
    return true;
  ++renewals_;
  const auto before = system_.tangent;
  if (renew(system_, model_, tangent))
    return true;
  indefinite_ = true;
  renew(system_, model_, before);
  return false;
}

bool BulkTangent::wants_renewal(double before, double now) const {
  if (model_.study.newton.tangent == study::TangentChoice::full)
    return true;
  return !(now <= kept_progress * before);
}

bool BulkTangent::renew_at(const VectorXd& u) {
  return put(at(u, nullptr));
}

} // namespace rubato::step
