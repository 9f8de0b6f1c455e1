// SPDX-License-Identifier: LGPL-3.0-or-later
/// Lines: Gauss–Legendre. Triangles: D. A. Dunavant, High degree efficient symmetrical Gaussian quadrature
/// rules for the triangle, Int. J. Numer. Methods Eng. 21 (1985) 1129–1148, degrees 1, 2, 4, 6, 8.
/// Tetrahedra: A. H. Stroud, Approximate Calculation of Multiple Integrals (1971), T3:1-1, T3:2-1 and T3:5-1
/// (15 points). Pyramids: conical products of Gauss–Legendre and Gauss–Jacobi rules (Stroud, ch. 2), the
/// latter by the eigenvalues of G. H. Golub and J. H. Welsch, Calculation of Gauss quadrature rules, Math.
/// Comp. 23 (1969) 221–230. All have positive weights and inner points.
#include "rubato/cell/rules.hpp"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

/// P_n(x) and its derivative by the three-term recurrence.
std::array<double, 2> legendre(int n, double x) {
  double before = 1, here = x;
  for (int k = 2; k <= n; ++k) {
    const double next = ((2 * k - 1) * x * here - (k - 1) * before) / k;
    before = here;
    here = next;
  }
  return {here, n * (x * here - before) / (x * x - 1)};
}

/// Points of `base` repeated along direction `axis`, which runs slowest.
Rule extruded(const Rule& base, const Rule& line, int axis) {
  Rule rule;
  rule.reserve(base.size() * line.size());
  for (const auto& level : line)
    for (auto point : base) {
      point.xi[axis] = level.xi[0];
      point.weight *= level.weight;
      rule.push_back(point);
    }
  return rule;
}

Rule triangle_six_points() {
  constexpr double a = 0.44594849091596488632, weight_a = 0.22338158967801146570 / 2;
  constexpr double b = 0.09157621350977074346, weight_b = 0.10995174365532186764 / 2;
  return {{Vector3d(b, b, 0), weight_b},         {Vector3d(1 - 2 * b, b, 0), weight_b},
          {Vector3d(b, 1 - 2 * b, 0), weight_b}, {Vector3d(a, 1 - 2 * a, 0), weight_a},
          {Vector3d(a, a, 0), weight_a},         {Vector3d(1 - 2 * a, a, 0), weight_a}};
}

/// The three points with area coordinates (p, p, 1 − 2p).
void add_mid_orbit(Rule& rule, double p, double weight) {
  for (const auto& xi : {Vector3d(p, p, 0), Vector3d(1 - 2 * p, p, 0), Vector3d(p, 1 - 2 * p, 0)})
    rule.push_back({xi, weight});
}

/// The six points with area coordinates (p, q, 1 − p − q).
void add_general_orbit(Rule& rule, double p, double q, double weight) {
  const double r = 1 - p - q;
  for (const auto& [x, y] : {std::array{p, q}, std::array{q, p}, std::array{p, r}, std::array{r, p},
                             std::array{q, r}, std::array{r, q}})
    rule.push_back({Vector3d(x, y, 0), weight});
}

Rule triangle_twelve_points() {
  constexpr double a = 0.24928674517091042129, weight_a = 0.11678627572637936603 / 2;
  constexpr double b = 0.06308901449150222834, weight_b = 0.05084490637020681692 / 2;
  constexpr double c = 0.05314504984481694735, d = 0.31035245103378440542,
                   weight_c = 0.08285107561837357519 / 2;
  Rule rule;
  for (const auto& [p, weight] : {std::array{a, weight_a}, std::array{b, weight_b}})
    add_mid_orbit(rule, p, weight);
  add_general_orbit(rule, c, d, weight_c);
  return rule;
}

Rule triangle_sixteen_points() {
  constexpr double a = 0.45929258829272315603, weight_a = 0.09509163426728462479 / 2;
  constexpr double b = 0.17056930775176020662, weight_b = 0.10321737053471825028 / 2;
  constexpr double c = 0.05054722831703097546, weight_c = 0.03245849762319808031 / 2;
  constexpr double d = 0.00839477740995760534, e = 0.26311282963463811342,
                   weight_d = 0.02723031417443499426 / 2;
  Rule rule{{Vector3d(1. / 3, 1. / 3, 0), 0.14431560767778716825 / 2}};
  for (const auto& [p, weight] : {std::array{a, weight_a}, std::array{b, weight_b}, std::array{c, weight_c}})
    add_mid_orbit(rule, p, weight);
  add_general_orbit(rule, d, e, weight_d);
  return rule;
}

/// The four points with volume coordinates (p, p, p, 1 − 3p).
void add_corner_orbit(Rule& rule, double p, double weight) {
  for (const auto& xi :
       {Vector3d(p, p, p), Vector3d(1 - 3 * p, p, p), Vector3d(p, 1 - 3 * p, p), Vector3d(p, p, 1 - 3 * p)})
    rule.push_back({xi, weight});
}

Rule tetrahedron_four_points() {
  Rule rule;
  add_corner_orbit(rule, (5 - std::sqrt(5.)) / 20, 1. / 24);
  return rule;
}

