// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact forces, multiplier equations and their tangent for a whole zone.
#pragma once

#include "rubato/contact/friction_history.hpp"
#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/law.hpp"
#include "rubato/contact/neighbours.hpp"
#include "rubato/contact/pairing.hpp"
#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/contact/zone_state.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rubato::contact {

/// A zone before anything touched: multipliers 0, every point in contact or none.
ZoneState initial_state(const Zone& zone);

/// Which points of a bilateral zone have touched: those that pressed or pulled at the end of a step, and
/// where the zone is `initially_active` by the study's word all that begin so. Empty of other zones.
std::vector<std::uint8_t> touched_points(const Zone& zone, const ZoneState& state);

/// Coefficients of one zone's points, automatic unless the deck gives them.
struct ZoneCoefficients {
  std::vector<double> normal;     ///< c or k of each point [pressure/length]
  std::vector<double> tangential; ///< c_t or k_t of each point [1/length]; nodal methods: E [force/length]
  /// What the slave side resists at each point, whatever c is [pressure/length]; none: not known.
  std::vector<double> resistance{};
};

/// c: what the slave side resists, its mean effective diagonal stiffness over the point's share of the
/// surface. c_t: the slip at which friction saturates is taken as a small part of the zone's edge;
/// as with c, the converged answer does not depend on it. Penalties are a multiple of c, so that bodies sink
/// into each other by a small part of what they give way, and of c_t. `diagonal` is the effective matrix's,
/// per dof [force/length].
ZoneCoefficients automatic_coefficients(const Zone& zone, const domain::DofMap& dofs,
                                        const Eigen::Ref<const Eigen::VectorXd>& diagonal);

/// Mean over the directions of the stiffness of the nodes that move a point, each counted with its share
/// [force/length]. `diagonal` as above.
double resistance(const SlavePoint& point, const domain::DofMap& dofs,
                  const Eigen::Ref<const Eigen::VectorXd>& diagonal);

/// A contact point at one configuration. Unpaired points have no kinematics and a gap of infinity.
struct PointEvaluation {
  Pair pair;
  std::optional<Kinematics> kinematics;
  PointState variables;
  double cover = 1; ///< part of the point's area that faces the master: less than 1 in mortar only
  /// Of a mortar node that faces so little that its dual function is shared among others: those points.
  std::vector<int> receivers{};
  /// Of a mortar node: how much its gap is lifted where dual functions see it too low; −1 where it faces
  /// nothing [length].
  double lift = 0;
};

/// Gap, slip and multipliers of a point, the latter interpolated from the nodes that share it.
PointState variables_of(const Zone& zone, const SlavePoint& point, const Eigen::VectorXd& multipliers,
                        const std::optional<Kinematics>& kinematics);

/// What tractions of a point are multiplied with in that configuration.
inline double weight_of(const SlavePoint& point, const PointEvaluation& evaluation) {
  return point.weight * evaluation.cover;
}

/// Pairs the points and measures gaps, slips and multipliers, in the storage that an earlier evaluation of
/// the zone left in `into`, with pairs from a list of neighbours kept from one configuration to the next: in
/// steady state nothing is searched or allocated.
void evaluate(NeighbourList& neighbours, const Eigen::VectorXd& multipliers,
              const Configuration& configuration, std::vector<PointEvaluation>& into);

/// The same without the derivatives of what it measures.
void measure(NeighbourList& neighbours, const Eigen::VectorXd& multipliers,
             const Configuration& configuration, std::vector<PointEvaluation>& into);

/// The same of some of the points: the others stay as `into` has them.
void measure(NeighbourList& neighbours, const Eigen::VectorXd& multipliers,
             const Configuration& configuration, std::span<const std::size_t> points,
             std::vector<PointEvaluation>& into);

/// The derivatives of a paired point that was measured at this configuration.
void differentiate(const Zone& zone, std::size_t point, const Configuration& configuration,
                   PointEvaluation& evaluation);

/// The points with the place on the master, normal and tangents they have now, frozen.
std::vector<PointEvaluation> with_frozen_frames(std::vector<PointEvaluation> points);

/// Measures the points anew in frames that with_frozen_frames gave.
std::vector<PointEvaluation> evaluate_in_frozen_frames(std::vector<PointEvaluation> frozen, const Zone& zone,
                                                       const Eigen::VectorXd& multipliers,
                                                       const Configuration& configuration);

/// The same in the storage of `into`.
void evaluate_in_frozen_frames(const std::vector<PointEvaluation>& frozen, const Zone& zone,
                               const Eigen::VectorXd& multipliers, const Configuration& configuration,
                               std::vector<PointEvaluation>& into);

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

/// How a zone's points are to behave in one attempt at a step: a view.
struct ZoneLaw {
  const Zone* zone = nullptr;
  const ZoneCoefficients* coefficients = nullptr;
  double friction = 0; ///< the zone's μ or, during continuation, a part of it; Zone has its shares at points
  /// P of every point, while a loop holds it; empty otherwise.
  std::span<const double> frozen_friction_pressures = {};
  /// Of a bilateral zone: whether a point has touched before this step; else empty.
  std::span<const std::uint8_t> stays_closed = {};
  /// Of every point, where nodes have several; empty: all.
  std::span<const FrictionDirections> directions = {};

  PointLaw of_point(std::size_t index) const;
};

/// The statuses that the points' present variables call for; excluded and unpaired points are open.
std::vector<Status> wanted_status(const ZoneLaw& law, std::span<const PointEvaluation> points);

/// Where no point of a zone would touch any more, those with positive multipliers stay as they were in the
/// iterate before. What only this contact holds would fly off for a gap that is small for it, however large
/// for the augmentation; if it does part, multipliers turn negative. Springs have none and part at once.
void keep_last_contact(const ZoneLaw& law, std::span<const PointEvaluation> points,
                       std::span<const Status> before, std::span<Status> status);

/// z = −w T of a point in contact: what the slave feels, internal side [force].
Eigen::Vector3d force_of(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation,
                         Status status);

/// P of every point of those statuses; 0 where it is open.
std::vector<double> friction_pressures(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                       std::span<const Status> status);

/// Adds the forces, equations and tangent of the zone's points, which have the given statuses.
/// `multiplier_offset`: index of the zone's first multiplier.
void add_contributions(const ZoneLaw& law, std::span<const PointEvaluation> points,
                       std::span<const Status> status, const domain::DofMap& dofs, int multiplier_offset,
                       ContactSystem& system);

/// What the points of those statuses do.
std::vector<PointOutcome> outcomes(const ZoneLaw& law, std::span<const PointEvaluation> points,
                                   std::span<const Status> status);

struct MeanGap {
  double value = 0; ///< [length]
  int position = 0; ///< of the node in the slave surface's nodes
};

/// Where gaps close on average only: the largest residual of a slave node's equation for its pressure,
/// |Σ w ψ e| / Σ w |ψ| with e = −g in contact and −λ/c apart [length].
MeanGap largest_mean_gap(const ZoneLaw& law, std::span<const PointEvaluation> points,
                         std::span<const Status> status);

/// Adds what friction puts on the dofs, internal side, when the points do that.
void add_friction_force(std::span<const PointEvaluation> points, std::span<const PointOutcome> outcomes,
                        const domain::DofMap& dofs, Eigen::VectorXd& force);

} // namespace rubato::contact
