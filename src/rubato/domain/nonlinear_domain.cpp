// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_domain.hpp"

#include "rubato/linalg/lanczos.hpp"

#include <utility>

namespace rubato::domain {
namespace {

using Eigen::VectorXd;

std::shared_ptr<const SparseMatrix> shared(SparseMatrix&& matrix) {
  auto own = std::make_shared<SparseMatrix>();
  own->swap(matrix);
  return own;
}

} // namespace

NonlinearDomain::NonlinearDomain(SparseMatrix&& constant, SparseMatrix&& initial,
                                 std::shared_ptr<const NonlinearCells> cells, int components,
                                 std::shared_ptr<const Heat> heat, std::vector<LawSpring> springs)
    : constant_(std::move(constant), components, std::move(heat), std::move(springs)),
      initial_(shared(std::move(initial))), cells_(std::move(cells)), components_(components) {}

Failed NonlinearDomain::evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                                 const Wanted& wanted) const {
  constant_.evaluate({step.u0, step.u1, step.t0, step.t1}, {}, now, wanted);
  return cells_->add(step, old, now, wanted);
}

double NonlinearDomain::energy(const VectorXd& u, const VectorXd&, double t,
                               const QuadratureStates& states) const {
  VectorXd constant;
  QuadratureStates none;
  constant_.evaluate({u, u, t, t}, {}, none, {.forces = &constant});
  double energy = constant_.energy(u, constant, t, none);
  for (const auto& record : states.records)
    energy += record.volume * record.stored;
  return energy;
}

double NonlinearDomain::largest_eigenvalue(const VectorXd& inverse_mass) const {
  const linalg::SymmetricBlockMatrix product(*initial_, components_);
  return linalg::largest_eigenvalue(product, inverse_mass);
}

} // namespace rubato::domain
