// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/explicit/constrained_mass.hpp"

#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"

#include <algorithm>
#include <utility>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

void sort_unique(std::vector<int>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// Where a number stands among ascending ones that have it.
int place_of_number(const std::vector<int>& ascending, int number) {
  return static_cast<int>(std::ranges::lower_bound(ascending, number) - ascending.begin());
}

} // namespace

ConstrainedMass::ConstrainedMass(const VectorXd& lumped, linalg::SparseMatrix attached,
                                 const constraint::Reduction& reduction)
    : lumped_(&lumped), attached_(std::move(attached)) {
  collect(reduction);
  if (couples())
    factor(reduction);
}

void ConstrainedMass::collect(const constraint::Reduction& reduction) {
  for (const auto& dependent : reduction.dependents())
    for (const auto& term : dependent.of)
      coupled_.push_back(term.dof);
  for (Index column = 0; column < attached_.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(attached_, column); entry; ++entry)
      reduction.for_each_unknown(static_cast<int>(entry.row()), [&](int unknown, double) {
        coupled_.push_back(reduction.free_dofs()[static_cast<std::size_t>(unknown)]);
      });
  sort_unique(coupled_);
  for (const auto& dependent : reduction.dependents()) {
    Follower follower{dependent.dof, {}, {}};
    for (const auto& term : dependent.of) {
      follower.of.push_back(place_of_number(coupled_, term.dof));
      follower.coefficients.push_back(term.coefficient);
    }
    if (!follower.of.empty())
      followers_.push_back(std::move(follower));
  }
}

void ConstrainedMass::factor(const constraint::Reduction& reduction) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t i = 0; i < coupled_.size(); ++i)
    entries.emplace_back(static_cast<int>(i), static_cast<int>(i), (*lumped_)[coupled_[i]]);
  for (const auto& follower : followers_)
    for (std::size_t i = 0; i < follower.of.size(); ++i)
      for (std::size_t j = 0; j < follower.of.size(); ++j)
        entries.emplace_back(follower.of[i], follower.of[j],
                             (*lumped_)[follower.dof] * follower.coefficients[i] * follower.coefficients[j]);
  const auto place = [&](int unknown) {
    return place_of_number(coupled_, reduction.free_dofs()[static_cast<std::size_t>(unknown)]);
  };
  for (Index column = 0; column < attached_.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(attached_, column); entry; ++entry)
      reduction.for_each_unknown(static_cast<int>(entry.row()), [&](int row, double left) {
        reduction.for_each_unknown(static_cast<int>(entry.col()), [&](int other, double right) {
          entries.emplace_back(place(row), place(other), left * entry.value() * right);
        });
      });
  const auto size = static_cast<Index>(coupled_.size());
  linalg::SparseMatrix mass(size, size);
  mass.setFromTriplets(entries.begin(), entries.end());
  auto factor = linalg::CholeskyFactor::of(mass);
  if (!factor)
    throw InputError("the masses of the dofs that relations couple are not positive to working precision: "
                     "coefficients of the relations differ by too many orders of magnitude");
  factor_ = std::make_shared<const linalg::CholeskyFactor>(std::move(*factor));
}

void ConstrainedMass::respond(const VectorXd& force, VectorXd& motion) const {
  if (!couples())
    return;
  VectorXd gathered = force(coupled_);
  for (const auto& follower : followers_)
    for (std::size_t i = 0; i < follower.of.size(); ++i)
      gathered[follower.of[i]] += follower.coefficients[i] * force[follower.dof];
  const VectorXd unknowns = factor_->solve(gathered);
  for (std::size_t i = 0; i < coupled_.size(); ++i)
    motion[coupled_[i]] = unknowns[static_cast<Index>(i)];
  for (const auto& follower : followers_) {
    double sum = 0;
    for (std::size_t i = 0; i < follower.of.size(); ++i)
      sum += follower.coefficients[i] * unknowns[follower.of[i]];
    motion[follower.dof] = sum;
  }
}

VectorXd ConstrainedMass::times(const VectorXd& x) const {
  VectorXd product = lumped_->cwiseProduct(x);
  if (has_attached())
    product += attached_ * x;
  return product;
}

double ConstrainedMass::attached_product(const VectorXd& x, const VectorXd& y) const {
  return has_attached() ? x.dot(attached_ * y) : 0.0;
}

template <class Visit> void ConstrainedMass::for_each_dof(const Visit& visit) const {
  for (const int dof : coupled_)
    visit(dof);
  for (const auto& follower : followers_)
    visit(follower.dof);
}

void ConstrainedMass::admit(VectorXd& x) const {
  for_each_dof([&](int dof) { x[dof] *= (*lumped_)[dof]; });
  respond(x, x);
}

void ConstrainedMass::admit_forces(VectorXd& f) const {
  respond(f, f);
  for_each_dof([&](int dof) { f[dof] *= (*lumped_)[dof]; });
}

} // namespace rubato::step
