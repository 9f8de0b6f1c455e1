// SPDX-License-Identifier: LGPL-3.0-or-later
/// Friction that grows with the slip of a step up to its limit (`friction_method: penalty`, `nodal_penalty`),
/// as Newton's iterations go through it.
///
/// It has a kink on either side of the slips that stick. From beyond one of them the tangent knows of the
/// limit only, and a point that ought to stick is pushed to beyond the other one, from there back, and so on
/// for ever. A multiplier would tell where a point comes from (G. Stadler, Semismooth Newton and augmented
/// Lagrangian methods for a simplified friction problem, SIAM J. Optim. 15, 2004); springs have none, so that
/// the iterate before does.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <span>
#include <vector>

namespace rubato::contact {

/// Points and their statuses: a view.
struct IterateOfZone {
  std::span<const PointEvaluation> points;
  std::span<const Status> status;
  const Eigen::VectorXd& u; ///< one a dof
};

/// Whether points of a zone may stick on their way from one slip to the opposite one.
bool sticks_in_passing(const Zone& zone);

/// Of points that slip now and were in contact in the iterate before, makes those stick
/// - that had no pressure there to rub with, when their friction can pull them back over the slip that they
///   have come by meanwhile;
/// - that slipped the other way: they have passed the slips that stick;
/// - that stuck, when their slip has fallen to less than half, or when they stick by the tangent and friction
///   can pull them back over what that does not know of: stiff springs slip by less.
/// Only where friction is by springs. An answer has no such points: its statuses are those that the law calls
/// for, two iterates in a row.
void stick_in_passing(const ZoneLaw& law, const IterateOfZone& before, const IterateOfZone& now,
                      const domain::DofMap& dofs, std::span<Status> status);

/// Of a point that sticks beyond its limit, and so is on its way to a smaller slip: its friction is to grow
/// with the pressure as the limit does.
inline void follow_limit(PointResponse& response) {
  if (response.kept_friction == 1)
    return;
  response.d_traction.block<2, 1>(1, 0) *= response.kept_friction; // by the gap of a penalty
  response.d_traction.block<2, 1>(1, 3) *= response.kept_friction; // by λ
}

/// How stiff friction by `penalty` is while points of those statuses stick, μ k_t times their pressing force;
/// 0 of others. [force/length]
std::vector<double> friction_stiffness(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                       std::span<const Status> status);

} // namespace rubato::contact
