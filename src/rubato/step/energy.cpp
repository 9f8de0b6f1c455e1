// SPDX-License-Identifier: LGPL-3.0-or-later
// Notation of docs/theory/energy.md: [x] = x₁ − x₀, {x} = (x₀ + x₁)/2.
#include "rubato/step/energy.hpp"

#include "rubato/contact/springs.hpp"
#include "rubato/core/tolerances.hpp"
#include "rubato/domain/balance_terms.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/rigid_parts.hpp"

#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;
using model::Model;

double kinetic_energy(const State& state) {
  return 0.5 * state.motion.v.dot(state.bulk.momentum);
}

bool damped(const State& state) {
  return state.bulk.viscous.size() > 0;
}

/// [x]·{f}
double work(const VectorXd& moved, const VectorXd& before, const VectorXd& now) {
  return 0.5 * (moved.dot(before) + moved.dot(now));
}

/// −Σ s k·u + ½ Σ Σ s s r·k
double energy_of_ground(const Model& model, const State& state) {
  double sum = 0;
  for (const auto& pull : model.ground) {
    sum -= pull.at(state.t) * pull.stiffness.dot(state.motion.u);
    for (const auto& other : model.ground)
      sum += 0.5 * pull.at(state.t) * other.at(state.t) * other.along.dot(pull.stiffness);
  }
  return sum;
}

/// [u]·{k s} and [u]·{c ṡ}
std::pair<double, double> work_of_ground(const Model& model, const VectorXd& moved, const State& committed,
                                         const State& trial) {
  double by_stiffness = 0;
  double by_damping = 0;
  for (const auto& pull : model.ground) {
    by_stiffness += 0.5 * (pull.at(committed.t) + pull.at(trial.t)) * moved.dot(pull.stiffness);
    if (pull.damping.size() > 0)
      by_damping += 0.5 * (pull.rate(committed.t) + pull.rate(trial.t)) * moved.dot(pull.damping);
  }
  return {by_stiffness, by_damping};
}

/// −[s]·{c·v − Σ ṡ r·c}: of the ground.
double work_on_dashpots(const Model& model, const State& committed, const State& trial) {
  const auto force = [&](const model::GroundPull& pull, const State& state) {
    double sum = pull.damping.dot(state.motion.v);
    for (const auto& other : model.ground)
      sum -= other.rate(state.t) * other.along.dot(pull.damping);
    return sum;
  };
  double work = 0;
  for (const auto& pull : model.ground)
    if (pull.damping.size() > 0)
      work -= 0.5 * (pull.at(trial.t) - pull.at(committed.t)) * (force(pull, committed) + force(pull, trial));
  return work;
}

/// Internal less external forces, the former where the scheme remembers them.
VectorXd bulk_bracket(const time::Scheme& scheme, const State& state) {
  return scheme.remembers_internal() ? VectorXd(state.bulk.internal - state.external_force)
                                     : VectorXd(-state.external_force);
}

} // namespace

void enter(const domain::Balance& balance, EnergyLedger& ledger) {
  ledger.plastic += balance.plastic;
  ledger.back_stress += balance.back_stress;
  ledger.viscous += balance.viscous;
  ledger.bulk_scheme += balance.scheme;
  ledger.heat += balance.heat;
}

void EnergyRecord::note(double t, const EnergyLedger& ledger) {
  largest = std::max(largest, ledger.largest());
  largest_balance = std::max(largest_balance, std::abs(ledger.balance()));
  if (ledger.gain() <= gain)
    return;
  gain = ledger.gain();
  gained_at = t;
  by_impact = -ledger.impact;
  by_scheme = -ledger.numerical;
  by_bulk_scheme = -ledger.bulk_scheme;
}

double rounding_of_work(const VectorXd& resistance, const VectorXd& before, const VectorXd& now) {
  return tolerances.rounding() *
         resistance.dot((now - before).cwiseAbs().cwiseProduct(before.cwiseAbs().cwiseMax(now.cwiseAbs())));
}

std::shared_ptr<const VectorXd> EnergyAccount::diagonal_of(const Model& model) {
  return std::make_shared<const VectorXd>(
      linalg::diagonal_of(model.domain.initial_tangent(), model.sharing()).cwiseAbs());
}

EnergyAccount::EnergyAccount(const Model& model, const time::Scheme& scheme, const EnergyLedger& ledger,
                             Overlaps overlaps)
    : model_(&model), scheme_(&scheme), rigid_(std::make_shared<const RigidParts>(model)),
      resistance_(diagonal_of(model)), ledger_(ledger), overlaps_(std::move(overlaps)), closed_(true) {}

