// SPDX-License-Identifier: LGPL-3.0-or-later
/// Explicit motion by central differences, β = 0, γ = 1/2, with lumped mass:
///   r_n = f_int(u_n) + f_c(u_n) + C v_{n−1/2} − f_ext(t_n)
///   v_{n+1/2} = v_{n−1/2} − h M⁻¹ r_n,   u_{n+1} = u_n + h v_{n+1/2}
/// (T. Belytschko, W. K. Liu, B. Moran, Nonlinear Finite Elements for Continua and Structures, 2000, ch. 6).
/// Damping sees the velocity half a step before. Contact is by penalty whatever the zone's method says
/// (contact/explicit_penalty.hpp). A step costs one evaluation of the domain and allocates nothing.
/// With relations, u = T q + g, the unknowns move by M̄ q̈ = −Tᵀ (r + M g̈) with M̄ = Tᵀ M T
/// (constrained_mass.hpp); a step then solves with the coupled part of M̄. Ties are such relations.
///
/// Stable are steps h with h²/4 (K + 4 K_c) + h/2 C ≤ M, K the domain's initial tangent, K_c the springs of
/// contact:
///   h ≤ 4 / (λ_C + √(λ_C² + 4 (λ_K + 4 λ_c)))         2/ω without damping and contact
/// λ_K grows where cells of finite strain are compressed or grow stiffer (domain::Domain::growth). With
/// bounds of the largest eigenvalues against M. The second 4 keeps h ω_c ≤ 1: beyond that, far below the
/// limit of a spring that also pulls, springs that only push gain energy in each of many impacts.
#pragma once

#include "rubato/contact/explicit_penalty.hpp"
#include "rubato/domain/cell_failure.hpp"
#include "rubato/domain/evaluation.hpp"
#include "rubato/linalg/block_matrix.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/explicit/constrained_mass.hpp"
#include "rubato/step/explicit/explicit_memory.hpp"
#include "rubato/step/explicit/tie_forces.hpp"
#include "rubato/step/state.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace rubato::constraint {
struct DependentDof;
struct PrescribedDof;
class Reduction;
} // namespace rubato::constraint

namespace rubato::step {

/// Largest eigenvalues against the lumped mass, not below the true ones.
struct Spectrum {
  double stiffness = 0; ///< λ_K of the bodies alone, as they stand [1/time²]
  double contact = 0;   ///< λ_c of every spring that faces a master, as the surfaces stand [1/time²]
  double damping = 0;   ///< λ_C [1/time]

  /// The largest stable step [time].
  double stable_step() const;
};

class ExplicitMotion {
public:
  /// In the model's initial motion, or in that of `from`, the end of another run, with the states of its
  /// materials; under the loads and imposed displacements of the study's first instant. The model must
  /// outlive this. Throws InputError when a free unknown has no mass, or a cell no forces in the initial
  /// displacements.
  explicit ExplicitMotion(const model::Model& model, const State* from = nullptr);

  double t() const { return t_; }
  std::int64_t steps() const { return steps_; }
  /// Whether its displacements are all numbers.
  bool is_finite() const;
  int points_in_contact() const;
  Spectrum spectrum() const;

  /// Looks at what the largest eigenvalues depend on; true to the present instant until the next steps.
  void survey();
  /// How many steps may be made before the next survey: their step changes by a few percent at most.
  int steps_between_surveys() const { return survey_.interval; }

  /// Goes on to `end` in that many equal steps; ends at the first in which a cell has no forces: then forces
  /// and energies have no meaning.
  domain::Failed advance(double end, int steps);

  /// Goes on with the supports, relations and ties of a later stage of the model: the forces of those that
  /// have ended are gone at once.
  void take_supports(const model::Model& stage);

  using Survey = ExplicitSurvey;

  /// Kinetic energy is ½ v_{n−1/2}·M v_{n+1/2} and a constant that makes it continuous where the step
  /// changes, from 0 at rest on: with it the balance closes to rounding at any stable step. What the springs
  /// of contact take and do not keep or rub away, because points touch, leave or turn within a step, is
  /// `impact`.
  EnergyLedger energy() const;

  using Memory = ExplicitMemory;
  Memory memory() const;
  void restore(const Memory& memory);
  /// Of one that is dealt out to ranks (Model::parts), what is right on all of them and on any number of
  /// ranks. Others are whole.
  Memory whole(Memory memory) const;
  /// Takes what `whole` gave, or gave another number of ranks.
  void restore_whole(const Memory& memory);

