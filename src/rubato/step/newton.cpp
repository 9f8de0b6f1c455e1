// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/newton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using contact::PointEvaluation;
using contact::Status;
using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Motion of contact points' projections between two iterates, in longest master edges, that counts as
/// settled (Code_Aster's RESI_GEOM for Newton).
constexpr double settled_geometry = 1e-6;
/// Gap of a point in contact, in shortest master edges, that counts as closed.
constexpr double closed_gap = 1e-9;
/// Rounding errors that a row of K u may gather, in units of the last digit of its largest term.
constexpr double rounding_steps = 16;
/// Parts of μ tried one after the other, each from the last one's solution, when the whole of it fails.
constexpr std::array<double, 5> friction_parts{0, 0.25, 0.5, 0.75, 1};

/// Contact of all zones at one iterate.
struct ContactIterate {
  std::vector<std::vector<PointEvaluation>> points;
  std::vector<std::vector<Status>> status;
};

/// How an attempt at the step differs from the plain one.
struct Variant {
  double friction_part = 1;       ///< of μ
  double normal_multiple = 1;     ///< of c
  double tangential_multiple = 1; ///< of c_t
};

/// Augmentations tried one after the other. They do not change the answer, only which points are guessed to
/// touch and to stick on the way there.
constexpr std::array<Variant, 3> augmentations{{{1, 1, 1}, {1, 0.01, 0.1}, {1, 10, 10}}};

class NewtonSolve {
public:
  NewtonSolve(const Model& model, const time::Scheme& scheme, EffectiveSystem& system, const State& committed,
              double t, const Variant& variant)
      : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t), variant_(variant),
        external_(model::external_force(model, t)), history_(history_forces()), coefficients_(system.zones),
        contact_(committed.motion.u.size(), model.multiplier_count) {
    for (auto& zone : coefficients_) {
      for (auto& normal : zone.normal)
        normal *= variant.normal_multiple;
      for (auto& tangential : zone.tangential)
        tangential *= variant.tangential_multiple;
    }
  }

  /// Iterates from `trial` (u, v, a, multipliers and statuses) to the end of the step.
  StepReport run(State& trial) {
    report_.tolerance = model_.study.newton.residual;
    report_.outcome = Outcome::too_many_iterations;
    for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
      evaluate_contact(trial, iteration);
      evaluate_residual(trial);
      if (!residual_.allFinite())
        return ended(Outcome::not_finite);
      if (iteration > 0 && settled()) {
        finish(trial);
        return ended(Outcome::converged);
      }
      if (iteration == model_.study.newton.max_iterations)
        break;
      if (!solve_and_correct(trial))
        return ended(Outcome::singular_matrix);
      ++report_.iterations;
    }
    return report_;
  }

