// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/gmres.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <unsupported/Eigen/IterativeSolvers>

namespace rubato::linalg {

/// A product that Eigen's solvers take for a matrix, as its documentation of matrix-free solvers asks for.
class ProductMatrix;

} // namespace rubato::linalg

template <>
struct Eigen::internal::traits<rubato::linalg::ProductMatrix>
    : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace rubato::linalg {

class ProductMatrix : public Eigen::EigenBase<ProductMatrix> {
public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  ProductMatrix(const LinearMap& product, Eigen::Index size) : product_(product), size_(size) {}
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  Eigen::VectorXd times(const Eigen::VectorXd& x) const { return product_(x); }
  template <class Operand>
  Eigen::Product<ProductMatrix, Operand, Eigen::AliasFreeProduct>
  operator*(const Eigen::MatrixBase<Operand>& x) const {
    return Eigen::Product<ProductMatrix, Operand, Eigen::AliasFreeProduct>(*this, x.derived());
  }

private:
  const LinearMap& product_;
  Eigen::Index size_;
};

} // namespace rubato::linalg

template <class Operand>
struct Eigen::internal::generic_product_impl<rubato::linalg::ProductMatrix, Operand, Eigen::SparseShape,
                                             Eigen::DenseShape, Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<
          rubato::linalg::ProductMatrix, Operand,
          Eigen::internal::generic_product_impl<rubato::linalg::ProductMatrix, Operand>> {
  template <class Result>
  static void scaleAndAddTo(Result& result, const rubato::linalg::ProductMatrix& matrix, const Operand& x,
                            const double& factor) {
    result.noalias() += factor * matrix.times(x);
  }
};

namespace rubato::linalg {

std::optional<Eigen::VectorXd> gmres(const LinearMap& matrix, const Eigen::VectorXd& right_side,
                                     double tolerance, int most_products) {
  using Eigen::VectorXd;
  const ProductMatrix products(matrix, right_side.size());
  Eigen::GMRES<ProductMatrix, Eigen::IdentityPreconditioner> solver(products);
  solver.setTolerance(tolerance);
  solver.setMaxIterations(most_products);
  solver.set_restart(std::min<Eigen::Index>(most_products, right_side.size()));
  const VectorXd x = solver.solve(right_side);
  return solver.info() == Eigen::Success && x.allFinite() ? std::optional(x) : std::nullopt;
}

} // namespace rubato::linalg
