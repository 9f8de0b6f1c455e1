// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/ritz_pairs.hpp"

#include "rubato/linalg/column_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon();
/// Part of A M v that is rounding where v spans the last direction of the Krylov space.
constexpr double exhausted = 100 * unit_roundoff;

class Lanczos {
public:
  Lanczos(const LinearMap& inverse, const LinearMap& mass, const RitzLimits& limits, Index size)
      : inverse_(inverse), mass_(mass), limits_(limits), basis_(size, limits.vectors),
        projected_(MatrixXd::Zero(limits.vectors, limits.vectors)) {}

  SymmetricEigen run(const VectorXd& start) {
    next_ = start;
    moved_ = mass_(next_);
    beside_ = norm_of_next();
    for (int restart = 0; beside_ > 0; ++restart) {
      expand();
      solve_projected();
      const Index converged = settle();
      if (converged == wanted() || restart == limits_.restarts || beside_ == 0)
        break;
      keep(std::min((wanted() + converged + count_) / 2, count_ - 1));
    }
    return settled_pairs();
  }

private:
  Index wanted() const { return std::min(limits_.wanted, count_); }

  /// In the norm of M.
  double norm_of_next() const { return std::sqrt(std::max(0.0, next_.dot(moved_))); }

  /// Takes what is perpendicular to the basis as its next vectors, up to the largest number.
  void expand() {
    while (count_ < limits_.vectors && beside_ > 0) {
      double* const column = &basis_(0, count_);
      for (Index i = 0; i < next_.size(); ++i)
        column[i] = next_[i] / beside_;
      moved_ /= beside_;
      ++count_;
      next_ = inverse_(moved_);
      moved_ = mass_(next_);
      const double length = norm_of_next();
      projected_(count_ - 1, count_ - 1) = take_out_basis() + take_out_basis();
      beside_ = norm_of_next();
      if (!(beside_ > exhausted * length))
        beside_ = 0;
      if (count_ < limits_.vectors)
        projected_(count_, count_ - 1) = beside_;
    }
  }

  /// Makes the next vector perpendicular to the basis. Returns its share of the last vector of the basis.
  double take_out_basis() {
    double share = 0;
    ColumnSum sum(next_.data(), next_.size());
    std::vector<double> shares(static_cast<std::size_t>(count_));
    for (Index k = 0; k < count_; ++k) {
      share = basis_.col(k).dot(moved_);
      shares[static_cast<std::size_t>(k)] = share;
    }
    for (Index k = 0; k < count_; ++k)
      sum.add(-shares[static_cast<std::size_t>(k)], &basis_(0, k));
    sum.add_rest();
    moved_ = mass_(next_);
    return share;
  }

  /// The lower triangle of the projected matrix has its entries.
  void solve_projected() {
    MatrixXd part(count_, count_);
    for (Index j = 0; j < count_; ++j)
      std::copy_n(&projected_(0, j), count_, &part(0, j));
    pairs_ = symmetric_eigen(part);
    order_.resize(static_cast<std::size_t>(count_));
    std::iota(order_.begin(), order_.end(), Index{0});
    std::ranges::stable_sort(
        order_, [&](Index a, Index b) { return std::abs(pairs_.values[a]) > std::abs(pairs_.values[b]); });
  }

  /// Notes which of the wanted values have converged. Returns how many.
  Index settle() {
    const double least = std::pow(unit_roundoff, 2.0 / 3.0);
    settled_.clear();
    for (Index k = 0; k < wanted(); ++k) {
      const Index pair = order_[static_cast<std::size_t>(k)];
      const double residual = beside_ * std::abs(pairs_.vectors(count_ - 1, pair));
      if (residual <= limits_.tolerance * std::max(least, std::abs(pairs_.values[pair])))
        settled_.push_back(pair);
    }
    return static_cast<Index>(settled_.size());
  }

  MatrixXd ritz_vectors(const std::vector<Index>& pairs) const {
    MatrixXd vectors = MatrixXd::Zero(basis_.rows(), static_cast<Index>(pairs.size()));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      ColumnSum sum(&vectors(0, static_cast<Index>(k)), vectors.rows());
      for (Index i = 0; i < count_; ++i)
        sum.add(pairs_.vectors(i, pairs[k]), &basis_(0, i));
      sum.add_rest();
    }
    return vectors;
  }

  /// The first Ritz vectors become the basis.
  void keep(Index kept) {
    const std::vector<Index> first(order_.begin(), order_.begin() + kept);
    const MatrixXd vectors = ritz_vectors(first);
    std::copy_n(vectors.data(), vectors.size(), basis_.data());
    projected_.setZero();
    for (Index k = 0; k < kept; ++k) {
      const Index pair = first[static_cast<std::size_t>(k)];
      projected_(k, k) = pairs_.values[pair];
      projected_(kept, k) = beside_ * pairs_.vectors(count_ - 1, pair);
    }
    count_ = kept;
  }

  SymmetricEigen settled_pairs() const {
    SymmetricEigen found{VectorXd(static_cast<Index>(settled_.size())), MatrixXd(basis_.rows(), 0)};
    for (std::size_t k = 0; k < settled_.size(); ++k)
      found.values[static_cast<Index>(k)] = pairs_.values[settled_[k]];
    if (!settled_.empty())
      found.vectors = ritz_vectors(settled_);
    return found;
  }

  const LinearMap& inverse_;
  const LinearMap& mass_;
  RitzLimits limits_;
  MatrixXd basis_;
  MatrixXd projected_; ///< lower triangle of Vᵀ M A M V
  Index count_ = 0;    ///< vectors in the basis
  VectorXd next_;      ///< perpendicular to the basis
  VectorXd moved_;     ///< M times it
  double beside_ = 0;  ///< its norm, 0 where the Krylov space ends
  SymmetricEigen pairs_;
  std::vector<Index> order_; ///< of the pairs, by falling magnitude
  std::vector<Index> settled_;
};

} // namespace

SymmetricEigen largest_ritz_pairs(const LinearMap& inverse, const LinearMap& mass, const VectorXd& start,
                                  const RitzLimits& limits) {
  return Lanczos(inverse, mass, limits, start.size()).run(start);
}

} // namespace rubato::linalg
