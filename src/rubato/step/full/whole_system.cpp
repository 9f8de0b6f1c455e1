// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/full/whole_system.hpp"

#include <algorithm>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

/// Without contact zones it is that of the whole system.
bool has_factor(const Model& model, const EffectiveSystem& system, const RetrySettings& variant) {
  return system.compliance && model.zones.empty() && !variant.exact_tangent;
}

} // namespace

WholeSystem::WholeSystem(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                         const State& committed, double t, ContactEvaluator& side, Progress&)
    : model_(model), scheme_(scheme), system_(system), side_(side),
      equilibrium_(model, scheme, system, committed, t), factored_(has_factor(model, system, side.variant())),
      contact_(committed.motion.u.size(), model.multiplier_count), force_(committed.motion.u.size()) {
  if (!model.domain.is_linear())
    bulk_.emplace(model, scheme, system, committed, t, factored_ ? Factored::yes : Factored::no);
}

std::optional<Outcome> WholeSystem::start(State&, const Frozen&) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  side_.start_iterations();
  if (bulk_ && !started_)
    bulk_->start();
  start_ = bulk_ && !started_;
  started_ = true;
  return std::nullopt;
}

void WholeSystem::evaluate(const State& trial, const Frozen& frozen, int iteration) {
  evaluate_contact(trial, frozen, iteration);
  if (start_)
    equilibrium_.evaluate_ahead(trial.motion, force_, *bulk_->back_at_start());
  else
    equilibrium_.evaluate(trial.motion, force_);
  equilibrium_.measure(trial.motion, force_, report_);
}

std::optional<Outcome> WholeSystem::close(State& trial, const Frozen& frozen) {
  equilibrium_.finish(force_, trial);
  side_.finish(frozen, now_, trial);
  if (bulk_)
    trial.indefinite = bulk_->is_indefinite() || !factored_;
  return Outcome::converged;
}

int WholeSystem::points_in_contact() const {
  std::ptrdiff_t count = 0;
  for (const auto& zone : now_.status)
    count += std::ranges::count_if(zone, [](auto status) { return status != contact::Status::open; });
  return static_cast<int>(count);
}

StepReport WholeSystem::ended(Outcome outcome, const Frozen& frozen) {
  report_.outcome = outcome;
  if (bulk_)
    bulk_->fill(report_, equilibrium_);
  if (report_.failed()) {
    report_.worst = equilibrium_.worst();
    if (outcome != Outcome::not_finite && outcome != Outcome::cell_failed)
      side_.name_unmet(frozen, report_.iterations > 0 ? &previous_ : nullptr, now_, report_);
    name_residual_growth(report_);
  }
  return report_;
}

void WholeSystem::evaluate_contact(const State& trial, const Frozen& frozen, int iteration) {
  std::swap(previous_, now_);
  side_.evaluate(trial, frozen, now_);
  if (iteration > 0)
    side_.renew_status(frozen, previous_, now_);
  else
    side_.restrict_friction(frozen, now_);
  contact_ = contact::ContactSystem(trial.motion.u.size(), model_.multiplier_count);
  force_ = ContactForce(trial.motion.u.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    add_zone(z, frozen);
  force_.all = contact_.force;
  add_slope_changes(trial.motion);
}

/// To the matrix alone; blocks of contact are weighted when the system is solved.
void WholeSystem::add_slope_changes(const time::Motion& motion) {
  for (const auto& connector : model_.connectors) {
    if (!connector.force && !connector.damper)
      continue;
    const double change = slope_change(connector, system_.coefficients, motion) / scheme_.contact_weight();
    for (const auto& a : connector.row)
      for (const auto& b : connector.row)
        contact_.force_by_dof.emplace_back(a.dof, b.dof, change * a.coefficient * b.coefficient);
  }
}

void WholeSystem::add_zone(std::size_t z, const Frozen& frozen) {
  const VectorXd before = contact_.force;
  contact::add_contributions(side_.law_of(z, frozen), now_.points[z], now_.status[z], model_.dofs,
                             model_.multiplier_offsets[z], contact_);
  force_.for_zone(model_.zones[z], [&](VectorXd& part) { part += contact_.force - before; });
}

bool WholeSystem::is_settled(const State& trial, const Frozen& frozen) {
  side_.collect_status_changes(frozen, previous_, now_, report_);
  const bool stalled = stall_.stalls(report_.residual);
  const double negligible = report_.tolerance * equilibrium_.scale();
  if ((report_.status_changes > 0 && side_.has_decisive_changes(frozen, previous_, now_, negligible)) ||
      !side_.settled(frozen, previous_, now_))
    return false;
  const double wanted = wanted_residual(system_, report_.tolerance);
  const bool balanced = report_.residual <= wanted || (stalled && report_.residual <= report_.tolerance);
  if (!balanced && !(stalled && within_rounding(trial, frozen)))
    return false;
  report_.rounding = balanced ? 0 : report_.residual;
  return !side_.release_beyond_borders();
}

bool WholeSystem::within_rounding(const State& trial, const Frozen& frozen) const {
  const auto stiffness = contact_stiffness(model_, system_, side_.spring_stiffness(frozen, now_),
                                           side_.friction_stiffness(frozen, now_));
  return equilibrium_.within_rounding(trial.motion, stiffness, 0, report_.tolerance);
}

std::optional<LinearSolution> WholeSystem::solution(const time::Motion& motion) const {
  if (factored_)
    return LinearSolution{
        system_.compliance->solve(-system_.slopes.adjusted(equilibrium_.residual(), motion)), {}};
  return solve_full({model_, system_.matrix, scheme_.contact_weight(), contact_, equilibrium_.residual()});
}

/// An outcome ends the step.
std::optional<Outcome> WholeSystem::go_on_from(State& trial, const Frozen& frozen) {
  if (start_) {
    bulk_->start_with(report_.unbalanced_force);
    start_ = false;
    return std::nullopt;
  }
  const double allowed = report_.tolerance * equilibrium_.scale();
  if (const auto outcome = bulk_->go_on(trial.motion.u, report_.unbalanced_force, allowed))
    return outcome;
  if (!bulk_->goes_back())
    return std::nullopt;
  trial.motion = before_.motion;
  trial.zones = before_.zones;
  evaluate_contact(trial, frozen, report_.iterations);
  if (const auto* start = bulk_->back_at_start())
    equilibrium_.evaluate_ahead(trial.motion, force_, *start);
  else
    equilibrium_.evaluate(trial.motion, force_);
  return std::nullopt;
}

std::optional<Outcome> WholeSystem::correct(State& trial, const Frozen& frozen, double part) {
  if (bulk_)
    if (const auto outcome = go_on_from(trial, frozen))
      return outcome;
  const auto found = solution(trial.motion);
  if (!found || !found->displacement.allFinite() || !found->multipliers.allFinite())
    return Outcome::singular_matrix;
  const VectorXd d = model_.reduction.scatter(part * found->displacement);
  if (bulk_)
    before_ = {trial.motion, trial.zones};
  time::correct(system_.coefficients, d, trial.motion);
  if (bulk_ && !bulk_->shorten(before_.motion, trial.motion, equilibrium_))
    return Outcome::cell_failed;
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    trial.zones[z].multipliers +=
        part * found->multipliers.segment(model_.multiplier_offsets[z], model_.zones[z].multiplier_count());
  return std::nullopt;
}

} // namespace rubato::step