Rule tetrahedron_fifteen_points() {
  const double root = std::sqrt(15.);
  Rule rule{{Vector3d::Constant(0.25), 8. / 405}};
  add_corner_orbit(rule, (7 - root) / 34, (2665 + 14 * root) / 226800);
  add_corner_orbit(rule, (7 + root) / 34, (2665 - 14 * root) / 226800);
  const double c = (5 - root) / 20, d = (5 + root) / 20;
  for (const auto& xi : {Vector3d(c, c, d), Vector3d(c, d, c), Vector3d(d, c, c), Vector3d(d, d, c),
                         Vector3d(d, c, d), Vector3d(c, d, d)})
    rule.push_back({xi, 5. / 567});
  return rule;
}

/// Exact to degree 2n−3: two degrees are spent on the Jacobian of the collapsed cube.
Rule collapsed_tetrahedron_rule(int n) {
  Rule rule = cube_rule(n);
  for (auto& [xi, weight] : rule) {
    const double x = 0.5 * (1 + xi[0]);
    const double y = 0.5 * (1 - x) * (1 + xi[1]);
    weight *= 0.125 * (1 - x) * (1 - x - y);
    xi = {x, y, 0.5 * (1 - x - y) * (1 + xi[2])};
  }
  return rule;
}

/// n points on [0, 1] for integrals with the weight z², exact to degree 2n−1; z is xi[0].
Rule jacobi_rule(int n) {
  // Coefficients of the monic Jacobi polynomials with α = 0, β = 2 on [−1, 1].
  Eigen::VectorXd diagonal(n), below(n > 1 ? n - 1 : 0);
  for (int k = 0; k < n; ++k)
    diagonal[k] = 4. / ((2 * k + 2) * (2 * k + 4));
  for (int k = 1; k < n; ++k) {
    const double product = k * (k + 2.), sum = 2 * k + 2.;
    below[k - 1] = 2 * product / (sum * std::sqrt((sum + 1) * (sum - 1)));
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
  solver.computeFromTridiagonal(diagonal, below);
  Rule rule;
  for (int i = 0; i < n; ++i) {
    const double first = solver.eigenvectors()(0, i);
    rule.push_back({Vector3d(0.5 * (1 + solver.eigenvalues()[i]), 0, 0), first * first / 3});
  }
  return rule;
}

int line_points(int degree) {
  return degree / 2 + 1;
}

} // namespace

Rule line_rule(int n) {
  Rule rule(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = 2 * i + 1 == n ? 0. : -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    for (int iteration = 0; iteration < 10 && x != 0; ++iteration) {
      const auto [p, slope] = legendre(n, x);
      x -= p / slope;
    }
    const double slope = n == 1 ? 1. : legendre(n, x)[1];
    rule[static_cast<std::size_t>(i)] = {Vector3d(x, 0, 0), 2 / ((1 - x * x) * slope * slope)};
  }
  return rule;
}

Rule square_rule(int n) {
  return extruded(line_rule(n), line_rule(n), 1);
}

Rule cube_rule(int n) {
  return extruded(square_rule(n), line_rule(n), 2);
}

Rule collapsed_triangle_rule(int n) {
  Rule rule = square_rule(n);
  for (auto& [xi, weight] : rule) {
    const double x = 0.5 * (1 + xi[0]);
    weight *= 0.25 * (1 - x);
    xi = {x, 0.5 * (1 - x) * (1 + xi[1]), 0.};
  }
  return rule;
}

Rule triangle_of_degree(int degree) {
  if (degree <= 1)
    return {{Vector3d(1. / 3, 1. / 3, 0), 0.5}};
  if (degree == 2)
    return {{Vector3d(1. / 6, 1. / 6, 0), 1. / 6},
            {Vector3d(2. / 3, 1. / 6, 0), 1. / 6},
            {Vector3d(1. / 6, 2. / 3, 0), 1. / 6}};
  if (degree <= 4)
    return triangle_six_points();
  if (degree <= 6)
    return triangle_twelve_points();
  if (degree <= 8)
    return triangle_sixteen_points();
  return collapsed_triangle_rule(degree / 2 + 1 + degree % 2);
}

Rule triangle_rule(int n) {
  if (n < 1)
    throw std::invalid_argument("a Gauss rule needs at least one point in a triangle");
  return n <= 4 ? triangle_of_degree(n == 1 ? 1 : 2 * n - 2) : collapsed_triangle_rule(n);
}

Rule prism_rule(const Rule& triangle, int n) {
  return extruded(triangle, line_rule(n), 2);
}

Rule tetrahedron_of_degree(int degree) {
  if (degree <= 1)
    return {{Vector3d::Constant(0.25), 1. / 6}};
  if (degree == 2)
    return tetrahedron_four_points();
  if (degree <= 5)
    return tetrahedron_fifteen_points();
  return collapsed_tetrahedron_rule((degree + 4) / 2);
}

Rule segment_of_degree(int degree) {
  return line_rule(line_points(degree));
}

Rule quadrangle_of_degree(int degree) {
  return square_rule(line_points(degree));
}

Rule pyramid_of_degree(int degree) {
  const int n = line_points(degree);
  const auto square = square_rule(n);
  Rule rule;
  for (const auto& level : jacobi_rule(n))
    for (const auto& [xi, weight] : square) {
      const double s = level.xi[0];
      rule.push_back({Vector3d(s * xi[0], s * xi[1], 1 - s), weight * level.weight});
    }
  return rule;
}

Rule prism_of_degree(int degree) {
  return prism_rule(triangle_of_degree(degree), line_points(degree));
}

Rule hexahedron_of_degree(int degree) {
  return cube_rule(line_points(degree));
}

} // namespace rubato::cell
