// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the energy of a run is and where it came from. [force · length]
///
/// The ledger is no estimate: docs/theory/energy.md derives, from the scheme's coefficients, an identity that
/// its terms fulfil to rounding in every step whose equations are solved.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/overlap.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <memory>
#include <span>

namespace rubato::contact {
struct Zone;
} // namespace rubato::contact

namespace rubato::domain {
struct Balance;
} // namespace rubato::domain

namespace rubato::step {

class RigidParts;

/// Adds what a step did in materials to the ledger.
void enter(const domain::Balance& balance, EnergyLedger& ledger);

/// What the rounding of forces K u may do as work between two displacements, 16 ε Σ |[u]| k |u|: in each
/// force terms of the size k u cancel. `resistance`: k, a bound or the diagonal of K, one a dof.
double rounding_of_work(const Eigen::VectorXd& resistance, const Eigen::VectorXd& before,
                        const Eigen::VectorXd& now);

/// Keeps the ledger of an implicit run, step by step, at the cost of a few dot products a step.
class EnergyAccount {
public:
  /// The model and the scheme must outlive this. `start`: the state the run begins with.
  EnergyAccount(const model::Model& model, const time::Scheme& scheme, const State& start);
  /// Goes on with an account as it was after one step or more.
  EnergyAccount(const model::Model& model, const time::Scheme& scheme, const EnergyLedger& ledger,
                Overlaps overlaps);

  /// Enters the step from `committed` to `trial`.
  void enter(const State& committed, const State& trial);
  const EnergyLedger& ledger() const { return ledger_; }
  /// What overlapped at the start and may still give energy; empty after two steps.
  const Overlaps& overlaps() const { return overlaps_; }

private:
  static std::shared_ptr<const Eigen::VectorXd> diagonal_of(const model::Model& model);
  double work_of_contact(const Eigen::VectorXd& moved, const Eigen::VectorXd& before,
                         const Eigen::VectorXd& now) const;
  struct Supports {
    double work = 0;      ///< with the mean of the reactions at both ends
    double with_step = 0; ///< with the reaction that the step's equation has
  };
  void enter_ground(const Eigen::VectorXd& moved, const State& committed, const State& trial);
  struct Obstacles {
    double normal = 0; ///< of their pressures, with the mean of both ends
    double tangential = 0;
  };
  Obstacles work_of_obstacles(const State& committed, const State& trial) const;
  Supports enter_supports(const Eigen::VectorXd& moved, const State& committed, const State& trial) const;
  Eigen::VectorXd constant_forces(const State& state) const;
  Eigen::MatrixXd constant_resultants(const State& state) const;
  double strain_energy(const State& state, const Eigen::MatrixXd& constant) const;
  void enter_heat(const State& committed, const State& trial);
  double work_of_equation(const Eigen::VectorXd& moved, const State& committed, const State& trial) const;
  double enter_overlaps(const State& committed, const State& trial);
  double dissipation_of_inertia(const Eigen::VectorXd& moved, const State& committed,
                                const State& trial) const;
  double scheme_dissipation(const Eigen::VectorXd& moved, const State& committed, const State& trial) const;

  const model::Model* model_;
  const time::Scheme* scheme_;
  std::shared_ptr<const RigidParts> rigid_;           ///< of the model, one for all copies
  std::shared_ptr<const Eigen::VectorXd> resistance_; ///< likewise: the diagonal of the initial tangent
  EnergyLedger ledger_;
  Overlaps overlaps_;
  bool closed_ = false; ///< the first step is done
};

/// What normal contact springs hold [force · length]: the area of a point times the energy of its law, ½ N
/// ⟨−g⟩ of linear springs. Exact methods have none: between nodes their points may penetrate a little, gaps
/// being closed on average. Springs of friction begin anew in every step and give back nothing of what they
/// took: it counts as friction.
double energy_of_springs(std::span<const contact::Zone> zones, std::span<const contact::ZoneState> states);

} // namespace rubato::step
