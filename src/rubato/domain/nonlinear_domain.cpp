// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_domain.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/lanczos.hpp"

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

} // namespace

NonlinearDomain::NonlinearDomain(SparseMatrix&& constant, std::optional<SparseMatrix>&& initial,
                                 std::shared_ptr<const NonlinearCells> cells, int components,
                                 std::shared_ptr<const Heat> heat, std::vector<LawSpring> springs,
                                 const Threads& threads)
    : constant_(std::move(constant), components, std::move(heat), std::move(springs), threads),
      initial_(shared(std::move(initial))), cells_(std::move(cells)) {}

Failed NonlinearDomain::evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                                 const Wanted& wanted) const {
  QuadratureStates none;
  constant_.evaluate({step.u0, step.u1, step.t0, step.t1, nullptr, step.of}, {}, none, wanted);
  return cells_->add(step, old, now, wanted, heat());
}

double NonlinearDomain::energy(const VectorXd& u, const VectorXd&, double t,
                               const QuadratureStates& states) const {
  double energy = constant_.energy(u, constant_.constant_forces(u, t), t, {});
  for (const auto& record : states.records)
    energy += record.volume * record.stored;
  return energy;
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

double NonlinearDomain::largest_eigenvalue(const VectorXd& inverse_mass, const AddUp& add_up) const {
  return linalg::largest_eigenvalue(
      [&](const VectorXd& x, VectorXd& y) {
        constant_.multiply(x, y);
        cells_->add_initial_product(x, y);
        if (add_up)
          add_up(y);
      },
      inverse_mass);
}

} // namespace rubato::domain
