// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/explicit/explicit_motion.hpp"

#include "rubato/core/error.hpp"
#include "rubato/core/function.hpp"
#include "rubato/domain/admitted_product.hpp"
#include "rubato/domain/heat.hpp"
#include "rubato/domain/line_springs.hpp"
#include "rubato/linalg/lanczos.hpp"
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/model/own_cells.hpp"
#include "rubato/step/energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using model::Model;

/// Steps whose lengths differ by less than this part are the same but for the rounding of instants.
constexpr double rounding = 1e-9;

/// Contact stiffens as points slide to lighter nodes of the master; in that many steps they move by a small
/// part of a face, which the safety of the step allows for.
constexpr int most_between_surveys = 20;
/// Of λ_K from one survey to the next: the safety of the step allows for twice that.
constexpr double surveyed_growth = 1.1;

/// How many times stiffer a spring counts that only pushes.
constexpr double impact = 4;

double factor_at(const std::optional<Function>& function, double t) {
  return function ? value_at(*function, t) : 1.0;
}

void require_forces(const Model& model, const domain::Failed& failed) {
  if (failed)
    throw InputError(fmt::format("{}: {} in the initial displacements",
                                 domain::cell_label(model.mesh, failed->cell),
                                 element::described(failed->reason)));
}

/// Of each dof by itself, 0 where nothing unknown moves it.
VectorXd inverse_masses(const Model& model, const constraint::Reduction& reduction) {
  VectorXd inverse = VectorXd::Zero(model.lumped_mass.size());
  for (int dof = 0; dof < static_cast<int>(inverse.size()); ++dof) {
    if (reduction.is_prescribed(dof))
      continue;
    if (!(model.lumped_mass[dof] > 0))
      throw InputError("node " + model::node_label(model.mesh, model.node_of(dof)) +
                       " has no mass: every cell of a dynamic run needs a positive density");
    inverse[dof] = 1 / model.lumped_mass[dof];
  }
  return inverse;
}

/// Those of unknowns that relations do not couple, 0 elsewhere.
VectorXd uncoupled(VectorXd inverse_mass, const constraint::Reduction& reduction,
                   const ConstrainedMass& mass) {
  for (const int dof : mass.coupled())
    inverse_mass[dof] = 0;
  for (const auto& dependent : reduction.dependents())
    inverse_mass[dependent.dof] = 0;
  return inverse_mass;
}

/// v −= h M⁻¹ r, u += h v in one sweep: vectors cost memory traffic, too.
void central_difference_update(double h, const VectorXd& inverse_mass, const VectorXd& residual_force,
                               VectorXd& velocity, VectorXd& displacement) {
  const double* m = inverse_mass.data();
  const double* r = residual_force.data();
  double* v = velocity.data();
  double* u = displacement.data();
  for (Index i = 0; i < velocity.size(); ++i) {
    v[i] -= h * m[i] * r[i];
    u[i] += h * v[i];
  }
}

std::vector<int> surface_dofs(const Model& model) {
  std::vector<int> dofs;
  for (const auto& zone : model.zones)
    for (const auto* surface : {&zone.master, &zone.slave})
      for (const auto node : surface->nodes)
        for (int i = 0; i < model.dofs.components; ++i)
          dofs.push_back(model.dofs.dof(node, i));
  std::ranges::sort(dofs);
  dofs.erase(std::unique(dofs.begin(), dofs.end()), dofs.end());
  return dofs;
}

/// Returns the material states of `from` where they fit the model, else the initial ones.
domain::QuadratureStates first_states(const Model& model, const State* from) {
  auto states = model.domain.initial_states();
  return from != nullptr && from->bulk_points.values.size() == states.values.size() ? from->bulk_points
                                                                                    : std::move(states);
}

} // namespace

double Spectrum::stable_step() const {
  return 4 / (damping + std::sqrt(damping * damping + 4 * (stiffness + impact * contact)));
}

