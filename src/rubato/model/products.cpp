// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/products.hpp"

namespace rubato::model {

Products::Products(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& mass, int components) {
  if (mass.nonZeros() > 0)
    mass_.emplace(mass, components);
}

Eigen::VectorXd Products::mass(const Eigen::VectorXd& a) const {
  return mass_ ? *mass_ * a : Eigen::VectorXd::Zero(a.size());
}

} // namespace rubato::model
