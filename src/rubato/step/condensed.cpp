// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/condensed.hpp"

#include "rubato/step/linear_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::step {
namespace {

using contact::Status;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using model::Model;

/// Frames that the guess of the contact goes through.
constexpr int guess_rounds = 10;
/// Change of a force, in parts of the largest, after which the guess has settled.
constexpr double settled_guess = 1e-2;

/// A friction force this little below its limit, relatively, is at it.
constexpr double rounding = 1e-9;

bool about_equal(std::span<const GuessPoint> a, std::span<const GuessPoint> b) {
  if (a.size() != b.size())
    return false;
  double change = 0;
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    change = std::max(change, (a[i].force - b[i].force).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, b[i].force[0]);
  }
  return change <= settled_guess * largest;
}

bool owns_its_multipliers(const contact::Zone& zone) {
  return std::ranges::all_of(zone.points, [](const auto& point) { return point.node_position >= 0; });
}

} // namespace

bool can_condense(const Model& model, const EffectiveSystem& system) {
  return system.compliance && !model.zones.empty() &&
         std::ranges::all_of(model.zones, [](const contact::Zone& zone) {
           return owns_its_multipliers(zone) && zone.settings.method != deck::ContactMethod::nodal_pcg;
         });
}

Condensed::Condensed(const Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                     const State& committed, double t, const ContactSide& side)
    : model_(model), scheme_(scheme), system_(system), side_(side),
      equilibrium_(model, scheme, system, committed, t), scale_(committed.force_scale),
      surface_(*system.compliance), points_(*system.compliance, surface_, scheme.forces.now) {}

StepReport Condensed::run(State& trial, const Held& held) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  if (!started_) {
    start_from(trial);
    if (!equilibrium_.residual().allFinite())
      return ended(Outcome::not_finite);
    if (side_.variant().guess_contact)
      guess_contact(trial, held);
  }
  for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
    evaluate_contact(trial, held, iteration);
    if (!points_.force().allFinite())
      return ended(Outcome::not_finite);
    if (iteration > 0 && settled(held)) {
      move_bulk(trial);
      const auto force = contact_force();
      if (in_equilibrium(trial, force)) {
        equilibrium_.finish(force, trial);
        side_.finish(held, now_, trial);
        return ended(Outcome::converged);
      }
      if (!equilibrium_.residual().allFinite())
        return ended(Outcome::not_finite);
      start_from(trial);
    }
    if (iteration == model_.study.newton.max_iterations)
      break;
    if (!iterate(trial, held))
      return ended(Outcome::singular_matrix);
    ++report_.iterations;
  }
  return ended(Outcome::too_many_iterations);
}

StepReport Condensed::ended(Outcome outcome) {
  report_.outcome = outcome;
  if (!report_.converged())
    report_.worst = equilibrium_.residual().allFinite() ? worst_on_surface() : equilibrium_.worst();
  return report_;
}

std::vector<WorstNode> Condensed::worst_on_surface() const {
  std::vector<mesh::NodeIndex> nodes;
  for (const int dof : system_.compliance->dof_of_position())
    nodes.push_back(model_.node_of(dof));
  const VectorXd left = scheme_.forces.now * (points_.force() - applied_);
  return worst_nodes(left, nodes, surface_scale());
}

/// Takes a motion as the base that everything is counted from.
void Condensed::start_from(const State& trial) {
  started_ = true;
  base_ = trial.motion;
  equilibrium_.evaluate(base_, ContactForce(base_.u.size()));
  half_way_ = system_.compliance->factor().forward(-equilibrium_.residual());
  free_ = system_.compliance->factor().surface_of(half_way_);
  moved_ = applied_ = VectorXd::Zero(free_.size());
}

