// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iterations of a nonlinear bulk around whatever solves a step with one tangent: what every
/// iterate of the bulk asks for, and when there are too many of them.
#pragma once

#include "rubato/step/common/bulk_tangent.hpp"
#include "rubato/step/common/equilibrium.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace rubato::step {

/// From one motion part of the way to another.
time::Motion between(const time::Motion& from, const time::Motion& to, double part);

class BulkNewton {
public:
  /// Everything must outlive this.
  BulkNewton(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
             const State& committed, double t, Factored factored, SpringsOfContact springs = {});

  /// What the first iterate starts from. Then the factor may be another one.
  const BulkStart& start();

  /// Whether there is no factor to start with: the matrix is not positive definite.
  bool starts_indefinite() const { return tangent_.starts_indefinite(); }

  /// Shortens the move from `from` until every cell has forces. Nothing comes back when that has no end.
  /// How much of the move is left, else.
  std::optional<double> shorten(const time::Motion& from, time::Motion& to, Equilibrium& equilibrium) const;

  /// Iterates are given up when so many do not halve the least residual before them; `lets_fall`: unless the
  /// last is below half of the largest of these, as where slender bodies bend.
  void hurry(int patience, bool lets_fall) {
    hurries_ = true;
    patience_ = patience;
    lets_fall_ = lets_fall;
  }
  bool is_given_up() const { return given_up_; }
  /// Goes on after that from an iterate that left so much out of balance, with a tangent of its own, and as
  /// often as if it were the first.
  void go_on_from(const Eigen::VectorXd& u, double unbalanced);

  /// BulkTangent::set_load_factor
  void set_load_factor(double factor) { tangent_.set_load_factor(factor); }

  /// What is out of balance before the first iterate [force].
  void start_with(double unbalanced);
  /// After an iterate at `u` that leaves so much out of balance, with so much allowed: an outcome ends the
  /// step.
  std::optional<Outcome> go_on(const Eigen::VectorXd& u, double unbalanced, double allowed);
  /// Whether the factor is another one now.
  bool renewed() const { return renewed_; }
  /// Whether the iterate is to be left for another one from where it came from, with the new factor: an old
  /// one has led astray.
  bool goes_back() const { return goes_back_; }
  /// Where it came from, if that is the start of the step: with the tangent that is there now. Else null.
  const BulkStart* back_at_start() const { return at_start_ ? &*start_ : nullptr; }

  /// Whether the tangent was taken where the iterate came from, and what was out of balance there [force].
  bool is_fresh() const { return is_fresh_; }
  double unbalanced_at_base() const { return last_; }

  /// What there is to tell of a step whose outcome the report has already.
  void fill(StepReport& report, const Equilibrium& equilibrium) const;
  bool is_indefinite() const { return tangent_.is_indefinite(); }

private:
  void go_back_with_new_tangent();
  bool stagnates() const;

  const model::Model& model_;
  EffectiveSystem& system_;
  BulkTangent tangent_;
  std::optional<BulkStart> start_;
  Eigen::VectorXd base_;                                  ///< displacements that the iterate was reached from
  bool at_start_ = true;                                  ///< whether that is the start of the step
  bool is_fresh_ = false;                                 ///< whether the tangent was taken there
  double last_ = std::numeric_limits<double>::infinity(); ///< out of balance there [force]
  std::vector<double> residuals_; ///< at the start and at every iterate, those that were left among them
  int iterations_ = 0;
  int before_ = 0;  ///< those that were given up
  int growing_ = 0; ///< iterates one after the other that had a tangent of their own and made it worse
  bool renewed_ = false;
  bool goes_back_ = false;
  bool hurries_ = false;
  std::ptrdiff_t patience_ = 0;
  bool lets_fall_ = false;
  bool given_up_ = false;
};

} // namespace rubato::step
