// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/newton.hpp"

#include "rubato/step/linear_step.hpp"
#include "rubato/step/projected_cg.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using contact::PointEvaluation;
using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Motion of contact points' projections between two iterates, in reference lengths of a face, that counts as
/// settled (Code_Aster's RESI_GEOM for Newton).
constexpr double settled_geometry = 1e-6;
/// Gap of a point in contact, in shortest master edges, that counts as closed.
constexpr double closed_gap = 1e-9;
/// Rounding errors that a row of K u may gather, in units of the last digit of its largest term.
constexpr double rounding_steps = 16;

VectorXd multiply(const model::SparseMatrix& matrix, const VectorXd& v) {
  return matrix.nonZeros() > 0 ? VectorXd(matrix * v) : VectorXd::Zero(v.size());
}

VectorXd history_forces(const Model& model, const time::Scheme& scheme, const State& committed) {
  VectorXd history = scheme.forces.before * committed.unbalance;
  if (scheme.inertia.before != 0)
    history += scheme.inertia.before * multiply(model.mass, committed.motion.a);
  if (scheme.damping.before != 0)
    history += scheme.damping.before * multiply(model.damping, committed.motion.v);
  return history;
}

/// Augmentations may be anything; penalties are the user's.
void vary(const contact::Zone& zone, const Variant& variant, contact::ZoneCoefficients& coefficients) {
  if (contact::is_exact(zone.settings.method))
    for (auto& normal : coefficients.normal)
      normal *= variant.normal_multiple;
  if (zone.settings.friction_method == deck::FrictionMethod::augmented_lagrangian)
    for (auto& tangential : coefficients.tangential)
      tangential *= variant.tangential_multiple;
}

/// The statuses a solve starts with, where a point can have them.
void keep_given_status(const contact::Zone& zone, const std::vector<PointEvaluation>& points,
                       const std::vector<Status>& given, std::vector<Status>& status) {
  status.assign(points.size(), Status::open);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].kinematics && !zone.points[i].excluded)
      status[i] = given[i];
}

bool by_projected_cg(const Model& model) {
  return !model.zones.empty() && model.zones.front().settings.method == deck::ContactMethod::nodal_pcg;
}

} // namespace

Newton::Newton(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
               const State& committed, double t, const Variant& variant)
    : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t), variant_(variant),
      external_(model::external_force(model, t)), history_(history_forces(model, scheme, committed)),
      coefficients_(system.zones), contact_(committed.motion.u.size(), model.multiplier_count) {
  for (std::size_t z = 0; z < coefficients_.size(); ++z)
    vary(model.zones[z], variant, coefficients_[z]);
}

StepReport Newton::run(State& trial, const Held& held) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
    evaluate_contact(trial, held, iteration);
    evaluate_residual(trial);
    if (!residual_.allFinite())
      return ended(Outcome::not_finite);
    if (iteration > 0 && settled(held)) {
      finish(trial, held);
      return ended(Outcome::converged);
    }
    if (iteration == model_.study.newton.max_iterations)
      break;
    if (!solve_and_correct(trial))
      return ended(Outcome::singular_matrix);
    ++report_.iterations;
  }
  return ended(Outcome::too_many_iterations);
}

StepReport Newton::ended(Outcome outcome) {
  report_.outcome = outcome;
  return report_;
}

contact::ZoneLaw Newton::law_of(std::size_t zone, const Held& held) const {
  return {&model_.zones[zone], coefficients_[zone],
          variant_.friction_part * model_.zones[zone].settings.friction, held[zone].thresholds};
}

ContactIterate Newton::contact_at(const State& trial, const Held& held) const {
  const contact::Configuration configuration{&model_.mesh, &model_.dofs, &trial.motion.u,
                                             &committed_.motion.u};
  ContactIterate iterate;
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto& zone = model_.zones[z];
    const auto& multipliers = trial.zones[z].multipliers;
    iterate.points.push_back(held[z].frames.empty() ? contact::evaluate(zone, multipliers, configuration)
                                                    : contact::evaluate_in_held_frames(
                                                          held[z].frames, zone, multipliers, configuration));
    keep_given_status(zone, iterate.points[z], trial.zones[z].status, iterate.status.emplace_back());
  }
  return iterate;
}

void Newton::evaluate_contact(const State& trial, const Held& held, int iteration) {
  previous_ = std::move(now_);
  now_ = contact_at(trial, held);
  contact_ = contact::ContactSystem(trial.motion.u.size(), model_.multiplier_count);
  forgotten_ = nodal_force_ = VectorXd::Zero(trial.motion.u.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    if (!held[z].status.empty())
      now_.status[z] = held[z].status;
    else if (iteration > 0)
      now_.status[z] = contact::wanted_status(law_of(z, held), now_.points[z]);
    add_zone(z, held);
  }
}

void Newton::add_zone(std::size_t z, const Held& held) {
  const auto& settings = model_.zones[z].settings;
  const VectorXd before = contact_.force;
  contact::add_contributions(law_of(z, held), now_.points[z], now_.status[z], model_.dofs,
                             model_.multiplier_offsets[z], contact_);
  if (!settings.history_force)
    forgotten_ += contact_.force - before;
  if (deck::is_nodal(settings.method))
    nodal_force_ += contact_.force - before;
}