/// Contact in frames that follow the surface. Points that press in the end touch at first, all others are
/// open.
void Condensed::guess_contact(State& trial, const Held& held) {
  ContactGuess guess(*system_.compliance, surface_, scheme_.forces.now);
  std::vector<GuessPoint> points;
  for (int round = 0; round < guess_rounds; ++round) {
    const auto before = std::move(points);
    side_.measure(trial, held, now_);
    points = guess_points(now_, held, trial);
    if (points.size() == before.size())
      for (std::size_t k = 0; k < points.size(); ++k)
        points[k].force = before[k].force;
    guess.improve(points, free_);
    VectorXd force = VectorXd::Zero(free_.size());
    for (const auto& point : points) {
      if (point.force[0] != 0)
        for (std::size_t q = 0; q < point.positions.size(); ++q)
          force[point.positions[q]] -=
              point.slopes.col(static_cast<Index>(q)).dot(point.force.head(point.slopes.rows()));
      take_guess(point, trial);
    }
    move_surface(force, trial);
    if (about_equal(before, points))
      return;
  }
}

std::vector<GuessPoint> Condensed::guess_points(const ContactIterate& contact, const Held& held,
                                                const State& trial) const {
  std::vector<GuessPoint> points;
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; held[z].status.empty() && i < model_.zones[z].points.size(); ++i)
      if (contact.points[z][i].kinematics && !model_.zones[z].points[i].excluded) {
        points.push_back(guess_point(trial.zones[z], law, i, *contact.points[z][i].kinematics));
        points.back().zone = z;
      }
  }
  return points;
}

GuessPoint Condensed::guess_point(const contact::ZoneState& state, const contact::ZoneLaw& law,
                                  std::size_t index, const contact::Kinematics& k) const {
  const auto& point = law.zone->points[index];
  const auto& position = system_.compliance->position_of_dof();
  GuessPoint guess;
  guess.index = index;
  guess.value << k.gap, k.slip;
  guess.friction = law.friction;
  const int tangents = k.components - 1;
  const auto& outcome = state.outcomes[index];
  guess.force[0] = std::max(0.0, outcome.pressure * point.area);
  for (int a = 0; a < tangents; ++a)
    guess.force[1 + a] = outcome.tangential.dot(k.tangents.col(a));
  if (!contact::is_exact(law.zone->settings.method))
    guess.softness = 1 / (law.coefficients.normal[index] * point.weight);
  guess.slopes.resize(1 + tangents, k.unknowns());
  Index next = 0;
  for (std::size_t node = 0; node < k.nodes.size(); ++node)
    for (int i = 0; i < k.components; ++i) {
      const int at = position[static_cast<std::size_t>(model_.dofs.dof(k.nodes[node], i))];
      if (at < 0)
        continue;
      const auto q = static_cast<Index>(node) * k.components + i;
      guess.positions.push_back(at);
      guess.slopes(0, next) = k.d_gap[q];
      for (int a = 0; a < tangents; ++a)
        guess.slopes(1 + a, next) = k.d_slip(a, q);
      guess.value.head(1 + tangents) -= guess.slopes.col(next++) * moved_[at];
    }
  guess.slopes.conservativeResize(Eigen::NoChange, next);
  return guess;
}

void Condensed::take_guess(const GuessPoint& guess, State& trial) const {
  const auto& zone = model_.zones[guess.zone];
  const auto& point = zone.points[guess.index];
  auto& state = trial.zones[guess.zone];
  const double limit = guess.friction * guess.force[0];
  const Eigen::Vector2d friction = guess.force.tail<2>();
  auto& status = state.status[guess.index];
  if (guess.force[0] == 0)
    status = Status::open;
  else
    status = friction.norm() < (1 - rounding) * limit ? Status::stick : Status::slip;
  auto multipliers = state.multipliers.segment(
      static_cast<Index>(point.node_position) * zone.multipliers_per_node(), zone.multipliers_per_node());
  Index next = 0;
  for (const int variable : zone.multiplier_variables())
    multipliers[next++] = variable == 0 ? guess.force[0] / point.weight
                          : limit > 0   ? -friction[variable - 1] / limit
                                        : 0.0;
}

void Condensed::evaluate_contact(const State& trial, const Held& held, int iteration) {
  std::swap(previous_, now_);
  side_.measure(trial, held, now_);
  if (iteration > 0)
    side_.renew_status(held, now_);
  points_.clear();
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; i < now_.status[z].size(); ++i)
      if (now_.status[z][i] != Status::open)
        points_.add(z, i, now_.status[z][i],
                    contact::factor_response(law, i, now_.points[z][i], now_.status[z][i], model_.dofs));
  }
}

