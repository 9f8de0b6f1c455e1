// SPDX-License-Identifier: LGPL-3.0-or-later
/// The bulk next to points in contact: what preconditions their linear system where S is too large to form.
#pragma once

#include "rubato/linalg/direct_solver.hpp"
#include "rubato/step/interface/active_point.hpp"
#include "rubato/step/interface/compliance.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>

namespace rubato::step {

/// The equations of points (interface_newton_system.hpp) with the nodes that they act on, all others held:
///   A₁ δz + A₂ d = r,   δξ − P d = r_ξ,   A_nn d + f₁ (Nᵀ δz)_n = 0,
/// n the unknowns of these nodes, and the little that moving places change of forces left out. Factored as
/// one sparse matrix; the faces of both sides, whatever they are made of, and the statuses of all points are
/// in it as they are. It is what FETI methods know as the lumped preconditioner (Farhat and Roux, Int. J.
/// Numer. Meth. Engng. 32, 1991): it misses how far forces that go one way over many cells move the bulk,
/// which some iterations of GMRES find.
class NearSurface {
public:
  /// `matrix`: A. Nothing comes back where the equations of the points are singular.
  static std::optional<NearSurface> of(const linalg::SparseMatrix& matrix, const Compliance& compliance,
                                       std::span<const ActivePoint> points, double force_weight);

  /// δz of all points, then δξ of all points, from r and r_ξ in the same order.
  Eigen::VectorXd solve(const Eigen::VectorXd& left) const;

private:
  NearSurface(linalg::LuFactor factor, const linalg::SparseMatrix& slopes)
      : factor_(std::move(factor)), slopes_(slopes) {}

  linalg::LuFactor factor_;
  linalg::SparseMatrix slopes_; ///< P, a column an unknown that is near
};

} // namespace rubato::step
