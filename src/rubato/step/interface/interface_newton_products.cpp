// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the points' linear system is solved where S between them is not formed.
#include "rubato/linalg/gmres.hpp"
#include "rubato/step/interface/interface_newton_system.hpp"
#include "rubato/step/interface/near_surface.hpp"

#include <algorithm>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int most_gmres_products = 300;

} // namespace

std::optional<InterfaceNewtonSystem::Change>
InterfaceNewtonSystem::solved_by_products(const VectorXd& c, const linalg::WholeMatrix& matrix) const {
  const auto near = NearSurface::of(matrix.get(), compliance_, points(), force_weight_);
  if (!near)
    return std::nullopt;
  const auto left = residual(c, no_change());
  const VectorXd by_row = equation_weights(left, force_weight_ / matrix.get().diagonal().mean());
  const auto change_of = [&](const VectorXd& sides) {
    const VectorXd x = near->solve(sides.cwiseQuotient(by_row));
    return Change{x.head(forces_), x.tail(xi_count_), VectorXd()};
  };
  const auto weighted = [&](const Change& sides) {
    VectorXd all(forces_ + xi_count_);
    all << sides.force, sides.xi;
    return VectorXd(by_row.cwiseProduct(all));
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
      double size = point.by_force.row(a).lpNorm<Eigen::Infinity>();
      if (point.rows.left.cols() > 0)
        size = std::max(size, compliance * point.rows.left.row(a).lpNorm<Eigen::Infinity>());
      if (size > 0)
        weights[point.first + a] = 1 / size;
    }
  const double largest = weights.head(forces_).cwiseProduct(left.force).lpNorm<Eigen::Infinity>();
  if (largest > 0)
    weights.head(forces_) /= largest;
  return weights;
}

} // namespace rubato::step