bool Condensed::settled(const Held& held) {
  side_.collect_restless(held, previous_, now_, report_);
  measure_surface();
  return report_.residual <= report_.tolerance && report_.status_changes == 0 &&
         side_.settled(held, previous_, now_);
}

/// Until the bulk has been solved for, forces are measured by what they were measured by in the last step.
double Condensed::surface_scale() const {
  return std::max(scale_, scheme_.forces.now * points_.force().lpNorm<Eigen::Infinity>());
}

void Condensed::measure_surface() {
  const auto& force = points_.force();
  Index worst = 0;
  const double largest =
      force.size() > 0 ? scheme_.forces.now * (force - applied_).cwiseAbs().maxCoeff(&worst) : 0.0;
  report_.residual = largest == 0 ? 0 : largest / surface_scale();
  if (force.size() > 0)
    report_.worst_node =
        model_.node_of(system_.compliance->dof_of_position()[static_cast<std::size_t>(worst)]);
}

bool Condensed::iterate(State& trial, const Held& held) {
  const auto change = points_.solve(free_ - moved_);
  if (!change)
    return false;
  const VectorXd before = moved_;
  move_surface(points_.force_after(*change), trial);
  correct_multipliers(held, *change, moved_ - before, trial);
  return moved_.allFinite();
}

/// d_s = d_free − f₁ S f
void Condensed::move_surface(const VectorXd& force, State& trial) {
  applied_ = force;
  moved_ = free_;
  system_.compliance->add(-scheme_.forces.now, force, moved_);
  const auto& dofs = system_.compliance->dof_of_position();
  for (std::size_t i = 0; i < dofs.size(); ++i)
    trial.motion.u[dofs[i]] = base_.u[dofs[i]] + moved_[static_cast<Index>(i)];
}

void Condensed::correct_multipliers(const Held& held, const PointSystem::Change& change,
                                    const VectorXd& moved, State& trial) const {
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto& zone = model_.zones[z];
    const auto count = static_cast<Index>(zone.multipliers_per_node());
    if (count == 0)
      continue;
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; i < zone.points.size(); ++i)
      if (now_.status[z][i] == Status::open)
        trial.zones[z].multipliers.segment(zone.points[i].node_position * count, count) +=
            contact::release(law, i, now_.points[z][i]);
  }
  for (const auto& point : points_.points())
    if (const Index count = point.response.multipliers(); count > 0)
      trial.zones[point.zone].multipliers.segment(
          model_.zones[point.zone].points[point.index].node_position * count, count) +=
          points_.multipliers_of(point, change, moved);
}

/// The whole motion that belongs to the forces on the surface.
void Condensed::move_bulk(State& trial) {
  const auto& factor = system_.compliance->factor();
  VectorXd half_way = half_way_;
  factor.load_surface(-scheme_.forces.now * applied_, half_way);
  VectorXd d = VectorXd::Zero(base_.u.size());
  d(model_.free_dofs) = factor.backward(half_way);
  trial.motion = base_;
  time::correct(system_.coefficients, d, trial.motion);
}

ContactForce Condensed::contact_force() const {
  ContactForce force(base_.u.size());
  for (const auto& point : points_.points()) {
    const auto& r = point.response;
    const auto& settings = model_.zones[point.zone].settings;
    const VectorXd on_q = r.spread.topRows(r.components).transpose() * r.force;
    force.all(r.dofs) += on_q;
    if (!settings.history_force)
      force.forgotten(r.dofs) += on_q;
    if (deck::is_nodal(settings.method))
      force.nodal(r.dofs) += on_q;
  }
  return force;
}

bool Condensed::in_equilibrium(const State& trial, const ContactForce& force) {
  equilibrium_.evaluate(trial.motion, force);
  equilibrium_.measure(trial.motion, force, report_);
  scale_ = equilibrium_.scale();
  return report_.residual <= report_.tolerance;
}

} // namespace rubato::step
