// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/domain.hpp"

#include "rubato/domain/linear_domain.hpp"
#include "rubato/domain/nonlinear_domain.hpp"

#include <utility>

namespace rubato::domain {

using Eigen::VectorXd;

Domain::Domain() : kind_(std::make_shared<const Kind>()) {}

Domain::Domain(Kind kind, QuadratureStates states)
    : kind_(std::make_shared<const Kind>(std::move(kind))), initial_states_(std::move(states)) {}

Failed Domain::evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                        const Wanted& wanted) const {
  return std::visit([&](const auto& kind) { return kind.evaluate(step, old, now, wanted); }, *kind_);
}

double Domain::energy(const VectorXd& u, const VectorXd& forces, double t,
                      const QuadratureStates& states) const {
  return std::visit([&](const auto& kind) { return kind.energy(u, forces, t, states); }, *kind_);
}

VectorXd Domain::constant_forces(const VectorXd& u, double t) const {
  return std::visit([&](const auto& kind) { return kind.constant_forces(u, t); }, *kind_);
}

Balance Domain::balance(const QuadratureStates& old, const QuadratureStates& now) const {
  return std::visit([&](const auto& kind) { return kind.balance(old, now); }, *kind_);
}

double Domain::back_stress_energy(const QuadratureStates& states) const {
  return std::visit([&](const auto& kind) { return kind.back_stress_energy(states); }, *kind_);
}

double Domain::hourglass_energy(const VectorXd& u) const {
  return std::visit([&](const auto& kind) { return kind.hourglass_energy(u); }, *kind_);
}

bool Domain::has_own_scheme() const {
  return std::visit([](const auto& kind) { return kind.has_own_scheme(); }, *kind_);
}

std::span<const LawSpring> Domain::law_springs() const {
  return std::visit([](const auto& kind) { return kind.law_springs(); }, *kind_);
}

std::span<const LineSpring> Domain::line_springs() const {
  return std::visit([](const auto& kind) { return kind.line_springs(); }, *kind_);
}

const Heat* Domain::heat() const {
  return std::visit([](const auto& kind) { return kind.heat(); }, *kind_);
}

bool Domain::is_linear() const {
  return std::visit([](const auto& kind) { return kind.is_linear; }, *kind_);
}

const SparseMatrix& Domain::initial_tangent() const {
  return std::visit([](const auto& kind) -> const SparseMatrix& { return kind.initial_tangent(); }, *kind_);
}

PlasticStep Domain::plastic_step(const QuadratureStates& old, const QuadratureStates& now) const {
  return std::visit([&](const auto& kind) { return kind.plastic_step(old, now); }, *kind_);
}

double Domain::largest_eigenvalue(const VectorXd& inverse_mass, const AddUp& add_up,
                                  const Admit& admit) const {
  return std::visit([&](const auto& kind) { return kind.largest_eigenvalue(inverse_mass, add_up, admit); },
                    *kind_);
}

double Domain::growth(const VectorXd& u, const QuadratureStates& states, const LawPath& path, double rate,
                      double t) const {
  return std::visit([&](const auto& kind) { return kind.growth(u, states, path, rate, t); }, *kind_);
}

bool Domain::has_finite_strain() const {
  return std::visit([](const auto& kind) { return kind.has_finite_strain(); }, *kind_);
}

} // namespace rubato::domain
