// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact forces, multiplier equations and their tangent for a whole zone.
#pragma once

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/law.hpp"
#include "rubato/contact/pairing.hpp"
#include "rubato/contact/zone.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>
#include <span>
#include <vector>

namespace rubato::contact {

/// What a step changes in a zone.
struct ZoneState {
  /// Node after node of the slave surface: λ, then Λ₁ (and Λ₂ in 3D) when there is friction.
  Eigen::VectorXd multipliers;
  std::vector<Status> status; ///< one a contact point

  bool operator==(const ZoneState&) const = default;
};

/// A zone before anything touched: multipliers 0, every point in contact or none.
ZoneState initial_state(const Zone& zone);

/// Automatic augmentation of one zone's points unless the deck gives it.
struct ZoneCoefficients {
  std::vector<double> normal;     ///< c of each point [pressure/length]
  std::vector<double> tangential; ///< c_t of each point [1/length]
};

/// c: what the slave side resists, its mean effective diagonal stiffness over the point's share of the
/// surface. c_t: the slip at which friction saturates is taken as a small part of the shortest master edge;
/// as with c, the converged answer does not depend on it. `diagonal` is the effective matrix's, per dof
/// [force/length].
ZoneCoefficients automatic_coefficients(const Zone& zone, const fem::DofMap& dofs,
                                        const Eigen::Ref<const Eigen::VectorXd>& diagonal);

/// A contact point at one configuration. Unpaired points have no kinematics and a gap of infinity.
struct PointEvaluation {
  Pair pair;
  std::optional<Kinematics> kinematics;
  PointState variables;
};

/// Pairs the points and measures gaps, slips and multipliers.
std::vector<PointEvaluation> evaluate(const Zone& zone, const Eigen::VectorXd& multipliers,
                                      const Configuration& configuration);

using Triplets = std::vector<Eigen::Triplet<double, int>>;

/// Contributions of contact to the discrete equations. Forces stand on the internal side (minus what acts on
/// the bodies); dof indices are the model's, multiplier indices run through the zones.
struct ContactSystem {
  Eigen::VectorXd force;     ///< [force], one a dof
  Eigen::VectorXd equations; ///< one a multiplier
  Triplets force_by_dof;
  Triplets force_by_multiplier;
  Triplets equation_by_dof;
  Triplets equation_by_multiplier;

  ContactSystem(Eigen::Index dofs, Eigen::Index multipliers);
};

/// The coefficients of point `index`; `friction` is the zone's μ or, during continuation, a part of it.
PointCoefficients coefficients_of(const Zone& zone, const ZoneCoefficients& coefficients, double friction,
                                  std::size_t index);

/// The statuses that the points' present variables call for; excluded and unpaired points are open.
std::vector<Status> wanted_status(const Zone& zone, const ZoneCoefficients& coefficients, double friction,
                                  std::span<const PointEvaluation> points);

/// Adds the forces, equations and tangent of the zone's points, which have the given statuses.
/// `multiplier_offset`: index of the zone's first multiplier.
void add_contributions(const Zone& zone, const ZoneCoefficients& coefficients, double friction,
                       std::span<const PointEvaluation> points, std::span<const Status> status,
                       const fem::DofMap& dofs, int multiplier_offset, ContactSystem& system);

} // namespace rubato::contact
