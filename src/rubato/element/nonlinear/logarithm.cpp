// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/logarithm.hpp"

#include "rubato/element/nonlinear/pair.hpp"
#include "rubato/element/nonlinear/voigt_tensor.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using material::Tangent6;

/// Numbers nearer than this, relative to the larger, get the series: the differences of the others lose
/// fewer than two digits.
constexpr double closeness = 0.05;

bool are_close(double a, double b) {
  return std::abs(a - b) < closeness * (1 + std::max(a, b));
}

/// artanh(x)/x for |x| ≤ closeness/2, to rounding: the first term left out is x¹⁰/11.
double artanh_ratio(double x) {
  const double y = x * x;
  return 1 + y * (1. / 3 + y * (1. / 5 + y * (1. / 7 + y / 9)));
}

/// e[a,b,c] about the mean m: Σ_k e^(k+2)(m)/(k+2)! h_k, h_k the sum of all products of k distances from m;
/// h_k = −e₂ h_(k−2) + e₃ h_(k−3), e₂ and e₃ the elementary sums of products.
double second_difference_of_close(double a, double b, double c) {
  constexpr int most_terms = 14; // distances/m ≤ 0.034: the first term left out is below 1e-17 of the sum
  const double mean = 1 + (a + b + c) / 3;
  const double x = (1 + a - mean) / mean, y = (1 + b - mean) / mean, z = (1 + c - mean) / mean;
  const double e2 = x * y + y * z + z * x, e3 = x * y * z;
  std::array<double, 3> h{1, 0, -e2}; // h_k, h_(k+1), h_(k+2)
  double sum = 0;
  double sign = -1;
  for (int k = 0; k < most_terms; ++k) {
    sum += sign * h[0] / (k + 2);
    sign = -sign;
    h = {h[1], h[2], -e2 * h[1] + e3 * h[0]};
  }
  return 0.5 * sum / (mean * mean);
}

/// A vector of three: two of its numbers are one register.
struct SplitVector {
  Pair top;
  double bottom;
};

SplitVector column_of(const Matrix3d& matrix, int j) {
  const double* const column = matrix.data() + 3 * j;
  return {Pair{column[0], column[1]}, column[2]};
}

/// Nᵀ T N of a symmetric T.
Matrix3d turned(const Matrix3d& n, const Matrix3d& t) {
  const std::array<SplitVector, 3> of_t{column_of(t, 0), column_of(t, 1), column_of(t, 2)};
  const std::array<SplitVector, 3> of_n{column_of(n, 0), column_of(n, 1), column_of(n, 2)};
  Matrix3d out;
  unrolled<3>([&](auto j) {
    const double* const by = n.data() + 3 * j;
    const Pair top = of_t[0].top * by[0] + of_t[1].top * by[1] + of_t[2].top * by[2];
    const double bottom = of_t[0].bottom * by[0] + of_t[1].bottom * by[1] + of_t[2].bottom * by[2];
    unrolled<j + 1>([&](auto i) {
      out.data()[i + 3 * j] = out.data()[j + 3 * i] = sum_of(of_n[i].top * top) + of_n[i].bottom * bottom;
    });
  });
  return out;
}

/// Rᵀ X R of a symmetric X.
Tangent6 congruent(const Tangent6& r, const Tangent6& x) {
  Tangent6 out;
  for (int j = 0; j < 6; ++j) {
    std::array<Pair, 3> product{};
    for (int k = 0; k < 6; ++k)
      for (std::size_t p = 0; p < 3; ++p)
        product[p] += pair_at(x.data() + 6 * k + 2 * p) * r(k, j);
    for (int i = 0; i <= j; ++i) {
      const double* const column = r.data() + 6 * i;
      out(i, j) = out(j, i) = sum_of(pair_at(column) * product[0] + pair_at(column + 2) * product[1] +
                                     pair_at(column + 4) * product[2]);
    }
  }
  return out;
}

/// Rotation of engineering strains into the eigenbasis.
Tangent6 into_basis(const Matrix3d& n) {
  constexpr std::array<std::array<int, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Tangent6 rotation;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const auto [a, b] = pair[static_cast<std::size_t>(row)];
      const auto [i, j] = pair[static_cast<std::size_t>(column)];
      rotation(row, column) = (row < 3 ? 1 : 2) * n(i, a) * n(j, b);
      if (column >= 3)
        rotation(row, column) = (row < 3 ? 1 : 2) * 0.5 * (n(i, a) * n(j, b) + n(j, a) * n(i, b));
    }
  return rotation;
}

struct Entry {
  int row, column;
  double value;
};

/// What a unit of each Voigt component (engineering shears) puts into the tensor.
constexpr std::array<std::array<Entry, 2>, 6> entries{{{{{0, 0, 0.5}, {0, 0, 0.5}}},
                                                       {{{1, 1, 0.5}, {1, 1, 0.5}}},
                                                       {{{2, 2, 0.5}, {2, 2, 0.5}}},
                                                       {{{0, 1, 0.5}, {1, 0, 0.5}}},
                                                       {{{1, 2, 0.5}, {2, 1, 0.5}}},
                                                       {{{0, 2, 0.5}, {2, 0, 0.5}}}}};

