// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/linear_domain.hpp"

#include "rubato/domain/admitted_product.hpp"
#include "rubato/linalg/lanczos.hpp"
#include "rubato/linalg/ranked_matrix.hpp"

#include <algorithm>
#include <utility>

namespace rubato::domain {

using Eigen::VectorXd;

LinearDomain::LinearDomain(SparseMatrix&& stiffness, int components, std::shared_ptr<const Heat> heat,
                           std::vector<LawSpring> springs, const Workers& workers)
    : heat_(std::move(heat)), springs_(std::move(springs)), threads_(workers.threads), ranks_(workers.ranks) {
  if (stiffness.nonZeros() > 0)
    product_.emplace(stiffness, components, threads_);
  const auto own = std::make_shared<SparseMatrix>();
  own->swap(stiffness);
  stiffness_ = own;
}

Failed LinearDomain::evaluate(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                              const Wanted& wanted) const {
  now = old;
  if (wanted.forces != nullptr && step.forces0 != nullptr && !heat_ && step.u1 == step.u0) {
    evaluate_own(step, {.tangent = wanted.tangent});
    *wanted.forces = *step.forces0;
    return {};
  }
  evaluate_own(step, wanted);
  if (wanted.forces != nullptr)
    *wanted.forces = linalg::summed(std::move(*wanted.forces), ranks_);
  return {};
}

void LinearDomain::evaluate_own(const StepSpan& step, const Wanted& wanted) const {
  if (wanted.tangent != nullptr)
    copy_stiffness(*wanted.tangent);
  if (wanted.forces == nullptr)
    return;
  own_forces_at(step.u1, step.t1, *wanted.forces);
  if (step.of == ForcesOf::end)
    return;
  VectorXd at_start;
  own_forces_at(step.u0, step.t0, at_start);
  *wanted.forces = 0.5 * (at_start + *wanted.forces);
}

/// The pattern is there already, but for the first time.
void LinearDomain::copy_stiffness(SparseMatrix& tangent) const {
  if (tangent.cols() != stiffness_->cols() || tangent.nonZeros() != stiffness_->nonZeros()) {
    tangent = *stiffness_;
    return;
  }
  constexpr std::size_t fewest = 500'000; // numbers that are worth a thread
  const auto size = static_cast<std::size_t>(tangent.nonZeros());
  threads_.each_range(size, fewest, [&](std::size_t first, std::size_t last) {
    std::copy(stiffness_->valuePtr() + first, stiffness_->valuePtr() + last, tangent.valuePtr() + first);
  });
}

/// What all ranks know counts on the first one.
void LinearDomain::own_forces_at(const VectorXd& u, double t, VectorXd& forces) const {
  forces.resize(u.size());
  multiply(u, forces);
  if (!ranks_.is_first())
    return;
  add_beyond_matrix(springs_, u, forces);
  if (heat_)
    forces -= heat_->force(t);
}

double LinearDomain::energy(const VectorXd& u, const VectorXd& forces, double t,
                            const QuadratureStates&) const {
  const double energy = 0.5 * u.dot(forces) + energy_beyond_products(springs_, u);
  return heat_ ? energy - 0.5 * u.dot(heat_->force(t)) + heat_->held_energy(t) : energy;
}

VectorXd LinearDomain::constant_forces(const VectorXd& u, double t) const {
  VectorXd forces;
  own_forces_at(u, t, forces);
  return linalg::summed(std::move(forces), ranks_);
}

void LinearDomain::multiply(const VectorXd& x, VectorXd& y) const {
  if (product_)
    product_->multiply(x, y);
  else
    y.setZero();
}

double LinearDomain::largest_eigenvalue(const VectorXd& inverse_mass, const AddUp& add_up,
                                        const Admit& admit) const {
  const auto multiplied = [this](const VectorXd& x, VectorXd& y) { multiply(x, y); };
  return linalg::largest_eigenvalue(AdmittedProduct(multiplied, add_up, admit), inverse_mass);
}

} // namespace rubato::domain