private:
  StepReport ended(Outcome outcome) {
    report_.outcome = outcome;
    return report_;
  }

  VectorXd multiply(const model::SparseMatrix& matrix, const VectorXd& v) const {
    return matrix.nonZeros() > 0 ? VectorXd(matrix * v) : VectorXd::Zero(v.size());
  }

  VectorXd history_forces() const {
    VectorXd history = scheme_.forces.before * committed_.unbalance;
    if (scheme_.inertia.before != 0)
      history += scheme_.inertia.before * multiply(model_.mass, committed_.motion.a);
    if (scheme_.damping.before != 0)
      history += scheme_.damping.before * multiply(model_.damping, committed_.motion.v);
    return history;
  }

  double friction_of(const contact::Zone& zone) const {
    return variant_.friction_part * zone.settings.friction;
  }

  void evaluate_contact(const State& trial, int iteration) {
    previous_ = std::move(now_);
    now_ = {};
    const contact::Configuration configuration{&model_.mesh, &model_.dofs, &trial.motion.u,
                                               &committed_.motion.u};
    contact_ = contact::ContactSystem(trial.motion.u.size(), model_.multiplier_count);
    for (std::size_t z = 0; z < model_.zones.size(); ++z) {
      const auto& zone = model_.zones[z];
      auto points = contact::evaluate(zone, trial.zones[z].multipliers, configuration);
      auto status = contact::wanted_status(zone, coefficients_[z], friction_of(zone), points);
      if (iteration == 0)
        keep_given_status(zone, points, trial.zones[z].status, status);
      contact::add_contributions(zone, coefficients_[z], friction_of(zone), points, status, model_.dofs,
                                 model_.multiplier_offsets[z], contact_);
      now_.points.push_back(std::move(points));
      now_.status.push_back(std::move(status));
    }
  }

  /// The step starts with the statuses it was given, where a point can have them.
  static void keep_given_status(const contact::Zone& zone, const std::vector<PointEvaluation>& points,
                                const std::vector<Status>& given, std::vector<Status>& status) {
    for (std::size_t i = 0; i < points.size(); ++i)
      if (points[i].kinematics && !zone.points[i].excluded)
        status[i] = given[i];
  }

  void evaluate_residual(const State& trial) {
    inertia_ = scheme_.inertia.now != 0
                   ? VectorXd(scheme_.inertia.now * multiply(model_.mass, trial.motion.a))
                   : VectorXd::Zero(trial.motion.u.size());
    if (scheme_.damping.now != 0)
      inertia_ += scheme_.damping.now * multiply(model_.damping, trial.motion.v);
    unbalance_ = model_.stiffness * trial.motion.u + contact_.force - external_;
    full_residual_ = inertia_ + scheme_.forces.now * unbalance_ + history_;
    residual_ = full_residual_(model_.free_dofs);
    measure_residual(trial);
  }

  /// Code_Aster's RESI_GLOB_RELA: the largest unbalanced force over the largest of reactions and applied
  /// forces (inertia and history among them), and of the momentum's rate.
  void measure_residual(const State& trial) {
    VectorXd reference = scheme_.forces.now * external_ - inertia_ - history_;
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

  bool settled() {
    collect_restless();
    return report_.residual <= report_.tolerance && report_.status_changes == 0 && geometry_settled() &&
           gaps_closed();
  }

  void collect_restless() {
    report_.status_changes = 0;
    report_.restless.clear();
    for (std::size_t z = 0; z < now_.status.size(); ++z)
      for (std::size_t i = 0; i < now_.status[z].size(); ++i)
        if (now_.status[z][i] != previous_.status[z][i]) {
          ++report_.status_changes;
          report_.restless.push_back({static_cast<int>(z), model_.zones[z].points[i].nodes.front()});
        }
  }

  bool geometry_settled() const {
    for (std::size_t z = 0; z < now_.points.size(); ++z)
      for (std::size_t i = 0; i < now_.points[z].size(); ++i) {
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

  bool gaps_closed() const {
    for (std::size_t z = 0; z < now_.points.size(); ++z)
      for (std::size_t i = 0; i < now_.points[z].size(); ++i)
        if (now_.status[z][i] != Status::open && model_.zones[z].points[i].node_position >= 0 &&
            std::abs(now_.points[z][i].variables.gap) > closed_gap * model_.zones[z].master.shortest_edge)
          return false;
    return true;
  }

  bool solve_and_correct(State& trial) {
    const LinearProblem problem{model_, system_.matrix, scheme_.forces.now, contact_, residual_};
    auto solution = system_.compliance ? solve_condensed(problem, *system_.compliance) : std::nullopt;
    if (!solution)
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
  void finish(State& trial) const {
    trial.t = t_;
    trial.unbalance = unbalance_;
    trial.contact_force = contact_.force;
    trial.reaction = VectorXd::Zero(unbalance_.size());
    for (const auto& constraint : model_.constraints)
      trial.reaction[constraint.dof] = full_residual_[constraint.dof];
    for (std::size_t z = 0; z < now_.status.size(); ++z)
      trial.zones[z].status = now_.status[z];
  }

  const Model& model_;
  const time::Scheme& scheme_;
  EffectiveSystem& system_;
  const State& committed_;
  double t_;
  Variant variant_;
  VectorXd external_;
  VectorXd history_;
  std::vector<contact::ZoneCoefficients> coefficients_;
  contact::ContactSystem contact_;
  ContactIterate now_, previous_;
  VectorXd inertia_, unbalance_, full_residual_, residual_;
  StepReport report_;
};

/// Predicted motion with the imposed displacements of the step's end.
State predicted(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                const State& committed, double t) {
  State trial = committed;
  trial.motion = time::predict(scheme, system.step, committed.motion);
  const VectorXd imposed = model::imposed_displacements(model, t);
  VectorXd d = VectorXd::Zero(trial.motion.u.size());
  for (std::size_t i = 0; i < model.constraints.size(); ++i) {
    const int dof = model.constraints[i].dof;
    d[dof] = imposed[static_cast<Index>(i)] - trial.motion.u[dof];
  }
  time::correct(system.coefficients, d, trial.motion);
  return trial;
}

bool has_friction(const Model& model) {
  return std::ranges::any_of(model.zones, [](const auto& zone) { return zone.settings.friction > 0; });
}

/// Counts what earlier attempts of the same step have cost.
StepReport added(StepReport report, int spent) {
  report.iterations += spent;
  return report;
}

/// Attempts until one converges; each starts afresh. Without contact one is enough: the problem is linear.
StepReport try_augmentations(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                             const State& committed, double t, State& trial) {
  StepReport report;
  for (const auto& variant : augmentations) {
    trial = predicted(model, scheme, system, committed, t);
    report = added(NewtonSolve(model, scheme, system, committed, t, variant).run(trial), report.iterations);
    if (report.converged() || model.zones.empty())
      break;
  }
  return report;
}

/// Friction from none to all of it, each part from the last one's solution.
StepReport raise_friction(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                          const State& committed, double t, State& trial) {
  StepReport report;
  trial = predicted(model, scheme, system, committed, t);
  for (const double part : friction_parts) {
    report =
        added(NewtonSolve(model, scheme, system, committed, t, {part, 1, 1}).run(trial), report.iterations);
    if (!report.converged())
      break;
  }
  report.friction_continuation = true;
  return report;
}

} // namespace

std::string_view to_string(Outcome outcome) {
  switch (outcome) {
  case Outcome::converged:
    return "converged";
  case Outcome::too_many_iterations:
    return "too many iterations";
  case Outcome::singular_matrix:
    return "singular matrix";
  case Outcome::not_finite:
    return "a value is not finite";
  }
  return "";
}

StepReport advance(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                   const State& committed, double t, State& trial) {
  auto report = try_augmentations(model, scheme, system, committed, t, trial);
  if (report.converged() || !has_friction(model))
    return report;
  return added(raise_friction(model, scheme, system, committed, t, trial), report.iterations);
}

} // namespace rubato::step
