// SPDX-License-Identifier: LGPL-3.0-or-later
/// One implicit step on the contact points alone, for a bulk that keeps its effective matrix A.
///
/// The motion from a base is d = A⁻¹(−R₀ − f₁ f_c), R₀ the residual of the base without contact. So contact
/// needs d only where its points are: d_s = d_free − f₁ S f_c, S = B A⁻¹ Bᵀ. Newton's iterates of the whole
/// system fulfil this from the first one on; they are computed here without the bulk, which is solved for
/// once, in halves: down to the surface before the iterates, and back from it after them
/// (linalg/split_factor.hpp).
///
/// Unknowns of an iteration are y = (δz, δξ) of each point in contact (contact/factored_response.hpp): the
/// change of its force and of its place on the master. Its own multipliers are eliminated point by point.
/// With C the change of force put on the dofs, f = f_c + Cᵀ y, and g = d_free − f₁ S f_c − d_s:
///   A₁ δz + A₂ δq = b,   δξ − P δq = 0,   δq = g − f₁ S Cᵀ y   at each point.
#pragma once

#include "rubato/contact/factored_response.hpp"
#include "rubato/step/contact_guess.hpp"
#include "rubato/step/contact_side.hpp"
#include "rubato/step/equilibrium.hpp"

#include <Eigen/Core>
#include <Eigen/QR>

#include <vector>

namespace rubato::step {

/// Whether every contact point of the model owns its multipliers and A is factored.
bool can_condense(const model::Model& model, const EffectiveSystem& system);

class Condensed {
public:
  /// Everything must outlive this.
  Condensed(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
            const State& committed, double t, const ContactSide& side);

  /// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step.
  StepReport run(State& trial, const Held& held);

private:
  /// A point in contact, its multipliers eliminated.
  struct ActivePoint {
    std::size_t zone = 0;
    std::size_t index = 0;
    contact::FactoredResponse response;
    std::vector<int> positions; ///< of q's dofs on the surface, −1 where a support holds them
    Eigen::MatrixXd equations;  ///< A₁ | A₂: d rows, d + q columns
    Eigen::VectorXd right;      ///< b
    /// Z_m over E_m, rows and columns scaled to entries of order one, factored.
    Eigen::HouseholderQR<Eigen::MatrixXd> by_multiplier;
    Eigen::VectorXd row_scale, column_scale;
    Eigen::Index first = 0; ///< of its y
    Eigen::Index unknowns() const { return response.components + response.slopes; }
  };

  void start_from(const State& trial);
  void guess_contact(State& trial, const Held& held);
  std::vector<GuessPoint> guess_points(const ContactIterate& contact, const Held& held,
                                       const State& trial) const;
  GuessPoint guess_point(const contact::ZoneState& state, const contact::ZoneLaw& law, std::size_t index,
                         const contact::Kinematics& k) const;
  void take_guess(const GuessPoint& guess, State& trial) const;
  void evaluate_contact(const State& trial, const Held& held, int iteration);
  void add_point(std::size_t zone, std::size_t index, const contact::ZoneLaw& law);
  void eliminate_multipliers(ActivePoint& point) const;
  bool settled(const Held& held);
  void measure_surface();
  bool iterate(State& trial, const Held& held);
  bool solve_points(Eigen::VectorXd& y);
  Eigen::MatrixXd answer_to(const ActivePoint& point, const Eigen::MatrixXd& s) const;
  void collect_touched();
  void move_surface(const Eigen::VectorXd& force, State& trial);
  void correct_multipliers(const Held& held, const Eigen::VectorXd& y, const Eigen::VectorXd& before,
                           State& trial) const;
  void move_bulk(State& trial);
  ContactForce contact_force() const;
  bool in_equilibrium(const State& trial, const ContactForce& force);
  StepReport ended(Outcome outcome);

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const ContactSide& side_;
  Equilibrium equilibrium_;
  ContactIterate now_, previous_;
  StepReport report_;
  double scale_; ///< of forces, what the residual is measured by

  bool started_ = false;
  time::Motion base_;
  Eigen::VectorXd half_way_; ///< L⁻¹(−R₀): the free motion, solved down to the surface
  Eigen::VectorXd free_;     ///< d_free on the surface
  Eigen::VectorXd moved_;    ///< d_s
  Eigen::VectorXd applied_;  ///< contact force on the surface that moved_ belongs to
  Eigen::VectorXd force_;    ///< f_c of the iterate
  std::vector<ActivePoint> active_;
  std::vector<int> touched_;    ///< surface positions that active points act on
  std::vector<int> touched_at_; ///< index in it of each surface position, or −1
};

} // namespace rubato::step
