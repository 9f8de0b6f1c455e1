// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/bulk_newton.hpp"

#include "rubato/model/model.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// A move that no cell follows even then is not one that converges.
constexpr int most_halvings = 6;
/// Residuals that grow from tangent to tangent do not come back.
constexpr int most_growing = 4;

} // namespace

time::Motion between(const time::Motion& from, const time::Motion& to, double part) {
  const auto mix = [part](const VectorXd& a, const VectorXd& b) { return VectorXd(a + part * (b - a)); };
  return {mix(from.u, to.u), mix(from.v, to.v), mix(from.a, to.a)};
}

BulkNewton::BulkNewton(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                       const State& committed, double t, Factored factored, SpringsOfContact springs)
    : model_(model), system_(system),
      tangent_(model, scheme, system, committed, t, factored, std::move(springs)) {}

const BulkStart& BulkNewton::start() {
  const auto before = system_.factored;
  start_ = tangent_.start();
  renewed_ = !same_values(model_, before, system_.factored);
  is_fresh_ = tangent_.is_fresh_at_start();
  return *start_;
}

std::optional<double> BulkNewton::shorten(const time::Motion& from, time::Motion& to,
                                          Equilibrium& equilibrium) const {
  double part = 1;
  for (int halvings = 0; !equilibrium.has_forces_at(to.u); ++halvings) {
    if (halvings == most_halvings)
      return std::nullopt;
    to = between(from, to, 0.5);
    part *= 0.5;
  }
  return part;
}

void BulkNewton::start_with(double unbalanced) {
  last_ = unbalanced;
  residuals_.push_back(unbalanced);
}

std::optional<Outcome> BulkNewton::go_on(const VectorXd& u, double unbalanced, double allowed) {
  ++iterations_;
  residuals_.push_back(unbalanced);
  renewed_ = goes_back_ = false;
  if (iterations_ - before_ >= model_.study.newton.max_iterations)
    return Outcome::too_many_iterations;
  given_up_ = hurries_ && stagnates();
  if (given_up_)
    return Outcome::too_many_iterations;
  if (!is_fresh_ && !(unbalanced < last_))
    go_back_with_new_tangent();
  if (goes_back_)
    return std::nullopt;
  if (tangent_.wants_renewal(last_, unbalanced, allowed)) {
    growing_ = is_fresh_ && !(unbalanced < last_) ? growing_ + 1 : 0;
    if (growing_ > most_growing)
      return Outcome::too_many_iterations;
    renewed_ = is_fresh_ = tangent_.renew_at(u);
  } else {
    is_fresh_ = false;
  }
  base_ = u;
  at_start_ = false;
  last_ = unbalanced;
  return std::nullopt;
}

void BulkNewton::go_on_from(const VectorXd& u, double unbalanced) {
  hurries_ = goes_back_ = at_start_ = false;
  before_ = iterations_;
  growing_ = 0;
  base_ = u;
  last_ = unbalanced;
  renewed_ = is_fresh_ = tangent_.renew_at(u);
}

bool BulkNewton::stagnates() const {
  if (std::ssize(residuals_) <= patience_)
    return false;
  const auto last = residuals_.end() - patience_;
  if (lets_fall_ && residuals_.back() < 0.5 * *std::max_element(last, residuals_.end()))
    return false;
  return *std::min_element(last, residuals_.end()) > 0.5 * *std::min_element(residuals_.begin(), last);
}

void BulkNewton::go_back_with_new_tangent() {
  is_fresh_ = true;
  const auto before = system_.tangent;
  goes_back_ = (at_start_ ? tangent_.renew_at_start() : tangent_.renew_at(base_)) &&
               !same_values(model_, before, system_.tangent);
  renewed_ = goes_back_;
  if (at_start_)
    start_->tangent = system_.tangent;
}

void BulkNewton::fill(StepReport& report, const Equilibrium& equilibrium) const {
  report.bulk_iterations = iterations_;
  report.factorisations = tangent_.renewals();
  report.bulk_residuals = residuals_;
  if (report.converged())
    report.bulk_residuals.push_back(report.unbalanced_force);
  report.indefinite = tangent_.is_indefinite();
  report.stagnates = given_up_ || before_ > 0;
  report.failed_cell = equilibrium.failed();
  if (report.failed() && report.failed_cell)
    report.unmet.push_back({Criterion::cell, -1, model_.mesh.nodes_of(report.failed_cell->cell).front()});
}

} // namespace rubato::step
