// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/bulk_tangent.hpp"

#include "rubato/domain/line_springs.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::VectorXd;

/// What an iteration may leave of the residual before a kept factor is given up.
constexpr double kept_progress = 0.3;
/// With a tangent of their own.
constexpr double iterations_by_new_factor = 2;
/// Of the way that the step would go by itself: cells that yield have their tangent for the direction of it.
/// Far along that way they would be too soft for a step that turns out shorter.
constexpr double small_part = 1e-3;
/// Springs of contact that are tried one after the other, in parts of the stiffness of their nodes. Softer
/// ones make surfaces so compliant that contact does not settle, stiffer ones are in the way of surfaces that
/// move against them: along each other, or together.
struct SpringLevel {
  Held held;
  double part;
};
constexpr std::array<SpringLevel, 4> spring_levels{
    {{Held::as_contact, 0.1}, {Held::as_contact, 1}, {Held::everywhere, 0.1}, {Held::everywhere, 1}}};

} // namespace

domain::ForcesOf forces_of(const time::Scheme& scheme) {
  return scheme.conserving ? domain::ForcesOf::step : domain::ForcesOf::end;
}

BulkTangent::BulkTangent(const model::Model& model, const time::Scheme& scheme, EffectiveSystem& system,
                         const State& committed, double t, Factored factored, SpringsOfContact springs)
    : model_(model), scheme_(scheme), system_(system), committed_(committed), t_(t), factored_(factored),
      load_factor_(committed.load_factor), springs_(std::move(springs)) {
  hold(system_, {});
}

bool BulkTangent::is_fresh_at_start() const {
  return !committed_.tangent || committed_.step != system_.step || committed_.indefinite ||
         factored_ == Factored::no || model_.study.newton.tangent == study::TangentChoice::full;
}

BulkStart BulkTangent::start() {
  BulkStart start{VectorXd::Zero(committed_.motion.u.size()), {}};
  const auto here = at(committed_.motion.u, &start.forces);
  if (!is_fresh_at_start())
    go_on_with(committed_.tangent);
  else if (!renew_at_start())
    starts_indefinite_ = !put(here);
  start.tangent = system_.tangent;
  return start;
}

/// Counted where it was taken: a resumed run has to factor it again, others only after a failed attempt.
void BulkTangent::go_on_with(const Tangent& tangent) {
  const int counted = renewals_;
  put(tangent);
  renewals_ = counted;
}

bool BulkTangent::renew_at(const VectorXd& u) {
  const bool exact = scheme_.conserving && factored_ == Factored::no;
  return put(at(u, nullptr, exact ? domain::TangentOf::exact : domain::TangentOf::symmetric));
}

bool BulkTangent::renew_at_start() {
  return put(at(slightly_on(), nullptr));
}

/// By the velocity, or by the move of the last step.
VectorXd BulkTangent::slightly_on() const {
  const double length = small_part * (t_ - committed_.t);
  if (scheme_.dynamic)
    return committed_.motion.u + length * committed_.motion.v;
  if (committed_.moved.size() == 0 || committed_.step <= 0)
    return committed_.motion.u;
  return committed_.motion.u + length / committed_.step * committed_.moved;
}

/// Null where a cell has no answer.
Tangent BulkTangent::at(const VectorXd& u, VectorXd* forces, domain::TangentOf of) {
  if (matrix_.nonZeros() == 0)
    matrix_ = model_.domain.initial_tangent();
  const auto failed = model_.domain.evaluate(
      {committed_.motion.u, u, committed_.t, t_, nullptr, forces_of(scheme_)}, committed_.bulk_points,
      unused_, {.forces = forces, .tangent = &matrix_, .tangent_of = of});
  if (failed)
    return nullptr;
  model::add_follower_tangent(model_, t_, u, 1, matrix_, load_factor_);
  add_dashpots(u);
  return values_of(matrix_);
}

/// Adds the tangent of dashpots that rotate, which the constant damping matrix lacks. It is divided by the
/// factor of tangents in the effective matrix.
void BulkTangent::add_dashpots(const VectorXd& u) {
  const auto lines = model_.domain.line_springs();
  if (!scheme_.dynamic || !model_.sharing().is_first() || !domain::has_dashpots(lines))
    return;
  const auto predicted = time::predict(scheme_, system_.step, committed_.motion);
  const VectorXd v = predicted.v + system_.coefficients.velocity * (u - predicted.u);
  domain::add_line_damping_tangents(lines, u, v,
                                    {system_.coefficients.damping / system_.coefficients.stiffness,
                                     scheme_.damping.now / system_.coefficients.stiffness},
                                    matrix_);
}

bool BulkTangent::put(const Tangent& tangent) {
  if (!tangent)
    return false;
  if (factored_ == Factored::no) {
    renew_matrix(system_, model_, tangent);
    return true;
  }
  if (same_values(model_, system_.factored, tangent)) {
    renew_matrix(system_, model_, tangent);
    return true;
  }
  const auto before = system_.factored;
  const auto held_before = system_.held;
  if (held_before.empty()) {
    ++renewals_;
    if (renew(system_, model_, tangent))
      return true;
    indefinite_ = true;
  }
  if (put_held(tangent))
    return true;
  hold(system_, held_before);
  // A factor there must be for what asks for one before the next attempt.
  renew(system_, model_, before ? before : values_of(model_.domain.initial_tangent()));
  return false;
}

/// With springs where contact holds the bodies now. A step that needs them has them to its end.
bool BulkTangent::put_held(const Tangent& tangent) {
  for (; springs_ && level_ < spring_levels.size(); ++level_) {
    auto springs = springs_(spring_levels[level_].held);
    if (springs.empty())
      return false;
    for (auto& spring : springs)
      spring.stiffness *= spring_levels[level_].part;
    hold(system_, std::move(springs));
    ++renewals_;
    if (renew(system_, model_, tangent))
      return true;
  }
  return false;
}

bool BulkTangent::wants_renewal(double before, double now, double allowed) const {
  const auto choice = model_.study.newton.tangent;
  if (choice == study::TangentChoice::full || !(now < before))
    return true;
  const double progress = now / before;
  if (choice == study::TangentChoice::kept)
    return progress > kept_progress;
  // With contact in the matrix a kept tangent saves no factor.
  if (factored_ == Factored::no)
    return true;
  const double further = std::log(allowed / now) / std::log(progress);
  return further > iterations_by_new_factor + factor_in_iterations();
}

/// What a new factor costs, in iterations with the old one: floating-point operations of dense blocks run
/// some times faster than those of solves, which wait for memory. By counts, not by clocks: results do not
/// depend on the machine.
double BulkTangent::factor_in_iterations() const {
  if (!system_.compliance)
    return 0;
  constexpr double dense_speed = 8;
  constexpr double forces_by_entry = 4;
  constexpr double tangent_by_entry = 16;
  const auto entries = static_cast<double>(system_.compliance->factor_entries());
  const double factor = system_.compliance->factor_flops() / dense_speed + tangent_by_entry * system_.entries;
  const double iteration = 4 * entries + forces_by_entry * system_.entries;
  return factor / iteration;
}

} // namespace rubato::step
