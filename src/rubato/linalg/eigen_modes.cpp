// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/eigen_modes.hpp"

#include "rubato/linalg/constrained_inverse.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/pivots.hpp"

#include <Spectra/SymGEigsShiftSolver.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Vectors with a larger residual are corrected.
constexpr double wanted_residual = 1e-9;
/// Modes with a larger residual do not count as found. Values are off by about its square.
constexpr double largest_residual = 1e-7;

/// Vectors beyond the wanted ones: the last of these converge faster with neighbours beside them.
constexpr Index guards = 2;
/// Of Krylov spaces, beyond twice the wanted values: with so many most problems need no restart.
constexpr Index further_vectors = 12;
constexpr Index most_restarts = 300;
/// Of Ritz values, relative: near rounding.
constexpr double settled = 1e-10;
/// Of those that only say whether a value is missing; λ is then off by about the square.
constexpr double settled_roughly = 1e-3;
/// As near above the largest wanted value a rough one may belong to a missing value.
constexpr double perhaps_below = 1e-3;
/// Values looked for at once when one is missing, and how often.
constexpr Index missing_at_once = 4;
constexpr unsigned most_searches = 60;
/// Two of them reach rounding for a plate of side 20 and thickness 0.05, whose factor solves to 1e-3 only.
constexpr int most_corrections = 3;

/// Up to the first a dense solution takes less than a second, up to the second less than a minute.
constexpr Index smallest_sparse = 500;
constexpr Index largest_for_many = 3000;
/// 1/(λ − σ) beside its largest, below which there is no mass that moves.
constexpr double massless = 1e-13;

/// σ in parts of tr K/tr M, times (number of unknowns)^(2/3): of a compact body about the square of its
/// lowest circular frequency, so that solutions keep their digits and values their distance.
constexpr double shift_share = 1e-3;

double free_shift(const SparseMatrix& stiffness, const SparseMatrix& mass) {
  const double mean = stiffness.diagonal().sum() / mass.diagonal().sum();
  return -shift_share * mean / std::pow(static_cast<double>(stiffness.rows()), 2.0 / 3.0);
}

/// Size of a Krylov space in which that many values settle.
Index krylov_vectors(Index number) {
  return 2 * number + further_vectors;
}

VectorXd random_vector(Index size, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  return VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

/// Linear combinations of the columns of `basis` that solve K φ = λ M φ among them, ascending.
SymmetricEigen rayleigh_ritz(const SparseMatrix& stiffness, const SparseMatrix& mass, MatrixXd basis) {
  MatrixXd moved = mass * basis;
  const VectorXd scale = basis.cwiseProduct(moved).colwise().sum().cwiseSqrt().cwiseInverse().transpose();
  basis *= scale.asDiagonal();
  moved *= scale.asDiagonal();
  const MatrixXd resisted = stiffness * basis;
  auto modes = generalized_eigen(basis.transpose() * resisted, basis.transpose() * moved);
  modes.vectors = basis * modes.vectors;
  return modes;
}

/// The vectors found so far, and Lanczos runs in what is M-orthogonal to them.
class ModeSearch {
public:
  ModeSearch(const SparseMatrix& stiffness, const SparseMatrix& mass, const ConstrainedInverse& inverse,
             double shift)
      : stiffness_(stiffness), mass_(mass), inverse_(inverse), shift_(shift) {}

  /// Whether the first `number` are certain to be the smallest ones.
  bool find(Index number) {
    add(lanczos(number + guards, settled, 0));
    for (unsigned search = 1; search < most_searches; ++search) {
      const auto rough = lanczos(1, settled_roughly, search);
      if (rough.values.size() == 0)
        return false;
      const bool enough = modes_.values.size() >= number;
      if (enough && rough.values[0] - shift_ > (1 + perhaps_below) * (modes_.values[number - 1] - shift_))
        return true;
      add(lanczos(missing_at_once, settled, search));
    }
    return false;
  }

  /// Inverse iteration of all vectors together.
  void refine() {
    modes_ = rayleigh_ritz(stiffness_, mass_, inverse_.solve(MatrixXd(mass_ * modes_.vectors)));
    moved_ = mass_ * modes_.vectors;
  }

  const SymmetricEigen& modes() const { return modes_; }

private:
  /// (K − σ M)⁻¹ without what was found; Spectra wants these functions.
  struct Inverse {
    using Scalar = double;
    const ModeSearch* search;
    Index rows() const { return search->stiffness_.rows(); }
    Index cols() const { return rows(); }
    void set_shift(double /*unused*/) {}
    void perform_op(const double* x, double* y) const {
      Eigen::Map<VectorXd>(y, rows()) = search->solve_in_rest(Eigen::Map<const VectorXd>(x, rows()));
    }
  };
  struct Mass {
    using Scalar = double;
    const SparseMatrix* mass;
    Index rows() const { return mass->rows(); }
    Index cols() const { return rows(); }
    void perform_op(const double* x, double* y) const {
      Eigen::Map<VectorXd>(y, rows()).noalias() = mass->transpose() * Eigen::Map<const VectorXd>(x, rows());
    }
  };

  VectorXd solve_in_rest(const VectorXd& right_side) const {
    VectorXd solution = inverse_.solve(right_side);
    if (modes_.vectors.cols() > 0)
      solution -= modes_.vectors * (moved_.transpose() * solution);
    return solution;
  }

  SymmetricEigen lanczos(Index number, double tolerance, unsigned seed) const {
    Inverse inverse{this};
    Mass mass{&mass_};
    const Index vectors = std::min(krylov_vectors(number), stiffness_.rows());
    Spectra::SymGEigsShiftSolver<Inverse, Mass, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, number,
                                                                                        vectors, shift_);
    const VectorXd start = solve_in_rest(mass_ * random_vector(stiffness_.rows(), seed));
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestMagn, most_restarts, tolerance);
    return {solver.eigenvalues(), solver.eigenvectors()};
  }

  void add(const SymmetricEigen& found) {
    if (found.vectors.cols() == 0)
      return;
    MatrixXd together(stiffness_.rows(), modes_.vectors.cols() + found.vectors.cols());
    together << modes_.vectors, found.vectors;
    modes_.vectors.swap(together);
    refine();
  }

  const SparseMatrix& stiffness_;
  const SparseMatrix& mass_;
  const ConstrainedInverse& inverse_;
  double shift_;
  SymmetricEigen modes_{VectorXd(), MatrixXd(stiffness_.rows(), 0)};
  MatrixXd moved_; ///< M φ
};

