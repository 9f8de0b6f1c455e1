// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mass in the form whose products read the least memory.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/linalg/nodal_matrix.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace rubato::model {

/// A mass that moves by Σ coefficients · u of dofs.
struct AttachedMass {
  std::vector<int> dofs;
  Eigen::VectorXd coefficients;
  double mass = 0; ///< [mass]
};

class Products {
public:
  Products() = default;
  /// `mass`: without those attached; may be empty. Of several ranks it is this one's part.
  Products(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& mass, int components,
           std::vector<AttachedMass> attached = {}, Ranks ranks = {});

  /// From now on the mass is Pᵀ M P.
  void extrapolate(Eigen::SparseMatrix<double, Eigen::ColMajor, int> extrapolation);

  /// M a [force], or M v; zero in static runs.
  Eigen::VectorXd mass(const Eigen::VectorXd& a) const;

  /// P a, the motion of the bodies near nodes without mass; a where all have mass.
  Eigen::VectorXd nearby(const Eigen::VectorXd& a) const;

private:
  std::optional<linalg::NodalMatrix> mass_;
  std::optional<Eigen::SparseMatrix<double, Eigen::ColMajor, int>> extrapolation_; ///< P
  std::vector<AttachedMass> attached_;
  Ranks ranks_;
};

} // namespace rubato::model
