// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact by penalty as explicit steps evaluate it: forces only, no derivatives, no allocation.
///
/// At a contact point of weight w, with k_n and k_t [pressure/length]:
///   p = k_n ⟨−g⟩                                      on the deformed surfaces
///   t = −k_t s,  |t| ≤ μ p                            s: elastic slip, a vector in the tangent plane
/// s grows with the slip increments of the steps, whatever their number, and is cut back to |t| = μ p when it
/// slips (return mapping). It must be carried from step to step: steps of 1e-6 s
/// are too short for a slip that starts anew in each of them to make any friction.
///
/// A point that faced nothing and is found to penetrate when it faces the master again (a tip that has slid
/// off an edge and comes back) would get an excessive force. The gap it is found with is its offset instead:
/// p = k_n ⟨g₀ − g⟩, and g₀ follows g as far as the point comes out by itself.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/explicit_memory.hpp"
#include "rubato/contact/law.hpp"
#include "rubato/contact/neighbours.hpp"
#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace rubato::contact {

/// k_n of each point [pressure/length]: as the deck gives it or else such that the point's spring, between
/// its own mass and the mean mass of a master node, vibrates with a third of the bulk's highest frequency:
/// w k_n = λ/10 / (1/m_slave + 1/m_master). `inverse_mass`: one a dof, 0 where it is held; `eigenvalue`: the
/// bulk's largest, λ = ω² [1/time²].
std::vector<double> penalty_stiffness(const Zone& zone, const domain::DofMap& dofs,
                                      const Eigen::VectorXd& inverse_mass, double eigenvalue);

/// One zone's springs and what they carry from step to step.
class ExplicitPenalty {
public:
  using Spring = ExplicitSpring;
  using Memory = ExplicitZoneMemory;

  /// k_t is k_n or, where the deck gives c_t [1/length], μ p c_t if that is less: then friction saturates at
  /// the slip 1/c_t. `dofs` and `zone` must outlive this.
  ExplicitPenalty(const Zone& zone, const domain::DofMap& dofs, std::vector<double> normal_stiffness);

  /// Takes the zone to a configuration and adds its forces, internal side, to `force` (one a dof).
  /// `velocity` times `step` is the displacement since the last call, which was at the configuration's
  /// start_t.
  void advance(const Configuration& configuration, const Eigen::VectorXd& velocity, double step,
               Eigen::VectorXd& force);

  /// What the points' forces push the slave with, all together [force].
  Eigen::Vector3d push() const;
  /// What these forces do by the motion of the obstacle in a step to the configuration, `velocity` times
  /// `step` the displacement of the bodies in it [force · length].
  double work_of_obstacle(const Configuration& configuration, const Eigen::VectorXd& velocity,
                          double step) const;

  double stored() const;     ///< in the springs [force · length]
  double dissipated() const; ///< by friction, in all steps

  Memory memory() const { return {springs_, friction_history_}; }
  /// Goes back to what it carried at a configuration.
  void restore(const Memory& memory, const Configuration& configuration);

  /// Statuses and outcomes for the results; slips are those of the last step.
  ZoneState state() const;

  /// Adds what springs of the points that face the master put on each node, Σ w k_n |N|, at its first dof.
  void add_loads(Eigen::VectorXd& load) const;
  /// The largest row sum of B M⁻¹ Bᵀ diag(w k_n) when the nodes carry `load`.
  double largest_row_sum(const Eigen::VectorXd& load, const Eigen::VectorXd& inverse_mass) const;

  const NeighbourList& neighbours() const { return neighbours_; }

private:
  bool press(Spring& spring, double normal_stiffness) const;
  void rub(Spring& spring, double friction, double normal_stiffness, const Eigen::Vector3d& slip) const;
  double tangential_energy(std::size_t point) const;
  Eigen::Vector3d push_of(std::size_t point) const;
  template <class Visit> void visit_nodes(std::size_t point, const Visit& visit) const;

  const Zone* zone_;
  const domain::DofMap* dofs_;
  std::vector<double> normal_stiffness_;
  NeighbourList neighbours_;
  std::vector<Spring> springs_;
  std::vector<FrictionHistory> friction_history_;
  Kinematics place_; ///< of one point after the other
};

/// A bound of the largest eigenvalue, ω², that the springs of all points facing a master have against the
/// masses, whether they touch or not (Gershgorin's, of B M⁻¹ Bᵀ diag(w k_n)) [1/time²].
double largest_eigenvalue(std::span<const ExplicitPenalty> zones, const Eigen::VectorXd& inverse_mass);

} // namespace rubato::contact