void Newton::evaluate_residual(const State& trial) {
  inertia_ = scheme_.inertia.now != 0 ? VectorXd(scheme_.inertia.now * multiply(model_.mass, trial.motion.a))
                                      : VectorXd::Zero(trial.motion.u.size());
  if (scheme_.damping.now != 0)
    inertia_ += scheme_.damping.now * multiply(model_.damping, trial.motion.v);
  unbalance_ = model_.stiffness * trial.motion.u + contact_.force - external_;
  full_residual_ = inertia_ + scheme_.forces.now * unbalance_ + history_;
  residual_ = full_residual_(model_.free_dofs);
  measure_residual(trial);
}

/// Code_Aster's RESI_GLOB_RELA: the largest unbalanced force over the largest of reactions and applied
/// forces (inertia, history and the forces of nodal methods among them), and of the momentum's rate.
void Newton::measure_residual(const State& trial) {
  VectorXd reference = scheme_.forces.now * (external_ - nodal_force_) - inertia_ - history_;
  for (const auto& constraint : model_.constraints)
    reference[constraint.dof] -= full_residual_[constraint.dof];
  double scale = reference.lpNorm<Eigen::Infinity>();
  if (scheme_.dynamic)
    scale = std::max(scale, multiply(model_.mass, trial.motion.v).lpNorm<Eigen::Infinity>() *
                                system_.coefficients.acceleration * system_.step);
  Index worst = 0;
  const double largest = residual_.size() > 0 ? residual_.cwiseAbs().maxCoeff(&worst) : 0.0;
  // Where nothing but rounding is left there is no force to measure it by: a body that moves without
  // strain.
  const double rounding = rounding_steps * std::numeric_limits<double>::epsilon() *
                          system_.diagonal.lpNorm<Eigen::Infinity>() *
                          trial.motion.u.lpNorm<Eigen::Infinity>();
  report_.residual = largest == 0 || std::max(largest, scale) <= rounding ? 0 : largest / scale;
  report_.worst_node =
      residual_.size() > 0 ? model_.node_of(model_.free_dofs[static_cast<std::size_t>(worst)]) : -1;
}

bool Newton::settled(const Held& held) {
  collect_restless(held);
  return report_.residual <= report_.tolerance && report_.status_changes == 0 && geometry_settled(held) &&
         gaps_closed();
}

void Newton::collect_restless(const Held& held) {
  report_.status_changes = 0;
  report_.restless.clear();
  for (std::size_t z = 0; z < now_.status.size(); ++z)
    for (std::size_t i = 0; held[z].status.empty() && i < now_.status[z].size(); ++i)
      if (now_.status[z][i] != previous_.status[z][i]) {
        ++report_.status_changes;
        report_.restless.push_back({static_cast<int>(z), model_.zones[z].points[i].nodes.front()});
      }
}

bool Newton::geometry_settled(const Held& held) const {
  for (std::size_t z = 0; z < now_.points.size(); ++z)
    for (std::size_t i = 0; held[z].frames.empty() && i < now_.points[z].size(); ++i) {
      if (now_.status[z][i] == Status::open)
        continue;
      const auto& now = now_.points[z][i].pair;
      const auto& before = previous_.points[z][i].pair;
      const bool same_face = now.master_face == before.master_face;
      // A point on the border of two faces may belong to either; its place is the same.
      if (same_face && (now.projection.clamped - before.projection.clamped).norm() > settled_geometry)
        return false;
    }
  return true;
}

bool Newton::gaps_closed() const {
  for (std::size_t z = 0; z < now_.points.size(); ++z) {
    const auto& zone = model_.zones[z];
    const double allowed = closed_gap * zone.master.shortest_edge;
    for (std::size_t i = 0; contact::is_exact(zone.settings.method) && i < now_.points[z].size(); ++i)
      if (now_.status[z][i] != Status::open && zone.points[i].node_position >= 0 &&
          std::abs(now_.points[z][i].variables.gap) > allowed)
        return false;
  }
  return true;
}

bool Newton::solve_and_correct(State& trial) {
  const LinearProblem problem{model_, system_.matrix, scheme_.forces.now, contact_, residual_};
  std::optional<LinearSolution> solution;
  if (by_projected_cg(model_))
    solution = solve_projected_cg(problem, system_.compliance, now_.points, trial.zones);
  else if (system_.compliance)
    solution = solve_condensed(problem, *system_.compliance);
  if (!solution && !by_projected_cg(model_))
    solution = solve_full(problem);
  if (!solution || !solution->displacement.allFinite() || !solution->multipliers.allFinite())
    return false;
  VectorXd d = VectorXd::Zero(trial.motion.u.size());
  d(model_.free_dofs) = solution->displacement;
  time::correct(system_.coefficients, d, trial.motion);
  for (std::size_t z = 0; z < model_.zones.size(); ++z)
    trial.zones[z].multipliers +=
        solution->multipliers.segment(model_.multiplier_offsets[z], model_.zones[z].multiplier_count());
  return true;
}

/// Stores what the next step and the results need.
void Newton::finish(State& trial, const Held& held) const {
  trial.t = t_;
  trial.unbalance = unbalance_ - forgotten_;
  trial.contact_force = contact_.force;
  trial.reaction = VectorXd::Zero(unbalance_.size());
  for (const auto& constraint : model_.constraints)
    trial.reaction[constraint.dof] = full_residual_[constraint.dof];
  for (std::size_t z = 0; z < now_.status.size(); ++z) {
    trial.zones[z].status = now_.status[z];
    trial.zones[z].outcomes = contact::outcomes(law_of(z, held), now_.points[z], now_.status[z]);
  }
}

} // namespace rubato::step
