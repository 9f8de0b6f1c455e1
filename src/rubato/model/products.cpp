// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/products.hpp"

#include "rubato/linalg/ranked_matrix.hpp"

#include <utility>

namespace rubato::model {

Products::Products(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& mass, int components,
                   std::vector<AttachedMass> attached, Ranks ranks)
    : attached_(std::move(attached)), ranks_(std::move(ranks)) {
  if (mass.nonZeros() > 0)
    mass_.emplace(mass, components);
}

Eigen::VectorXd Products::mass(const Eigen::VectorXd& a) const {
  auto product =
      linalg::summed(mass_ ? Eigen::VectorXd(*mass_ * a) : Eigen::VectorXd::Zero(a.size()), ranks_);
  for (const auto& [dofs, coefficients, mass] : attached_) {
    double sum = 0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      sum += coefficients[static_cast<Eigen::Index>(i)] * a[dofs[i]];
    for (std::size_t i = 0; i < dofs.size(); ++i)
      product[dofs[i]] += mass * sum * coefficients[static_cast<Eigen::Index>(i)];
  }
  return product;
}

} // namespace rubato::model
