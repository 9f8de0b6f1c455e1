// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/bulk_tangent.hpp"

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// What an iteration may leave of the residual before a kept factor is given up.
constexpr double kept_progress = 0.3;

} // namespace

BulkTangent::BulkTangent(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                         const State& committed, double t)
    : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t),
      tangent_(model.domain.initial_tangent()) {}

BulkStart BulkTangent::start() {
  BulkStart start{VectorXd::Zero(committed_.motion.u.size()), &system_.tangent};
  const VectorXd ahead = carried_on();
  take(committed_.motion.u, &start.forces);
  if (ahead != committed_.motion.u && !take(ahead, nullptr))
    take(committed_.motion.u, nullptr);
  put();
  return start;
}

/// By the velocity, or by the move of the last step.
VectorXd BulkTangent::carried_on() const {
  if (scheme_.dynamic)
    return committed_.motion.u + (t_ - committed_.t) * committed_.motion.v;
  if (committed_.moved.size() == 0 || committed_.step <= 0)
    return committed_.motion.u;
  return committed_.motion.u + (t_ - committed_.t) / committed_.step * committed_.moved;
}

bool BulkTangent::take(const VectorXd& u, VectorXd* forces) {
  return !model_.domain.evaluate({committed_.motion.u, u, committed_.t, t_}, committed_.bulk_points, unused_,
                                 {.forces = forces, .tangent = &tangent_});
}

bool BulkTangent::put() {
  const model::SparseMatrix before = system_.tangent;
  const bool changes =
      !std::equal(before.valuePtr(), before.valuePtr() + before.nonZeros(), tangent_.valuePtr());
  if (!changes)
    return true;
  ++renewals_;
  if (renew(system_, model_, tangent_))
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
  return take(u, nullptr) && put();
}

} // namespace rubato::step
