// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/logarithm.hpp"

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
  return 0.5 * (gamma + gamma.transpose());
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
  return {solver.eigenvalues(), solver.eigenvectors(),
          solver.eigenvalues().unaryExpr([](double mu) { return 0.5 * std::log1p(mu); })};
}

material::Strain6 strain_of(const Logarithm& logarithm) {
  return half_strain_of(logarithm.axes * (2 * logarithm.strains).asDiagonal() * logarithm.axes.transpose());
}

Matrix3d second_piola(const Logarithm& logarithm, const material::Stress6& t) {
  const Matrix3d& n = logarithm.axes;
  const Matrix3d in_basis = n.transpose() * tensor_of(t) * n;
  return n * (2 * first_differences(logarithm.excess).cwiseProduct(in_basis)) * n.transpose();
}

Tangent6 green_lagrange_tangent(const Logarithm& logarithm, const material::Response& response) {
  const Matrix3d& n = logarithm.axes;
  const Tangent6 rotation = into_basis(n);
  const Tangent6 back = into_basis(n.transpose());
  const Matrix3d first = first_differences(logarithm.excess);
  material::Strain6 scale;
  scale << first(0, 0), first(1, 1), first(2, 2), first(0, 1), first(1, 2), first(0, 2);
  const Tangent6 map = back * (2 * scale).asDiagonal() * rotation;
  const Tangent6 gamma = curvature(logarithm.excess, n.transpose() * tensor_of(response.stress) * n);
  return map.transpose() * response.tangent * map + 4 * rotation.transpose() * gamma * rotation;
}

} // namespace rubato::element
