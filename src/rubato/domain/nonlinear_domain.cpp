// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_domain.hpp"

#include "rubato/core/error.hpp"
#include "rubato/domain/admitted_product.hpp"
#include "rubato/linalg/lanczos.hpp"
#include "rubato/linalg/ranked_matrix.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <utility>

namespace rubato::domain {
namespace {

using Eigen::VectorXd;

std::shared_ptr<const SparseMatrix> shared(std::optional<SparseMatrix>&& matrix) {
  if (!matrix)
    return nullptr;
  auto own = std::make_shared<SparseMatrix>();
  own->swap(*matrix);
  return own;
}

/// Of the cells of all ranks: the first that failed on the first rank that has one. `mode_force`: the largest
/// one of this rank, then of all.
Failed agreed(const Failed& own, double& mode_force, const Ranks& ranks) {
  struct Answer {
    double mode_force;
    bool failed;
    CellFailure failure;
  };
  const auto answers = ranks.each(Answer{mode_force, own.has_value(), own.value_or(CellFailure{})});
  mode_force = std::ranges::max(answers, {}, &Answer::mode_force).mode_force;
  const auto first = std::ranges::find(answers, true, &Answer::failed);
  return first == answers.end() ? Failed() : Failed(first->failure);
}

} // namespace

NonlinearDomain::NonlinearDomain(SparseMatrix&& constant, std::optional<SparseMatrix>&& initial,
                                 std::shared_ptr<const NonlinearCells> cells, int components,
                                 std::shared_ptr<const Heat> heat, std::vector<LawSpring> springs,
                                 const Workers& workers, std::vector<LineSpring> lines)
    : constant_(std::move(constant), components, std::move(heat), std::move(springs), workers),
      initial_(shared(std::move(initial))), cells_(std::move(cells)), lines_(std::move(lines)),
      ranks_(workers.ranks) {}

Failed NonlinearDomain::evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                                 const Wanted& wanted) const {
  constant_.evaluate_own(step, wanted);
  auto own = cells_->add(step, old, now, wanted, heat());
  if (!own && ranks_.is_first())
    own = add_lines(step, wanted);
  const auto failed = agreed(own, now.mode_force, ranks_);
  if (wanted.forces == nullptr)
    return failed;
  if (failed)
    wanted.forces->setConstant(std::numeric_limits<double>::quiet_NaN());
  else
    *wanted.forces = linalg::summed(std::move(*wanted.forces), ranks_);
  return failed;
}

/// Adds forces and tangents of the lines. Called on one rank: sums over ranks then have them once.
Failed NonlinearDomain::add_lines(const StepSpan& step, const Wanted& wanted) const {
  if (auto failed = find_without_length(lines_, step))
    return failed;
  if (wanted.forces != nullptr)
    add_line_forces(lines_, step, *wanted.forces);
  if (wanted.tangent != nullptr)
    add_line_tangents(lines_, step, wanted.tangent_of, *wanted.tangent);
  return {};
}

Balance NonlinearDomain::balance(const QuadratureStates& old, const QuadratureStates& now) const {
  const auto own = cells_->balance(old, now);
  auto parts = std::bit_cast<std::array<double, sizeof(Balance) / sizeof(double)>>(own);
  ranks_.sum(parts);
  return std::bit_cast<Balance>(parts);
}

PlasticStep NonlinearDomain::plastic_step(const QuadratureStates& old, const QuadratureStates& now) const {
  return std::ranges::max(ranks_.each(cells_->plastic_step(old, now)), {}, &PlasticStep::growth);
}

double NonlinearDomain::energy(const VectorXd& u, const VectorXd&, double t,
                               const QuadratureStates& states) const {
  double stored = 0;
  for (const auto& record : states.records)
    stored += record.volume * record.stored;
  return constant_.energy(u, constant_.constant_forces(u, t), t, {}) + ranks_.sum(stored) +
         line_energy(lines_, u);
}

VectorXd NonlinearDomain::constant_forces(const VectorXd& u, double t) const {
  return constant_.constant_forces(u, t);
}

const SparseMatrix& NonlinearDomain::initial_tangent() const {
  if (initial_ == nullptr)
    throw InputError(
        "an explicit run of nonlinear bodies has no stiffness of the whole: it is not assembled");
  return *initial_;
}

double NonlinearDomain::largest_eigenvalue(const VectorXd& inverse_mass, const AddUp& add_up,
                                           const Admit& admit) const {
  const auto multiply = [this](const VectorXd& x, VectorXd& y) {
    constant_.multiply(x, y);
    cells_->add_initial_product(x, y);
    add_bound_of_stiffness(lines_, x, y);
  };
  return linalg::largest_eigenvalue(AdmittedProduct(multiply, add_up, admit), inverse_mass);
}

} // namespace rubato::domain
