// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/products.hpp"

#include "rubato/linalg/ranked_matrix.hpp"
#include "rubato/linalg/sparse_products.hpp"

#include <utility>

namespace rubato::model {

Products::Products(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& mass, int components,
                   std::vector<AttachedMass> attached, Ranks ranks)
    : attached_(std::move(attached)), ranks_(std::move(ranks)) {
  if (mass.nonZeros() > 0)
    mass_.emplace(mass, components);
}

void Products::extrapolate(Eigen::SparseMatrix<double, Eigen::ColMajor, int> extrapolation) {
  extrapolation_ = std::move(extrapolation);
}

Eigen::VectorXd Products::mass(const Eigen::VectorXd& a) const {
  Eigen::VectorXd own = Eigen::VectorXd::Zero(a.size());
  if (mass_)
    own = extrapolation_
              ? linalg::transposed_product(*extrapolation_, *mass_ * linalg::product(*extrapolation_, a))
              : *mass_ * a;
  auto product = linalg::summed(std::move(own), ranks_);
  for (const auto& [dofs, coefficients, mass] : attached_) {
    double sum = 0;
    for (std::size_t i = 0; i < dofs.size(); ++i)
      sum += coefficients[static_cast<Eigen::Index>(i)] * a[dofs[i]];
    for (std::size_t i = 0; i < dofs.size(); ++i)
      product[dofs[i]] += mass * sum * coefficients[static_cast<Eigen::Index>(i)];
  }
  return product;
}

Eigen::VectorXd Products::nearby(const Eigen::VectorXd& a) const {
  return extrapolation_ ? linalg::product(*extrapolation_, a) : a;
}

} // namespace rubato::model