ExplicitMotion::ExplicitMotion(const Model& model, const State* from)
    : model_(&model), reduction_(std::make_shared<const constraint::Reduction>(model.reduction)),
      inverse_mass_(inverse_masses(model, model.reduction)),
      mass_(model.lumped_mass, model::reference_masses(model), model.reduction),
      counted_mass_(counted_once(model.lumped_mass)), ties_(tied_zones(model)), surface_(surface_dofs(model)),
      t_(model.study.time.begin), u_(from == nullptr ? model.initial.displacement : from->motion.u),
      v_(from == nullptr ? model.initial.velocity : from->motion.v), bulk_points_(first_states(model, from)),
      unbalance_(VectorXd::Zero(inverse_mass_.size())), contact_force_(unbalance_) {
  if (model.has_damping)
    damping_.emplace(model.damping, model.dofs.components, model.threads);
  if (model::is_damped(model))
    damping_force_ = unbalance_;
  find_spectrum();
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (const auto& zone = model.zones[z]; !zone.settings.tie) {
      contact_.emplace_back(
          zone, model.dofs,
          contact::penalty_stiffness(zone, model.dofs, inverse_mass_, unrelated_stiffness_));
      touching_.push_back(z);
    }
  reduction_->impose(t_, u_);
  collect_supports();
  collect_loads();
  if (const auto* heat = model.domain.heat())
    heat_force_ = heat->force(t_);
  if (!model.followers.empty())
    follower_force_ = unbalance_;
  deform();
  const double back_stress = path_.taken.back_stress;
  require_forces(model, find_forces());
  const double contact = energy().contact;
  energy_ = {.back_stress = back_stress, .impact = counts() ? contact : 0};
  const double start = energy().stored();
  energy_.start = counts() ? start : 0;
  if (model.domain.has_finite_strain())
    survey_.interval = 1;
}

Spectrum ExplicitMotion::spectrum() const {
  auto spectrum = spectrum_;
  spectrum.stiffness *= std::max(1.0, survey_.growth);
  spectrum.contact = contact::largest_eigenvalue(contact_, inverse_mass_);
  return spectrum;
}

/// The next interval is the one in which λ_K grows by `surveyed_growth` if it goes on as it did.
void ExplicitMotion::survey() {
  if (!model_->domain.has_finite_strain() || (survey_.growth > 0 && survey_.made == 0))
    return;
  const double growth =
      model_->ranks.largest(model_->domain.growth(u_, bulk_points_, path_, spectrum_.stiffness, t_));
  const bool follows = survey_.growth > 0 && growth > 0;
  const double a_step = follows ? std::log(growth / survey_.growth) / survey_.made : 0;
  const int most = std::min(2 * survey_.interval, most_between_surveys);
  const double wanted = a_step > 0 ? std::log(surveyed_growth) / a_step : most;
  survey_ = {growth, std::max(1, static_cast<int>(std::min<double>(wanted, most))), 0};
}

/// Before this rank forgets the masses that it does not know the motion of. Masses of references are left
/// out: with them the eigenvalues are lower.
void ExplicitMotion::find_spectrum() {
  domain::AddUp add_up;
  domain::Admit admit;
  if (model_->parts)
    add_up = [&](VectorXd& sum) {
      model_->parts->add_up(sum);
      model_->parts->make_whole(sum);
    };
  unrelated_stiffness_ = spectrum_.stiffness = model_->domain.largest_eigenvalue(inverse_mass_, add_up);
  const auto bare = mass_.has_attached() ? ConstrainedMass(model_->lumped_mass, {}, *reduction_) : mass_;
  if (bare.couples()) {
    admit = [&](VectorXd& x) { bare.admit(x); };
    add_up = [&](VectorXd& sum) { bare.admit_forces(sum); };
    spectrum_.stiffness = model_->domain.largest_eigenvalue(inverse_mass_, add_up, admit);
  }
  if (is_damped())
    spectrum_.damping = largest_damping(add_up, admit);
  if (model_->parts)
    for (Index dof = 0; dof < inverse_mass_.size(); ++dof)
      if (!model_->parts->knows(static_cast<int>(dof)))
        inverse_mass_[dof] = 0;
  uncoupled_ = uncoupled(inverse_mass_, *reduction_, mass_);
}

double ExplicitMotion::largest_damping(const domain::AddUp& add_up, const domain::Admit& admit) const {
  const auto multiply = [this](const VectorXd& x, VectorXd& y) {
    multiply_damping(x, y);
    domain::add_bound_of_damping(model_->domain.line_springs(), x, y);
  };
  return linalg::largest_eigenvalue(domain::AdmittedProduct(multiply, add_up, admit), inverse_mass_);
}

/// What is summed over ranks.
VectorXd ExplicitMotion::counted_once(VectorXd values) const {
  return model::counted_once(*model_, std::move(values));
}

bool ExplicitMotion::is_finite() const {
  return model_->ranks.all(u_.allFinite());
}

bool ExplicitMotion::owns(int dof) const {
  return !model_->parts || model_->parts->owns(dof);
}

/// Whether what all ranks compute alike counts here.
bool ExplicitMotion::counts() const {
  return !model_->parts || model_->ranks.is_first();
}

/// The first failure by cells, of any rank.
domain::Failed ExplicitMotion::agreed(const domain::Failed& failed) const {
  if (!model_->parts)
    return failed;
  const auto none = std::numeric_limits<double>::infinity();
  std::array<double, 3> own{none, 0, 0};
  if (failed)
    own = {static_cast<double>(failed->cell), static_cast<double>(failed->reason),
           static_cast<double>(failed->point)};
  const double first = -model_->ranks.largest(-own[0]);
  if (first == none)
    return {};
  if (first != own[0])
    own = {};
  model_->ranks.sum(own);
  return domain::CellFailure{static_cast<element::Failure>(static_cast<int>(own[1])),
                             static_cast<mesh::CellIndex>(first), static_cast<int>(own[2])};
}

