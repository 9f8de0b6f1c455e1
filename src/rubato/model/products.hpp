// SPDX-License-Identifier: LGPL-3.0-or-later
/// The mass in the form whose products read the least memory.
#pragma once

#include "rubato/linalg/nodal_matrix.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::model {

class Products {
public:
  Products() = default;
  /// `mass` may be empty.
  Products(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& mass, int components);

  /// M a [force], or M v; zero in static runs.
  Eigen::VectorXd mass(const Eigen::VectorXd& a) const;

private:
  std::optional<linalg::NodalMatrix> mass_;
};

} // namespace rubato::model