/// All of them, from the dense problem M φ = θ (K − σ M) φ, which takes masses that are 0.
SymmetricEigen dense_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                           const SparseMatrix& constraints, double shift) {
  const Index kept = stiffness.rows() - constraints.cols();
  const MatrixXd basis = constraints.cols() == 0
                             ? MatrixXd::Identity(kept, kept)
                             : MatrixXd(orthogonal_factor(MatrixXd(constraints)).rightCols(kept));
  const MatrixXd moved = basis.transpose() * (mass * basis);
  const MatrixXd shifted = basis.transpose() * (stiffness * basis) - shift * moved;
  const auto inverse = generalized_eigen(moved, shifted);
  Index first = 0;
  while (first < kept && inverse.values[first] <= massless * inverse.values[kept - 1])
    ++first;
  if (first == kept)
    return {VectorXd(), MatrixXd(stiffness.rows(), 0)};
  return rayleigh_ritz(stiffness, mass, basis * inverse.vectors.rightCols(kept - first));
}

/// Longer than double where the processor has such numbers: the terms of K φ cancel each other to
/// λ_1/λ_max of their size, 1e-7 of a beam that is finely meshed.
using ExtendedVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

ExtendedVector product(const SparseMatrix& matrix, const VectorXd& vector) {
  ExtendedVector sum = ExtendedVector::Zero(matrix.rows());
  for (int column = 0; column < matrix.cols(); ++column) {
    const long double factor = vector[column];
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      sum[entry.row()] += entry.value() * factor;
  }
  return sum;
}

