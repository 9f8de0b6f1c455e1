// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/newton.hpp"

#include "rubato/step/cycle_detector.hpp"
#include "rubato/step/linear_step.hpp"
#include "rubato/step/projected_cg.hpp"

#include <algorithm>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

} // namespace

Newton::Newton(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
               const State& committed, double t, const ContactEvaluator& side, Pulse& pulse)
    : model_(model), scheme_(scheme), system_(system), side_(side), pulse_(pulse),
      equilibrium_(model, scheme, system, committed, t),
      contact_(committed.motion.u.size(), model.multiplier_count), force_(committed.motion.u.size()) {}

StepReport Newton::run(State& trial, const Held& held) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  side_.start_iterations();
  CycleDetector cycle;
  for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
    evaluate_contact(trial, held, iteration);
    equilibrium_.evaluate(trial.motion, force_);
    equilibrium_.measure(trial.motion, force_, report_);
    if (!equilibrium_.residual().allFinite())
      return ended(Outcome::not_finite, held);
    if (iteration > 0 && settled(trial, held)) {
      equilibrium_.finish(force_, trial);
      side_.finish(held, now_, trial);
      return ended(Outcome::converged, held);
    }
    const bool may_cycle = iteration > 0 && report_.status_changes > 0;
    const auto part = may_cycle ? cycle.part_of_next(now_, force_.all.norm()) : 1.0;
    if (!part)
      return ended(Outcome::cycling, held);
    if (iteration == model_.study.newton.max_iterations)
      break;
    if (!pulse_.beat(points_in_contact(), report_.residual))
      return ended(Outcome::interrupted, held);
    if (!solve_and_correct(*part, trial))
      return ended(pulse_.stopped() ? Outcome::interrupted : Outcome::singular_matrix, held);
    ++report_.iterations;
  }
  return ended(Outcome::too_many_iterations, held);
}

int Newton::points_in_contact() const {
  std::ptrdiff_t count = 0;
  for (const auto& zone : now_.status)
    count += std::ranges::count_if(zone, [](auto status) { return status != contact::Status::open; });
  return static_cast<int>(count);
}

StepReport Newton::ended(Outcome outcome, const Held& held) {
  report_.outcome = outcome;
  if (report_.failed()) {
    report_.worst = equilibrium_.worst();
    if (outcome != Outcome::not_finite)
      side_.name_unmet(held, report_.iterations > 0 ? &previous_ : nullptr, now_, report_);
    name_unbalance(report_);
  }
  return report_;
}

void Newton::evaluate_contact(const State& trial, const Held& held, int iteration) {
  std::swap(previous_, now_);
  side_.evaluate(trial, held, now_);
  if (iteration > 0)
    side_.renew_status(held, previous_, now_);
  contact_ = contact::ContactSystem(trial.motion.u.size(), model_.multiplier_count);
  force_ = ContactForce(trial.motion.u.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    add_zone(z, held);
  force_.all = contact_.force;
}

void Newton::add_zone(std::size_t z, const Held& held) {
  const VectorXd before = contact_.force;
  contact::add_contributions(side_.law_of(z, held), now_.points[z], now_.status[z], model_.dofs,
                             model_.multiplier_offsets[z], contact_);
  force_.for_zone(model_.zones[z], [&](VectorXd& part) { part += contact_.force - before; });
}

bool Newton::settled(const State& trial, const Held& held) {
  side_.collect_restless(held, previous_, now_, report_);
  const bool stalled = stall_.stalls(report_.residual);
  if (report_.status_changes > 0 || !side_.settled(held, previous_, now_))
    return false;
  const double wanted = wanted_residual(system_, report_.tolerance);
  const bool balanced = report_.residual <= wanted || (stalled && report_.residual <= report_.tolerance);
  if (!balanced && !(stalled && within_rounding(trial, held)))
    return false;
  report_.rounding = balanced ? 0 : report_.residual;
  return !side_.release_strays();
}

bool Newton::within_rounding(const State& trial, const Held& held) const {
  const auto stiffness = contact_stiffness(model_, system_, side_.friction_stiffness(held, now_));
  return equilibrium_.within_rounding(trial.motion, stiffness, 0, report_.tolerance);
}

bool Newton::solve_and_correct(double part, State& trial) {
  const LinearProblem problem{model_, system_.matrix, scheme_.contact_weight(), contact_,
                              equilibrium_.residual()};
  std::optional<LinearSolution> solution;
  if (finds_forces(model_))
    solution = solve_projected_cg(problem, system_.compliance.get(), now_.points, trial.zones, pulse_);
  else
    solution = solve_full(problem);
  if (!solution || !solution->displacement.allFinite() || !solution->multipliers.allFinite())
    return false;
  const VectorXd d = model_.reduction.scatter(part * solution->displacement);
  time::correct(system_.coefficients, d, trial.motion);
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    trial.zones[z].multipliers += part * solution->multipliers.segment(model_.multiplier_offsets[z],
                                                                       model_.zones[z].multiplier_count());
  return true;
}

} // namespace rubato::step
