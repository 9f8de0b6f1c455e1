// SPDX-License-Identifier: LGPL-3.0-or-later
/// A contact point linearised in factors as narrow as the space it lives in, whatever its faces.
#pragma once

#include "rubato/contact/enforcement.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::contact {

/// What a point has a few of is kept where it is: nothing to allocate.
using PointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
using MultiplierColumns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 3>;

/// A point's equations of its multipliers, δe = E_m δm, times its weight.
struct PointEquations {
  PointVector values;                                                           ///< e, m entries
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> by_multiplier; ///< E_m
};

/// With δq the change of the point's local displacements (slave's nodes, then master's, component by
/// component) and δm that of its own multipliers, the force on q (internal side) and the equations change by
///   δf = Nᵀ δz + Hᵀ δξ,   δz = Z_q δq + Z_m δm,   δξ = P δq,   δe = E_q δq + E_m δm;
/// z = −w T [force] in d components, ξ the place on the master, m the multipliers at the point: its own, or
/// those interpolated from the nodes that share it.
struct FactoredResponse {
  std::vector<int> dofs;           ///< of q
  int components = 0;              ///< d
  int n_xi = 0;                    ///< size of ξ; 0 in a held frame or before an obstacle
  PointVector force;               ///< z, d entries
  Eigen::MatrixXd interpolation;   ///< N over H: d + n_xi rows
  Eigen::MatrixXd d_du;            ///< Z_q, E_q, P: d + m + n_xi rows
  MultiplierColumns by_multiplier; ///< Z_m, E_m: d + m rows, m columns
  PointVector equations;           ///< e, m entries

  int multipliers() const { return static_cast<int>(equations.size()); }
  /// Z_q over P: what the rows of `interpolation` are multiplied with as q changes.
  Eigen::MatrixXd force_by_displacement() const;
  PointEquations multiplier_equations() const;
};

/// A point in contact, written into the storage of another one.
void factor_response(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation, Status status,
                     const domain::DofMap& dofs, FactoredResponse& into);

/// What a point apart says of its multipliers: λ = 0, Λ = 0.
PointEquations open_equations(const ZoneLaw& law, std::size_t point, const PointEvaluation& evaluation);

} // namespace rubato::contact
