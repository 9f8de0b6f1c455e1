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

/// Equations of a multiplier with entries below this part of the largest one are empty: the point stands
/// between parts that are held.
constexpr double empty_row = 1e-13;

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

/// Largest entry of each row, 1 where there is none.
VectorXd row_sizes(const MatrixXd& matrix) {
  VectorXd sizes = matrix.cwiseAbs().rowwise().maxCoeff();
  return (sizes.array() > 0).select(sizes, 1.0);
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
      equilibrium_(model, scheme, system, committed, t), scale_(committed.force_scale) {}

StepReport Condensed::run(State& trial, const Held& held) {
  report_ = {};
  report_.tolerance = model_.study.newton.residual;
  if (!started_) {
    start_from(trial);
    if (side_.variant().guess_contact)
      guess_contact(trial, held);
  }
  for (int iteration = 0; iteration <= model_.study.newton.max_iterations; ++iteration) {
    evaluate_contact(trial, held, iteration);
    if (!force_.allFinite())
      return ended(Outcome::not_finite);
    if (iteration > 0 && settled(held)) {
      move_bulk(trial);
      const auto force = contact_force();
      if (in_equilibrium(trial, force)) {
        equilibrium_.finish(force, trial);
        side_.finish(held, now_, trial);
        return ended(Outcome::converged);
      }
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
  return report_;
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
  std::vector<GuessPoint> points;
  for (int round = 0; round < guess_rounds; ++round) {
    const auto before = std::move(points);
    side_.measure(trial, held, now_);
    points = guess_points(now_, held, trial);
    if (points.size() == before.size())
      for (std::size_t k = 0; k < points.size(); ++k)
        points[k].force = before[k].force;
    guess_forces(points, free_, scheme_.forces.now, *system_.compliance);
    VectorXd force = VectorXd::Zero(free_.size());
    for (const auto& point : points) {
      for (std::size_t q = 0; q < point.positions.size(); ++q)
        for (std::size_t row = 0; row < 3; ++row)
          if (const double part = point.force[static_cast<Index>(row)]; part != 0)
            force[point.positions[q]] -= point.slopes[row][q] * part;
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
  guess.tangents = k.components - 1;
  const auto& outcome = state.outcomes[index];
  guess.force[0] = std::max(0.0, outcome.pressure * point.area);
  for (int a = 0; a < guess.tangents; ++a)
    guess.force[1 + a] = outcome.tangential.dot(k.tangents.col(a));
  if (!contact::is_exact(law.zone->settings.method))
    guess.softness = 1 / (law.coefficients.normal[index] * point.weight);
  for (std::size_t node = 0; node < k.nodes.size(); ++node)
    for (int i = 0; i < k.components; ++i) {
      const int at = position[static_cast<std::size_t>(model_.dofs.dof(k.nodes[node], i))];
      if (at < 0)
        continue;
      const auto q = static_cast<Index>(node) * k.components + i;
      guess.positions.push_back(at);
      guess.slopes[0].push_back(k.d_gap[q]);
      for (int a = 0; a < guess.tangents; ++a)
        guess.slopes[static_cast<std::size_t>(1 + a)].push_back(k.d_slip(a, q));
      for (int row = 0; row <= guess.tangents; ++row)
        guess.value[row] -= guess.slopes[static_cast<std::size_t>(row)].back() * moved_[at];
    }
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
  active_.clear();
  force_ = VectorXd::Zero(free_.size());
  for (std::size_t z = 0; z < model_.zones.size(); ++z) {
    const auto law = side_.law_of(z, held);
    for (std::size_t i = 0; i < now_.status[z].size(); ++i)
      if (now_.status[z][i] != Status::open)
        add_point(z, i, law);
  }
}

void Condensed::add_point(std::size_t zone, std::size_t index, const contact::ZoneLaw& law) {
  auto& point = active_.emplace_back();
  point.zone = zone;
  point.index = index;
  point.response =
      contact::factor_response(law, index, now_.points[zone][index], now_.status[zone][index], model_.dofs);
  auto& response = point.response;
  const auto& position = system_.compliance->position_of_dof();
  for (std::size_t q = 0; q < response.dofs.size(); ++q) {
    const int at = position[static_cast<std::size_t>(response.dofs[q])];
    point.positions.push_back(at);
    if (at < 0)
      response.by_q.col(static_cast<Index>(q)).setZero();
    else
      force_[at] += response.spread.col(static_cast<Index>(q)).head(response.components).dot(response.force);
  }
  eliminate_multipliers(point);
}

/// The combinations of δz − Z_q δq − Z_m δm = 0 and −E_q δq − E_m δm = e that have no δm.
void Condensed::eliminate_multipliers(ActivePoint& point) const {
  auto& r = point.response;
  const Index d = r.components;
  const Index m = r.multipliers();
  const Index q = r.by_q.cols();
  for (Index row = d; row < d + m; ++row)
    if (r.by_multiplier.row(row).isZero(0) && r.by_q.row(row).lpNorm<Eigen::Infinity>() <=
                                                  empty_row * r.spread.topRows(d).lpNorm<Eigen::Infinity>()) {
      r.by_multiplier(row, row - d) = 1;
      r.by_q.row(row).setZero();
      r.equations[row - d] = 0;
    }
  MatrixXd all = MatrixXd::Zero(d + m, d + q + 1); // on δz, on δq, right side
  all.topLeftCorner(d, d).setIdentity();
  all.middleCols(d, q) = -r.by_q.topRows(d + m);
  all.col(d + q).tail(m) = r.equations;
  if (m > 0) {
    point.column_scale = row_sizes(r.by_multiplier.transpose()).cwiseInverse();
    const MatrixXd by_multiplier = r.by_multiplier * point.column_scale.asDiagonal();
    point.row_scale = row_sizes(by_multiplier).cwiseInverse();
    point.by_multiplier.compute(point.row_scale.asDiagonal() * by_multiplier);
    all = point.row_scale.asDiagonal() * all;
    all.applyOnTheLeft(point.by_multiplier.householderQ().adjoint());
  }
  point.equations = all.block(m, 0, d, d + q);
  point.right = all.col(d + q).tail(d);
  point.first = active_.size() > 1 ? (&point - 1)->first + (&point - 1)->unknowns() : 0;
}

bool Condensed::settled(const Held& held) {
  side_.collect_restless(held, previous_, now_, report_);
  measure_surface();
  return report_.residual <= report_.tolerance && report_.status_changes == 0 &&
         side_.settled(held, previous_, now_);
}

/// Until the bulk has been solved for, forces are measured by what they were measured by in the last step.
void Condensed::measure_surface() {
  Index worst = 0;
  const double largest =
      force_.size() > 0 ? scheme_.forces.now * (force_ - applied_).cwiseAbs().maxCoeff(&worst) : 0.0;
  const double scale = std::max(scale_, scheme_.forces.now * force_.lpNorm<Eigen::Infinity>());
  report_.residual = largest == 0 ? 0 : largest / scale;
  if (force_.size() > 0)
    report_.worst_node =
        model_.node_of(system_.compliance->dof_of_position()[static_cast<std::size_t>(worst)]);
}

bool Condensed::iterate(State& trial, const Held& held) {
  VectorXd y;
  if (!solve_points(y))
    return false;
  VectorXd force = force_;
  for (const auto& point : active_) {
    const VectorXd change = point.response.spread.transpose() * y.segment(point.first, point.unknowns());
    for (std::size_t q = 0; q < point.positions.size(); ++q)
      if (point.positions[q] >= 0)
        force[point.positions[q]] += change[static_cast<Index>(q)];
  }
  const VectorXd before = moved_;
  move_surface(force, trial);
  correct_multipliers(held, y, before, trial);
  return moved_.allFinite();
}

/// Surface positions of the active points.
void Condensed::collect_touched() {
  touched_.clear();
  touched_at_.assign(static_cast<std::size_t>(free_.size()), -1);
  for (const auto& point : active_)
    for (const int position : point.positions)
      if (position >= 0 && touched_at_[static_cast<std::size_t>(position)] < 0) {
        touched_at_[static_cast<std::size_t>(position)] = static_cast<int>(touched_.size());
        touched_.push_back(position);
      }
}

/// S Cᵀ of one point.
MatrixXd Condensed::answer_to(const ActivePoint& point, const MatrixXd& s) const {
  MatrixXd answer = MatrixXd::Zero(s.rows(), point.unknowns());
  for (std::size_t q = 0; q < point.positions.size(); ++q) {
    if (point.positions[q] < 0)
      continue;
    const auto from_q = s.col(touched_at_[static_cast<std::size_t>(point.positions[q])]);
    for (Index unknown = 0; unknown < answer.cols(); ++unknown)
      if (const double part = point.response.spread(unknown, static_cast<Index>(q)); part != 0)
        answer.col(unknown) += part * from_q;
  }
  return answer;
}

bool Condensed::solve_points(VectorXd& y) {
  const Index size = active_.empty() ? 0 : active_.back().first + active_.back().unknowns();
  if (size == 0)
    return true;
  collect_touched();
  const MatrixXd s = scheme_.forces.now * system_.compliance->between(touched_);
  const VectorXd g = free_(touched_) - moved_(touched_) - s * force_(touched_);
  MatrixXd answer(s.rows(), size); // of the touched dofs to −y
  for (const auto& point : active_)
    answer.middleCols(point.first, point.unknowns()) = answer_to(point, s);
  answer.transposeInPlace();

  MatrixXd matrix(size, size); // transposed: a point's equations are columns
  VectorXd right(size);
  for (const auto& point : active_) {
    const auto& r = point.response;
    const Index d = r.components;
    auto columns = matrix.middleCols(point.first, point.unknowns());
    auto values = right.segment(point.first, point.unknowns());
    columns.setZero();
    values << point.right, VectorXd::Zero(r.slopes);
    MatrixXd by_q(point.unknowns(), r.by_q.cols());
    by_q << point.equations.rightCols(r.by_q.cols()), -r.by_q.bottomRows(r.slopes);
    for (std::size_t q = 0; q < point.positions.size(); ++q) {
      if (point.positions[q] < 0)
        continue;
      const Index at = touched_at_[static_cast<std::size_t>(point.positions[q])];
      const auto on_q = by_q.col(static_cast<Index>(q));
      for (Index equation = 0; equation < on_q.size(); ++equation)
        if (on_q[equation] != 0)
          columns.col(equation) -= on_q[equation] * answer.col(at);
      values -= on_q * g[at];
    }
    columns.block(point.first, 0, d, d) += point.equations.leftCols(d).transpose();
    columns.block(point.first + d, d, r.slopes, r.slopes) += MatrixXd::Identity(r.slopes, r.slopes);
  }
  matrix.transposeInPlace();
  auto solution = solve_dense(std::move(matrix), std::move(right));
  if (!solution)
    return false;
  y = std::move(*solution);
  return true;
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

void Condensed::correct_multipliers(const Held& held, const VectorXd& y, const VectorXd& before,
                                    State& trial) const {
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
  for (const auto& point : active_) {
    const auto& r = point.response;
    const Index d = r.components;
    const Index m = r.multipliers();
    if (m == 0)
      continue;
    VectorXd right(d + m);
    right << y.segment(point.first, d), -r.equations;
    for (std::size_t q = 0; q < point.positions.size(); ++q)
      if (point.positions[q] >= 0)
        right -= r.by_q.col(static_cast<Index>(q)).head(d + m) *
                 (moved_[point.positions[q]] - before[point.positions[q]]);
    const VectorXd scaled = point.by_multiplier.solve(point.row_scale.cwiseProduct(right));
    trial.zones[point.zone].multipliers.segment(
        model_.zones[point.zone].points[point.index].node_position * m, m) +=
        point.column_scale.cwiseProduct(scaled);
  }
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
  for (const auto& point : active_) {
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