EnergyAccount::EnergyAccount(const Model& model, const time::Scheme& scheme, const State& start)
    : model_(&model), scheme_(&scheme), rigid_(std::make_shared<const RigidParts>(model)),
      resistance_(diagonal_of(model)) {
  ledger_.kinetic = scheme.dynamic ? kinetic_energy(start) : 0;
  ledger_.strain = strain_energy(start, constant_resultants(start));
  ledger_.strain += energy_of_ground(model, start);
  ledger_.back_stress = model.domain.back_stress_energy(start.bulk_points);
  ledger_.hourglass = model.domain.hourglass_energy(start.motion.u);
  ledger_.contact = energy_of_springs(model.zones, start.zones);
  ledger_.held_heat = model.domain.heat() != nullptr ? model.domain.heat()->held_energy(start.t) : 0;
  ledger_.start = ledger_.stored();
  if (!scheme.nonsmooth) // a law of velocities leaves overlaps as they are
    overlaps_ = overlaps_of(model, start);
}

void EnergyAccount::enter(const State& committed, const State& trial) {
  const auto& before = committed.bulk;
  const auto& now = trial.bulk;
  const VectorXd moved = trial.motion.u - committed.motion.u;
  ledger_.rounding += rounding_of_work(*resistance_, committed.motion.u, trial.motion.u);
  ledger_.kinetic = scheme_->dynamic ? kinetic_energy(trial) : 0;
  const auto constant = constant_resultants(trial);
  ledger_.strain = strain_energy(trial, constant);
  auto materials = model_->domain.balance(committed.bulk_points, trial.bulk_points);
  if (scheme_->conserving) // its internal forces do the work that is stored, not that of both ends' mean
    materials.scheme = 0;
  step::enter(materials, ledger_);
  ledger_.hourglass = model_->domain.hourglass_energy(trial.motion.u);
  ledger_.external_work += work(moved, committed.external_force, trial.external_force);
  enter_heat(committed, trial);
  if (damped(trial))
    ledger_.damping += work(moved, before.viscous, now.viscous);
  enter_ground(moved, committed, trial);
  const auto obstacles = work_of_obstacles(committed, trial);
  const double friction =
      work_of_contact(moved, committed.friction_force, trial.friction_force) + obstacles.tangential;
  const double contact = work_of_contact(moved, committed.contact_force, trial.contact_force) +
                         obstacles.normal + obstacles.tangential;
  const double springs = scheme_->nonsmooth ? 0.0 : energy_of_springs(model_->zones, trial.zones);
  const double overlap = enter_overlaps(committed, trial);
  ledger_.friction += friction;
  ledger_.overlap_work += overlap;
  ledger_.impact += contact - friction - (springs - ledger_.contact) + overlap;
  ledger_.contact = springs;
  ledger_.support_work += obstacles.normal + obstacles.tangential;
  const auto supports = enter_supports(moved, committed, trial);
  ledger_.support_work += supports.work;
  const auto motion = rigid_->resultants(moved);
  const double rigid_before = rigid_->work(motion, constant_resultants(committed));
  const double rigid_now = rigid_->work(motion, constant);
  ledger_.numerical += scheme_dissipation(moved, committed, trial) -
                       (scheme_->forces.now - 0.5) * (rigid_now - rigid_before) + supports.work -
                       supports.with_step;
  ledger_.numerical +=
      domain::missed_between(model_->domain.law_springs(), committed.motion.u, trial.motion.u);
  if (!scheme_->conserving)
    ledger_.bulk_scheme +=
        domain::missed_along_lines(model_->domain.line_springs(), committed.motion.u, trial.motion.u);
  ledger_.unbalanced += work_of_equation(moved, committed, trial) - scheme_->forces.now * rigid_now -
                        scheme_->forces.before * rigid_before - supports.with_step;
}

/// Springs and dashpots to the ground have forces of u − s and of v − ṡ, of which K, C and the loads of the
/// ground are two parts: the energy of springs, −s k·u + ½ s² r·k beside ½ u·K u, the work of the loads, and
/// what dashpots take, are put together again. What is left is the work of the ground.
void EnergyAccount::enter_ground(const VectorXd& moved, const State& committed, const State& trial) {
  if (model_->ground.empty())
    return;
  const double stored = energy_of_ground(*model_, trial);
  const auto [by_stiffness, by_damping] = work_of_ground(*model_, moved, committed, trial);
  const double taken = work_on_dashpots(*model_, committed, trial);
  ledger_.strain += stored;
  ledger_.external_work -= by_stiffness + by_damping;
  ledger_.support_work += stored - energy_of_ground(*model_, committed) + by_stiffness + taken;
  ledger_.damping += taken - by_damping;
}

