// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the points' linear system is solved where S between them is not formed.
#include "rubato/linalg/gmres.hpp"
#include "rubato/step/interface/interface_newton_system.hpp"
#include "rubato/step/interface/near_surface.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int most_gmres_products = 300;

double mean_diagonal(const linalg::SparseMatrix& matrix) {
  double sum = 0;
  for (Index column = 0; column < matrix.outerSize(); ++column)
    for (linalg::SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      sum += entry.row() == column ? entry.value() : 0.0;
  return sum / static_cast<double>(matrix.cols());
}

} // namespace

std::optional<InterfaceNewtonSystem::Change>
InterfaceNewtonSystem::solved_by_products(const VectorXd& c, const linalg::WholeMatrix& matrix) const {
  const auto near = NearSurface::of(matrix.get(), compliance_, points(), force_weight_);
  if (!near)
    return std::nullopt;
  const auto left = residual(c, no_change());
  const VectorXd by_row = equation_weights(left, force_weight_ / mean_diagonal(matrix.get()));
  const auto change_of = [&](VectorXd sides) {
    for (Index i = 0; i < sides.size(); ++i)
      sides[i] /= by_row[i];
    const VectorXd x = near->solve(sides);
    Change change{VectorXd(forces_), VectorXd(xi_count_), VectorXd()};
    std::copy_n(x.data(), forces_, change.force.data());
    std::copy_n(x.data() + forces_, xi_count_, change.xi.data());
    return change;
  };
  const auto weighted = [&](const Change& sides) {
    VectorXd all(forces_ + xi_count_);
    std::copy_n(sides.force.data(), forces_, all.data());
    std::copy_n(sides.xi.data(), xi_count_, all.data() + forces_);
    for (Index i = 0; i < all.size(); ++i)
      all[i] *= by_row[i];
    return all;
  };
  const VectorXd begun = weighted(left);
  // What a change takes of what is left: the equations are linear in it.
  const auto solution = linalg::gmres(
      [&](const VectorXd& sides) { return VectorXd(begun - weighted(residual(c, change_of(sides)))); }, begun,
      limits_.left_by_products, most_gmres_products);
  return solution ? std::optional(change_of(*solution)) : std::nullopt;
}

/// What is left of the equations of forces counts in parts of the largest one at the start, each with its
/// largest coefficient as one; displacements count by what a force moves, `compliance`.
VectorXd InterfaceNewtonSystem::equation_weights(const Change& left, double compliance) const {
  VectorXd weights = VectorXd::Ones(forces_ + xi_count_);
  for (const auto& point : points())
    for (Index a = 0; a < point.components(); ++a) {
      const double size =
          std::max(largest_of_row(point.by_force, a), compliance * largest_of_row(point.rows.left, a));
      if (size > 0)
        weights[point.first + a] = 1 / size;
    }
  double largest = 0;
  for (Index i = 0; i < forces_; ++i)
    largest = std::max(largest, std::abs(weights[i] * left.force[i]));
  for (Index i = 0; largest > 0 && i < forces_; ++i)
    weights[i] /= largest;
  return weights;
}

} // namespace rubato::step