void ExplicitMotion::collect_supports() {
  supports_.clear();
  relations_.clear();
  for (const auto& prescribed : reduction_->prescribed())
    if (reduction_->moves(prescribed))
      supports_.push_back({&prescribed});
  for (const auto& dependent : reduction_->dependents())
    relations_.push_back({&dependent, reduction_->moves(dependent)});
  find_given();
}

/// What relations give at t without unknowns.
void ExplicitMotion::find_given() {
  for (auto& relation : relations_)
    relation.given = reduction_->given_part(*relation.dependent, t_);
}

/// The velocity now stays what it is, so that half a step before moves with the acceleration. So does the
/// kinetic energy there, which the balance must not take for a gain.
void ExplicitMotion::take_supports(const Model& stage) {
  const double kinetic = kinetic_energy();
  v_ += h_ / 2 * acceleration();
  reduction_ = std::make_shared<const constraint::Reduction>(stage.reduction);
  inverse_mass_ = inverse_masses(*model_, *reduction_);
  mass_ = ConstrainedMass(model_->lumped_mass, model::reference_masses(*model_), *reduction_);
  ties_ = tied_zones(stage);
  find_spectrum();
  collect_supports();
  impose_velocities();
  v_ -= h_ / 2 * unknown_acceleration();
  energy_.kinetic += kinetic - kinetic_energy();
  find_reactions();
}

void ExplicitMotion::collect_loads() {
  for (const auto& force : model_->forces) {
    Load load{{}, {}, &force.function, 0, factor_at(force.function, t_)};
    for (Index dof = 0; dof < force.pattern.size(); ++dof)
      if (force.pattern[dof] != 0) {
        load.dofs.push_back(static_cast<int>(dof));
        load.values.push_back(force.pattern[dof]);
      }
    load.displacement = held_by(load);
    loads_.push_back(std::move(load));
  }
}

/// values · u, as far as this rank counts it.
double ExplicitMotion::held_by(const Load& load) const {
  double sum = 0;
  for (std::size_t i = 0; i < load.dofs.size(); ++i)
    if (owns(load.dofs[i]))
      sum += load.values[i] * u_[load.dofs[i]];
  return sum;
}

domain::Failed ExplicitMotion::advance(double end, int steps) {
  const double begin = t_;
  const VectorXd before = u_;
  set_step((end - begin) / steps);
  for (int i = 1; i <= steps; ++i)
    if (const auto failed = step(i < steps ? begin + i * h_ : end))
      return failed;
  energy_.rounding += rounding_since(before);
  return {};
}

/// No entry of K is larger than λ_K m, λ_K without relations.
double ExplicitMotion::rounding_since(const VectorXd& before) const {
  return unrelated_stiffness_ * rounding_of_work(counted_mass_, before, u_);
}

/// The velocity half a step before t moves with the length of the step. So does the kinetic energy there,
/// which the balance must not take for a gain.
void ExplicitMotion::set_step(double step) {
  if (std::abs(step - h_) <= rounding * h_)
    return;
  const double kinetic = kinetic_energy();
  v_ += h_ / 2 * unknown_acceleration();
  h_ = step;
  impose_velocities();
  v_ -= h_ / 2 * unknown_acceleration();
  energy_.kinetic += kinetic - kinetic_energy();
  find_reactions();
}

/// Half a step before t, of what supports and relations give.
void ExplicitMotion::impose_velocities() {
  if (!(h_ > 0))
    return;
  for (auto& support : supports_) {
    const int dof = support.prescribed->dof;
    v_[dof] = (u_[dof] - reduction_->displacement(*support.prescribed, t_ - h_)) / h_;
  }
  reduction_->relate(v_);
  for (const auto& relation : relations_)
    if (relation.moves)
      v_[relation.dependent->dof] +=
          (relation.given - reduction_->given_part(*relation.dependent, t_ - h_)) / h_;
}

/// The next velocities of what supports and relations move; unknowns that are not coupled follow.
void ExplicitMotion::move_related(double end) {
  if (mass_.couples()) {
    VectorXd a = VectorXd::Zero(u_.size());
    mass_.respond(related_force(), a);
    for (const int dof : mass_.coupled())
      v_[dof] -= h_ * a[dof];
  }
  for (const auto& support : supports_) {
    const int dof = support.prescribed->dof;
    v_[dof] = (reduction_->displacement(*support.prescribed, end) - u_[dof]) / h_;
  }
  reduction_->relate(v_);
  for (auto& relation : relations_) {
    if (!relation.moves)
      continue;
    const double given = reduction_->given_part(*relation.dependent, end);
    relation.change = given - relation.given;
    relation.given = given;
    v_[relation.dependent->dof] += relation.change / h_;
  }
}