/// The internal forces at the state's instant that are a constant matrix times u.
VectorXd EnergyAccount::constant_forces(const State& state) const {
  const auto& domain = model_->domain;
  return domain.is_linear() && scheme_->remembers_internal()
             ? state.bulk.internal
             : domain.constant_forces(state.motion.u, state.t);
}

Eigen::MatrixXd EnergyAccount::constant_resultants(const State& state) const {
  return rigid_->resultants(constant_forces(state));
}

/// U less ½ r·f, r the rigid part of u: rounding, which far away from where it began would hide the strain of
/// a body. `constant`: resultants of f, the forces that are a constant matrix times u.
double EnergyAccount::strain_energy(const State& state, const Eigen::MatrixXd& constant) const {
  const auto motion = rigid_->resultants(state.motion.u);
  double rigid = rigid_->work(motion, constant);
  if (const auto* heat = model_->domain.heat())
    rigid -= rigid_->work(motion, rigid_->resultants(heat->force(state.t)));
  const auto& domain = model_->domain;
  const VectorXd forces = domain.is_linear() ? constant_forces(state) : VectorXd();
  return domain.energy(state.motion.u, forces, state.t, state.bulk_points) - 0.5 * rigid;
}

/// [U_held] − {u − r}·[f], r the rigid part of u.
void EnergyAccount::enter_heat(const State& committed, const State& trial) {
  const auto* heat = model_->domain.heat();
  if (heat == nullptr)
    return;
  const VectorXd change = heat->force(trial.t) - heat->force(committed.t);
  const VectorXd mean = 0.5 * (committed.motion.u + trial.motion.u);
  const double held = heat->held_energy(trial.t);
  ledger_.heat += held - ledger_.held_heat - mean.dot(change) +
                  rigid_->work(rigid_->resultants(mean), rigid_->resultants(change));
  ledger_.held_heat = held;
}

/// In the first step that closes them, in the second that the bodies may rebound in.
double EnergyAccount::enter_overlaps(const State& committed, const State& trial) {
  if (std::exchange(closed_, true))
    return work_of_rebound(*model_, std::exchange(overlaps_, {}), committed, trial);
  return work_of_overlaps(*model_, overlaps_, trial);
}

/// [u]·{f}, or [u]·f₁ where f₁ is the mean over the step.
double EnergyAccount::work_of_contact(const VectorXd& moved, const VectorXd& before,
                                      const VectorXd& now) const {
  return scheme_->nonsmooth ? moved.dot(now) : work(moved, before, now);
}

/// [o]·{f} of the forces that obstacles push the bodies with, o their motion, and −[offset]·{N} of what an
/// interference or a gap that changes pushes them apart with; [o]·f₁ where f₁ is the mean.
EnergyAccount::Obstacles EnergyAccount::work_of_obstacles(const State& committed, const State& trial) const {
  Obstacles work;
  for (std::size_t z = 0; z < model_->zones.size(); ++z) {
    const auto& zone = model_->zones[z];
    const bool moves = zone.obstacle && zone.obstacle->moves();
    if (!moves && !zone.offset.moves())
      continue;
    const bool rotates = moves && zone.obstacle->rotation;
    if (rotates) { // each place comes a way of its own
      work.normal += trial.zones[z].obstacle_work.normal;
      work.tangential += trial.zones[z].obstacle_work.tangential;
    }
    const Eigen::Vector3d way =
        moves && !rotates ? zone.obstacle->translation(committed.t, trial.t) : Eigen::Vector3d::Zero().eval();
    const auto add = [&](const State& state, double part) {
      const auto& outcomes = state.zones[z].outcomes;
      for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const auto& outcome = outcomes[i];
        const double apart = -zone.offset.change(zone.points[i].place, committed.t, trial.t);
        work.normal += part * (way.dot(outcome.normal) + apart * contact::pressing_force(outcome));
        work.tangential += part * way.dot(outcome.tangential);
      }
    };
    if (!scheme_->nonsmooth)
      add(committed, 0.5);
    add(trial, scheme_->nonsmooth ? 1.0 : 0.5);
  }
  return work;
}