  /// The present instant as implicit runs keep it, v = (v_{n−1/2} + v_{n+1/2})/2.
  State state() const;

private:
  /// A load on the unknowns it acts on.
  struct Load {
    std::vector<int> dofs;
    std::vector<double> values; ///< [force]
    const std::optional<Function>* function;
    double displacement = 0; ///< values · u
    double factor = 0;       ///< of the function, now
  };
  /// A support that moves.
  struct MovingSupport {
    const constraint::PrescribedDof* prescribed;
    double reaction = 0;
  };
  /// A dependent dof.
  struct Relation {
    const constraint::DependentDof* dependent;
    bool moves = false;  ///< whether what it is given changes with time
    double given = 0;    ///< its g at t [length]
    double change = 0;   ///< of g in the last step; where it moves
    double reaction = 0; ///< where it moves
  };

  Eigen::VectorXd counted_once(Eigen::VectorXd values) const;
  bool owns(int dof) const;
  bool counts() const;
  domain::Failed agreed(const domain::Failed& failed) const;
  double held_by(const Load& load) const;
  void collect_loads();
  void collect_supports();
  void find_given();
  void find_spectrum();
  double largest_damping(const domain::AddUp& add_up, const domain::Admit& admit) const;
  void set_step(double step);
  void impose_velocities();
  void move_related(double end);
  void hold_relations();
  domain::Failed step(double end);
  double rounding_since(const Eigen::VectorXd& before) const;
  void deform();
  domain::Failed find_forces();
  double kinetic_energy() const;
  double strain_energy() const;
  /// Sums over all ranks.
  EnergyLedger summed(const EnergyLedger& own) const;
  domain::Balance summed(const domain::Balance& own) const;
  Eigen::VectorXd whole_sum(Eigen::VectorXd sum) const;
  domain::QuadratureStates whole(domain::QuadratureStates states) const;
  void apply(Load& load);
  bool has_followers() const { return follower_force_.size() > 0; }
  void multiply_damping(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;
  void find_damping();
  bool is_damped() const { return damping_force_.size() > 0; }
  void find_followers();
  void enter_heat(double from, double to);
  void enter_contact(double from, double to);
  double work_of_obstacles(double from, double to) const;
  void enter_supports();
  void find_reactions();
  double imposed_acceleration(const MovingSupport& support) const;
  double given_acceleration(const Relation& relation) const;
  Eigen::VectorXd given_accelerations() const;
  Eigen::VectorXd related_force() const;
  Eigen::VectorXd unknown_acceleration() const;
  Eigen::VectorXd acceleration() const;
  void add_contact(const Eigen::VectorXd& constraint_forces, State& state) const;

  const model::Model* model_;
  std::shared_ptr<const constraint::Reduction> reduction_; ///< that of the model, until supports end
  std::optional<linalg::SymmetricBlockMatrix> damping_;    ///< nothing where all dashpots rotate
  /// Of each dof by itself; 0 where held, and where this rank does not know the motion.
  Eigen::VectorXd inverse_mass_;
  ConstrainedMass mass_;
  Eigen::VectorXd uncoupled_;    ///< of inverse_mass_ the unknowns that relations do not couple; else 0
  Eigen::VectorXd counted_mass_; ///< 0 where another rank counts it
  std::vector<Load> loads_;
  std::vector<MovingSupport> supports_;
  std::vector<Relation> relations_; ///< one a dependent dof
  std::vector<TiedZone> ties_;
  std::vector<contact::ExplicitPenalty> contact_; ///< of zones without a tie
  std::vector<std::size_t> touching_;             ///< their numbers
  std::vector<int> surface_;                      ///< unknowns that contact forces act on
  Spectrum spectrum_;                             ///< where nothing has happened
  double unrelated_stiffness_ = 0; ///< λ_K without relations: of springs of contact and of rounding

  double t_ = 0;
  double h_ = 0; ///< of the step before, and of the next one
  std::int64_t steps_ = 0;
  Eigen::VectorXd u_;                         ///< at t
  Eigen::VectorXd v_;                         ///< half a step before t
  domain::QuadratureStates bulk_points_;      ///< at t
  domain::QuadratureStates bulk_points_next_; ///< kept for its memory
  domain::LawPath path_;                      ///< to t
  Survey survey_;
  Eigen::VectorXd unbalance_;      ///< r at t
  Eigen::VectorXd contact_force_;  ///< at t, internal side
  Eigen::VectorXd damping_force_;  ///< at t; empty without damping
  Eigen::VectorXd heat_force_;     ///< at t; empty without temperatures
  Eigen::VectorXd follower_force_; ///< at t; empty without pressures that follow their faces
  /// Works and dissipations so far, the start, and the constant of kinetic energy; `impact` is all that
  /// contact took, stored and rubbed energy with it. Of several ranks their sum is meant; what all compute is
  /// with the first.
  EnergyLedger energy_;
};

} // namespace rubato::step