/// Without the rounding that sums of steps leave in relations.
void ExplicitMotion::hold_relations() {
  if (relations_.empty())
    return;
  reduction_->relate(u_);
  for (const auto& relation : relations_)
    u_[relation.dependent->dof] += relation.given;
}

domain::Failed ExplicitMotion::step(double end) {
  move_related(end);
  central_difference_update(h_, uncoupled_, unbalance_, v_, u_);
  hold_relations();
  const double begin = std::exchange(t_, end);
  ++steps_;
  ++survey_.made;
  const bool has_scheme = model_->domain.has_own_scheme();
  const double bulk_power = has_scheme ? path_.forces.dot(v_) : 0;
  const double damping_power = is_damped() ? damping_force_.dot(v_) : 0;
  const double follower_power = has_followers() ? follower_force_.dot(v_) : 0;
  if (const auto springs = model_->domain.law_springs(); !springs.empty())
    energy_.numerical += domain::missed_between(springs, u_ - h_ * v_, u_);
  if (const auto lines = model_->domain.line_springs(); !lines.empty()) {
    const VectorXd before = u_ - h_ * v_;
    if (const auto failed = domain::find_without_length(lines, {before, u_}))
      return failed;
    energy_.bulk_scheme += domain::missed_along_lines(lines, before, u_);
  }
  enter_heat(begin, end);
  enter_contact(begin, end);
  if (const auto failed = find_forces())
    return failed;
  enter_contact(begin, end);
  enter(path_.taken, energy_);
  if (has_scheme)
    energy_.bulk_scheme += h_ / 2 * (bulk_power + path_.forces.dot(v_)) - path_.law_work;
  if (is_damped())
    energy_.damping += h_ / 2 * (damping_power + damping_force_.dot(v_));
  if (has_followers())
    energy_.external_work += h_ / 2 * (follower_power + follower_force_.dot(v_));
  enter_supports();
  return {};
}

/// The bodies come to the initial displacements from their undeformed shape at once.
void ExplicitMotion::deform() {
  const auto failed =
      agreed(model_->domain.evaluate({u_, u_, t_, t_}, bulk_points_, bulk_points_next_, {.path = &path_}));
  require_forces(*model_, failed);
  std::swap(bulk_points_, bulk_points_next_);
}

/// The domain sees the end of a step only: to keep its start as well would cost memory traffic.
domain::Failed ExplicitMotion::find_forces() {
  const auto failed = model_->domain.evaluate({u_, u_, t_ - h_, t_}, bulk_points_, bulk_points_next_,
                                              {.forces = &unbalance_, .path = &path_});
  if (failed && !model_->parts)
    return failed;
  std::swap(bulk_points_, bulk_points_next_);
  if (is_damped()) {
    find_damping();
    unbalance_ += damping_force_;
  }
  if (model_->parts && model_->parts->add_up(unbalance_, failed.has_value()) > 0)
    return agreed(failed);
  for (const int dof : surface_)
    contact_force_[dof] = 0;
  const contact::Configuration configuration{&model_->mesh, &model_->dofs, &u_, &u_, t_, t_ - h_};
  for (auto& zone : contact_)
    zone.advance(configuration, v_, h_, contact_force_);
  for (const int dof : surface_)
    unbalance_[dof] += contact_force_[dof];
  for (auto& load : loads_)
    apply(load);
  if (has_followers()) {
    find_followers();
    unbalance_ -= follower_force_;
  }
  return {};
}

void ExplicitMotion::multiply_damping(const VectorXd& x, VectorXd& y) const {
  if (damping_)
    damping_->multiply(x, y);
  else
    y.setZero();
}

/// Of several ranks their sum is meant.
void ExplicitMotion::find_damping() {
  multiply_damping(v_, damping_force_);
  domain::add_beyond_matrix(model_->dampers, v_, damping_force_);
  domain::add_line_damping(model_->domain.line_springs(), u_, v_, damping_force_);
}

/// What pressures that follow their faces push with where the bodies are.
void ExplicitMotion::find_followers() {
  follower_force_.setZero();
  model::add_follower_forces(*model_, t_, u_, follower_force_);
}

/// Adds a load to the residual force, and its work since the last instant.
void ExplicitMotion::apply(Load& load) {
  const double factor = factor_at(*load.function, t_);
  for (std::size_t i = 0; i < load.dofs.size(); ++i)
    unbalance_[load.dofs[i]] -= factor * load.values[i];
  const double displacement = held_by(load);
  energy_.external_work += (load.factor + factor) / 2 * (displacement - load.displacement);
  load.factor = factor;
  load.displacement = displacement;
}

} // namespace rubato::step