/// [g]·{r}, r = M a + C v + F, and [g]·R with the step's own R: g is what supports and relations give of u.
EnergyAccount::Supports EnergyAccount::enter_supports(const VectorXd& moved, const State& committed,
                                                      const State& trial) const {
  const auto reaction = [&](const State& state, int dof) {
    double sum = state.bulk.internal[dof] + state.contact_force[dof] - state.external_force[dof];
    if (scheme_->dynamic)
      sum += state.bulk.inertia[dof];
    if (damped(state))
      sum += state.bulk.viscous[dof];
    return sum;
  };
  Supports supports;
  const auto enter = [&](int dof, double way) {
    if (way == 0)
      return;
    const double mean =
        scheme_->nonsmooth ? trial.reaction[dof] : 0.5 * (reaction(committed, dof) + reaction(trial, dof));
    supports.work += way * mean;
    supports.with_step += way * trial.reaction[dof];
  };
  const auto& reduction = model_->reduction;
  for (const auto& support : reduction.prescribed())
    enter(support.dof, moved[support.dof]);
  // Forces of relations do no work on what unknowns move: Tᵀ R = 0.
  for (const auto& dependent : reduction.dependents())
    if (!dependent.prescribed.empty() || !dependent.given.empty() || reduction.is_carried())
      enter(dependent.dof,
            reduction.given_part(dependent, trial.t) - reduction.given_part(dependent, committed.t));
  return supports;
}

/// [u]·(m₁ M a₁ + m₀ M a₀ + c₁ C v₁ + c₀ C v₀ + f₁ F₁ + f₀ F₀): that of R and of what is left unbalanced.
double EnergyAccount::work_of_equation(const VectorXd& moved, const State& committed,
                                       const State& trial) const {
  const auto& before = committed.bulk;
  const auto& now = trial.bulk;
  double sum = scheme_->forces.now * moved.dot(bulk_bracket(*scheme_, trial)) +
               scheme_->contact_weight() * moved.dot(trial.contact_force);
  if (!scheme_->remembers_internal())
    sum += moved.dot(now.internal);
  if (scheme_->forces.before != 0)
    sum += scheme_->forces.before * moved.dot(committed.residual_force);
  if (!scheme_->dynamic)
    return sum;
  sum += moved.dot(scheme_->inertia.now * now.inertia + scheme_->inertia.before * before.inertia);
  if (damped(trial))
    sum += moved.dot(scheme_->damping.now * now.viscous + scheme_->damping.before * before.viscous);
  return sum;
}

/// h²(β − γ/2) ([½ a·M a] + (γ − ½) [a]·M[a])
///   + [u]·((m₁ − γ) M[a] + (c₁ − ½) C[v] + (f₁ − ½) [F]) + f₀ [u]·(F₀ as the step took it − F₀),
/// where a₁ and f_c are means of the step, F is without f_c and the terms of inertia are (θ − ½) h² a₁·M a₁;
/// where f_int is of the step, F is without it.
double EnergyAccount::scheme_dissipation(const VectorXd& moved, const State& committed,
                                         const State& trial) const {
  const auto& before = committed.bulk;
  const auto& now = trial.bulk;
  const auto bracket = [&](const State& state) {
    VectorXd sum = bulk_bracket(*scheme_, state);
    if (scheme_->remembers_contact())
      sum += state.contact_force;
    return sum;
  };
  const VectorXd bracket_before = bracket(committed);
  double sum = (scheme_->forces.now - 0.5) * moved.dot(bracket(trial) - bracket_before);
  if (scheme_->forces.before != 0)
    sum += scheme_->forces.before * moved.dot(committed.residual_force - bracket_before);
  if (!scheme_->dynamic)
    return sum;
  if (damped(trial))
    sum += (scheme_->damping.now - 0.5) * moved.dot(now.viscous - before.viscous);
  return sum + dissipation_of_inertia(moved, committed, trial);
}

double EnergyAccount::dissipation_of_inertia(const VectorXd& moved, const State& committed,
                                             const State& trial) const {
  const double h = trial.t - committed.t;
  const auto& before = committed.bulk;
  const auto& now = trial.bulk;
  if (scheme_->nonsmooth)
    return (scheme_->beta - 0.5) * h * h * trial.motion.a.dot(now.inertia);
  const auto inertia_change = now.inertia - before.inertia;
  double sum = (scheme_->inertia.now - scheme_->gamma) * moved.dot(inertia_change);
  const double factor = h * h * (scheme_->beta - scheme_->gamma / 2);
  if (factor != 0)
    sum += factor * (0.5 * (trial.motion.a.dot(now.inertia) - committed.motion.a.dot(before.inertia)) +
                     (scheme_->gamma - 0.5) * (trial.motion.a - committed.motion.a).dot(inertia_change));
  return sum;
}

double energy_of_springs(std::span<const contact::Zone> zones, std::span<const contact::ZoneState> states) {
  double sum = 0;
  for (std::size_t z = 0; z < states.size(); ++z)
    sum += contact::stored_energy(zones[z], states[z]);
  return sum;
}

} // namespace rubato::step