/// |A| |x|, of magnitudes: what rounding of x changes in A x is measured by.
VectorXd product_of_magnitudes(const SparseMatrix& matrix, const VectorXd& vector) {
  VectorXd sum = VectorXd::Zero(matrix.rows());
  for (int column = 0; column < matrix.cols(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      sum[entry.row()] += std::abs(entry.value() * vector[column]);
  return sum;
}

void turn_positive(Eigen::Ref<VectorXd> vector) {
  Index largest = 0;
  vector.cwiseAbs().maxCoeff(&largest);
  if (vector[largest] < 0)
    vector = -vector;
}

/// Modes that were found, and their residuals.
class FoundModes {
public:
  /// The first `number` of `found`.
  FoundModes(const SparseMatrix& stiffness, const SparseMatrix& mass, const ConstrainedInverse& inverse,
             double shift, const SymmetricEigen& found, Index number)
      : stiffness_(stiffness), mass_(mass), inverse_(inverse) {
    const Index count = std::min(number, found.vectors.cols());
    modes_ = {VectorXd(count), found.vectors.leftCols(count), VectorXd(count), shift, true};
    rounding_.resize(count);
    if (count == 0)
      return;
    measure();
    for (int i = 0; i < most_corrections && !are_below(wanted_residual); ++i)
      correct();
    modes_.converged = are_below(largest_residual);
  }

  EigenModes take() { return std::move(modes_); }

private:
  /// Inverse iteration that rounds corrections only: φ − (K − σM)⁻¹ (K − λM) φ = (λ − σ) (K − σM)⁻¹ M φ. It
  /// turns all vectors towards the lowest ones, which Rayleigh and Ritz undo.
  void correct() {
    modes_.vectors -= corrections_;
    const Index count = modes_.vectors.cols();
    MatrixXd resisted(count, count), moved(count, count);
    for (Index k = 0; k < count; ++k) {
      resisted.col(k) = along_vectors(product(stiffness_, modes_.vectors.col(k)));
      moved.col(k) = along_vectors(product(mass_, modes_.vectors.col(k)));
    }
    modes_.vectors = modes_.vectors * generalized_eigen(resisted, moved).vectors;
    measure();
  }

  /// Φᵀ f
  VectorXd along_vectors(const ExtendedVector& force) const {
    VectorXd sums(modes_.vectors.cols());
    for (Index i = 0; i < sums.size(); ++i)
      sums[i] = static_cast<double>(modes_.vectors.col(i).cast<long double>().dot(force));
    return sums;
  }

  void measure() {
    MatrixXd residuals(stiffness_.rows(), modes_.values.size());
    for (Index k = 0; k < residuals.cols(); ++k)
      residuals.col(k) = residual_of(k);
    corrections_ = inverse_.solve(residuals);
    for (Index k = 0; k < residuals.cols(); ++k) {
      const double work = std::max(0.0, residuals.col(k).dot(corrections_.col(k)));
      modes_.residuals[k] = std::sqrt(work / (modes_.values[k] - modes_.shift));
    }
  }

  /// Makes the vector one of φ·M φ = 1 and the value its Rayleigh's quotient.
  VectorXd residual_of(Index k) {
    auto vector = modes_.vectors.col(k);
    turn_positive(vector);
    const ExtendedVector resisted = product(stiffness_, vector);
    const ExtendedVector moved = product(mass_, vector);
    const ExtendedVector extended = vector.cast<long double>();
    const auto square = extended.dot(moved);
    auto value = static_cast<double>(extended.dot(resisted) / square);
    const double length = std::sqrt(static_cast<double>(square));
    const double magnitudes = product_of_magnitudes(stiffness_, vector).dot(vector.cwiseAbs());
    if (modes_.shift < 0 && value * length * length <= negligible_pivot * magnitudes)
      value = 0;
    modes_.values[k] = value;
    rounding_[k] =
        std::numeric_limits<double>::epsilon() * std::sqrt(magnitudes / (value - modes_.shift)) / length;
    const VectorXd force = inverse_.without_reactions((resisted - value * moved).cast<double>()) / length;
    vector /= length;
    return force;
  }

  bool are_below(double bound) const {
    return (modes_.residuals.array() <= rounding_.array().max(bound)).all();
  }

  const SparseMatrix& stiffness_;
  const SparseMatrix& mass_;
  const ConstrainedInverse& inverse_;
  EigenModes modes_;
  MatrixXd corrections_; ///< A⁻¹ r of each mode
  VectorXd rounding_;    ///< what the last digit of each φ adds to its residual
};

/// Dense, then one inverse iteration: high eigenvalues round what low ones have of a dense solution.
EigenModes find_densely(const SparseMatrix& stiffness, const SparseMatrix& mass,
                        const ConstrainedInverse& inverse, double shift, Index number) {
  auto modes = dense_modes(stiffness, mass, inverse.constraints(), shift);
  const Index count = std::min(number + guards, modes.vectors.cols());
  if (count > 0)
    modes = rayleigh_ritz(stiffness, mass, inverse.solve(MatrixXd(mass * modes.vectors.leftCols(count))));
  return FoundModes(stiffness, mass, inverse, shift, modes, number).take();
}

/// Of a few unknowns, of many modes beside them, and where they leave no room for a Krylov space.
bool is_dense_cheaper(Index size, Index number) {
  const Index vectors = krylov_vectors(number + guards);
  return size <= smallest_sparse || (size <= largest_for_many && size <= 4 * vectors) || size < vectors;
}

EigenModes find_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                      const ConstrainedInverse& inverse, double shift, Index number) {
  if (is_dense_cheaper(stiffness.rows(), number))
    return find_densely(stiffness, mass, inverse, shift, number);
  ModeSearch search(stiffness, mass, inverse, shift);
  const bool complete = search.find(number);
  auto modes = FoundModes(stiffness, mass, inverse, shift, search.modes(), number).take();
  modes.converged = modes.converged && complete;
  return modes;
}

} // namespace

std::optional<EigenModes> smallest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                                         const SparseMatrix& constraints, Index number, Support support) {
  if (stiffness.rows() != stiffness.cols() || mass.rows() != stiffness.rows() ||
      mass.cols() != stiffness.cols() || number < 1)
    throw std::invalid_argument("smallest_modes wants two square matrices of one size and a number above 0.");
  // Of a mass with the pattern of the stiffness two thirds are zeros: components do not couple.
  const SparseMatrix moving = mass.pruned(1, 0);
  if (support == Support::unknown)
    if (auto inverse = ConstrainedInverse::of(stiffness, constraints))
      return find_modes(stiffness, moving, *inverse, 0, number);
  const double shift = free_shift(stiffness, moving);
  if (!std::isfinite(shift) || !(shift < 0))
    return std::nullopt;
  if (auto inverse = ConstrainedInverse::of(SparseMatrix(stiffness - shift * moving), constraints))
    return find_modes(stiffness, moving, *inverse, shift, number);
  return std::nullopt;
}

} // namespace rubato::linalg
