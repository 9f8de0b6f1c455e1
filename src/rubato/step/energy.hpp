// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the energy of a run is and where it came from. [force · length]
///
/// The ledger is no estimate: docs/theory/energy.md derives, from the scheme's coefficients, an identity that
/// its terms fulfil to rounding in every step whose equations are solved.
#pragma once

#include "rubato/model/model.hpp"
#include "rubato/step/common/rigid_parts.hpp"
#include "rubato/step/overlap.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace rubato::step {

struct EnergyLedger {
  // Frozen by the bodies and their contact at this instant:
  double kinetic = 0;
  double strain = 0;
  double contact = 0;     ///< stored in penalty springs; implicit runs: normal ones
  double back_stress = 0; ///< stored in back stresses of plasticity
  double hourglass = 0;   ///< stored in what keeps cells of reduced integration in shape
  // Given and taken since the start of the run:
  double external_work = 0; ///< of the loads on the bodies
  double support_work = 0;  ///< of supports and obstacles that move, of interferences and gaps that change
  double overlap_work = 0;  ///< of pressures that close what overlapped when the run began
  double heat = 0;          ///< put into bodies that expand by their temperature
  double damping = 0;       ///< dissipated by Rayleigh damping
  double friction = 0;      ///< dissipated by friction
  double plastic = 0;       ///< dissipated by plastic strain
  double viscous = 0;       ///< dissipated by viscoelastic materials
  double impact = 0;        ///< taken by contact pressures and not stored: > 0 where bodies hit, < 0 gained
  double numerical = 0;     ///< dissipated by the time scheme; < 0 gained
  /// Work of internal forces over steps that bodies of finite strain, and hourglasses of those that yield,
  /// neither store nor dissipate: an error of
  /// the time scheme, too; < 0 gained.
  double bulk_scheme = 0;
  double unbalanced = 0; ///< work of the forces that iterations and the rounding of f_int left unbalanced
  double start = 0;      ///< what was stored when the run began
  /// What the rounding of internal forces may have put into all of these: a floor below which they are none.
  double rounding = 0;
  /// Would be stored in bodies that cannot expand: `strain` and `heat` are differences of such terms.
  double held_heat = 0;

  double stored() const { return kinetic + strain + contact + back_stress + hourglass; }
  /// What the ledger has no entry for: rounding.
  double balance() const {
    return stored() - start + damping + friction + plastic + viscous + impact + numerical + bulk_scheme -
           external_work - support_work - overlap_work - heat - unbalanced;
  }
  /// What the bodies have more than physics allows: < 0 as long as impacts and the scheme only take.
  double gain() const {
    return stored() - start + damping + friction + plastic + viscous - external_work - support_work -
           overlap_work - heat;
  }
  /// The largest of all parts: what the balance is measured by.
  double largest() const {
    return std::max({std::abs(kinetic), std::abs(strain), std::abs(contact), std::abs(back_stress),
                     std::abs(hourglass), std::abs(external_work), std::abs(support_work),
                     std::abs(overlap_work), std::abs(heat), std::abs(held_heat), std::abs(damping),
                     std::abs(friction), std::abs(plastic), std::abs(viscous), std::abs(impact),
                     std::abs(numerical), std::abs(bulk_scheme), std::abs(unbalanced), std::abs(start)});
  }
};

/// Adds what a step did in materials to the ledger.
void enter(const domain::Balance& balance, EnergyLedger& ledger);

/// What the rounding of forces K u may do as work between two displacements, 16 ε Σ |[u]| k |u|: in each
/// force terms of the size k u cancel. `resistance`: k, a bound or the diagonal of K, one a dof.
double rounding_of_work(const Eigen::VectorXd& resistance, const Eigen::VectorXd& before,
                        const Eigen::VectorXd& now);

/// How far ledgers of a run were out of balance, and what it gained.
struct EnergyRecord {
  double largest = 0;         ///< of all terms at all instants
  double largest_balance = 0; ///< its magnitude
  double gain = 0;            ///< the largest one, > 0
  double gained_at = 0;       ///< when
  double by_impact = 0;       ///< parts of it
  double by_scheme = 0;
  double by_bulk_scheme = 0;

  void note(double t, const EnergyLedger& ledger);
};

/// Keeps the ledger of an implicit run, step by step, at the cost of a few dot products a step.
class EnergyAccount {
public:
  /// The model and the scheme must outlive this. `start`: the state the run begins with.
  EnergyAccount(const model::Model& model, const time::Scheme& scheme, const State& start);
  /// Goes on with an account as it was after one step or more.
  EnergyAccount(const model::Model& model, const time::Scheme& scheme, const EnergyLedger& ledger,
                Overlaps overlaps)
      : model_(&model), scheme_(&scheme), rigid_(std::make_shared<const RigidParts>(model)),
        resistance_(diagonal_of(model)), ledger_(ledger), overlaps_(std::move(overlaps)), closed_(true) {}

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