/// Γ in the eigenbasis; `t`: T there.
Tangent6 curvature(const Vector3d& excess, const Matrix3d& t) {
  std::array<std::array<std::array<double, 3>, 3>, 3> weight; // T_ab e[λ_a,λ_c,λ_b] at a, c, b
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t b = 0; b <= a; ++b)
        weight[a][c][b] = weight[b][c][a] =
            t(static_cast<int>(a), static_cast<int>(b)) * second_difference(excess[static_cast<int>(a)],
                                                                            excess[static_cast<int>(c)],
                                                                            excess[static_cast<int>(b)]);
  Tangent6 gamma = Tangent6::Zero();
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column)
      for (const auto& first : entries[static_cast<std::size_t>(row)])
        for (const auto& second : entries[static_cast<std::size_t>(column)])
          if (first.column == second.row)
            gamma(row, column) +=
                2 * first.value * second.value *
                weight[static_cast<std::size_t>(first.row)][static_cast<std::size_t>(first.column)]
                      [static_cast<std::size_t>(second.column)];
  Tangent6 symmetric;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      symmetric(i, j) = 0.5 * (gamma(i, j) + gamma(j, i));
  return symmetric;
}

Matrix3d first_differences(const Vector3d& excess) {
  Matrix3d first;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b <= a; ++b)
      first(a, b) = first(b, a) = first_difference(excess[a], excess[b]);
  return first;
}

} // namespace

double first_difference(double a, double b) {
  if (are_close(a, b))
    return artanh_ratio((a - b) / (2 + a + b)) / (2 + a + b);
  return 0.5 * (std::log1p(a) - std::log1p(b)) / (a - b);
}

double second_difference(double a, double b, double c) {
  std::array<double, 3> x{a, b, c};
  std::ranges::sort(x);
  if (are_close(x[0], x[2]))
    return second_difference_of_close(a, b, c);
  return (first_difference(x[0], x[1]) - first_difference(x[1], x[2])) / (x[0] - x[2]);
}

Logarithm logarithm_of(const Matrix3d& c_less_one) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(c_less_one);
  Logarithm logarithm{solver.eigenvalues(), solver.eigenvectors(), {}};
  for (int a = 0; a < 3; ++a)
    logarithm.strains[a] = 0.5 * std::log1p(logarithm.excess[a]);
  return logarithm;
}

material::Strain6 strain_of(const Logarithm& logarithm) {
  Pair xx_yy{}, xz_yz{};
  double zz = 0, xy = 0;
  unrolled<3>([&](auto a) {
    const auto n = column_of(logarithm.axes, a);
    const double doubled = 2 * logarithm.strains.data()[a];
    const Pair scaled = n.top * doubled;
    const double scaled_bottom = n.bottom * doubled;
    xx_yy += n.top * scaled;
    xz_yz += n.top * scaled_bottom;
    zz += n.bottom * scaled_bottom;
    xy += n.top[0] * scaled[1];
  });
  material::Strain6 strain;
  strain << xx_yy[0] / 2, xx_yy[1] / 2, zz / 2, xy, xz_yz[1], xz_yz[0];
  return strain;
}

Matrix3d second_piola(const Logarithm& logarithm, const material::Stress6& t) {
  const Matrix3d& n = logarithm.axes;
  Matrix3d in_basis = turned(n, tensor_of(t));
  const Matrix3d first = first_differences(logarithm.excess);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      in_basis(i, j) *= 2 * first(i, j);
  Matrix3d back;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      back(i, j) = n(j, i);
  return turned(back, in_basis);
}

/// With R into the basis, B back and the differences 2 e[λ_a,λ_b] on a diagonal matrix Λ, L is B Λ R: the sum
/// is Rᵀ (Λ Bᵀ D B Λ + 4 Γ) R.
Tangent6 green_lagrange_tangent(const Logarithm& logarithm, const material::Response& response) {
  const Matrix3d& n = logarithm.axes;
  const Matrix3d first = first_differences(logarithm.excess);
  const std::array<double, 6> scale{2 * first(0, 0), 2 * first(1, 1), 2 * first(2, 2),
                                    2 * first(0, 1), 2 * first(1, 2), 2 * first(0, 2)};
  Tangent6 in_basis = congruent(into_basis(n.transpose()), response.tangent);
  const Tangent6 gamma = curvature(logarithm.excess, turned(n, tensor_of(response.stress)));
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      in_basis(i, j) =
          scale[static_cast<std::size_t>(i)] * scale[static_cast<std::size_t>(j)] * in_basis(i, j) +
          4 * gamma(i, j);
  return congruent(into_basis(n), in_basis);
}

} // namespace rubato::element
