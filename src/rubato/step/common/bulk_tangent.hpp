// SPDX-License-Identifier: LGPL-3.0-or-later
/// The tangent of a nonlinear bulk within one step: where it is taken, and when the effective matrix is made
/// of a new one.
#pragma once

#include "rubato/domain/evaluation.hpp"
#include "rubato/domain/quadrature_states.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace rubato::step {

/// Whether internal forces of the scheme are those of the end of a step, or of the whole of it.
domain::ForcesOf forces_of(const time::Scheme& scheme);

/// What a step starts from: the internal forces at the displacements of its start, at its end instant.
struct BulkStart {
  Eigen::VectorXd forces; ///< [force]
  Tangent tangent;        ///< that of the system
};

/// Whether the matrix is factored, or only made: with contact in it, it is another one in every iteration.
enum class Factored { yes, no };

/// In which directions springs hold the points that touch: as contact does, or in every one.
enum class Held { as_contact, everywhere };
/// Springs where contact holds the bodies, at the iterate that it was evaluated at last; none where nothing
/// does.
using SpringsOfContact = std::function<std::vector<NodeSpring>(Held)>;

class BulkTangent {
public:
  /// Everything must outlive this. `springs` are asked for where a matrix is not positive definite.
  BulkTangent(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
              const State& committed, double t, Factored factored, SpringsOfContact springs);

  /// Goes on with the tangent that the step before ended with, unless every iteration is to have its own or
  /// that step had another length. Depends on the committed state alone, so that a resumed run does the same.
  BulkStart start();
  /// Whether `start` took a tangent for the step.
  bool is_fresh_at_start() const;

  /// After an iteration that has led from one unbalanced force to another, with so much allowed: whether a
  /// new factor is worth it.
  bool wants_renewal(double before, double now, double allowed) const;

  /// Takes the tangent at these displacements, the exact one of forces over a step where the matrix need not
  /// be symmetric. False when the matrix is not positive definite or a cell has no answer: then the factor
  /// before serves on.
  bool renew_at(const Eigen::VectorXd& u);
  /// Takes it a small part of the way that the step would go by itself: there cells that yield know in which
  /// direction.
  bool renew_at_start();

  /// Of the loads that have one: tangents of pressures that follow have it from then on.
  void set_load_factor(double factor) { load_factor_ = factor; }

  int renewals() const { return renewals_; }
  /// Whether a matrix was not positive definite, and whether that of the start was not even with the springs
  /// of contact.
  bool is_indefinite() const { return indefinite_; }
  bool starts_indefinite() const { return starts_indefinite_; }

private:
  Eigen::VectorXd slightly_on() const;
  Tangent at(const Eigen::VectorXd& u, Eigen::VectorXd* forces,
             domain::TangentOf of = domain::TangentOf::symmetric);
  void add_dashpots(const Eigen::VectorXd& u);
  bool put(const Tangent& tangent);
  bool put_held(const Tangent& tangent);
  void go_on_with(const Tangent& tangent);
  double factor_in_iterations() const;

  const model::Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  double t_;
  Factored factored_;
  double load_factor_;
  SpringsOfContact springs_;
  std::size_t level_ = 0;      ///< of springs, which only rises
  model::SparseMatrix matrix_; ///< storage of tangents
  domain::QuadratureStates unused_;
  int renewals_ = 0;
  bool indefinite_ = false;
  bool starts_indefinite_ = false;
};

} // namespace rubato::step
