// SPDX-License-Identifier: LGPL-3.0-or-later
/// Isotropic elasticity needs of a cell's shape only the Gram matrix of the physical gradients g_i,
///   A_ab(i,j) = ∫ ∂_a N_i ∂_b N_j,
/// then
///   K_ab(i,j) = λ A_ab(i,j) + μ A_ba(i,j) + μ δ_ab Σ_c A_cc(i,j).
/// Axisymmetric cells add the hoop row N_i / r to the gradients: ε_zz = u_x / r. A tangent D that is not
/// isotropic is that of a nonlinear cell in small strain (nonlinear/block_sums.hpp).
#include "rubato/element/element.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/element/isotropic_stiffness.hpp"
#include "rubato/element/nonlinear/block_sums.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace rubato::element {
namespace {

using Eigen::Index;
using study::Physics;
using Points = std::span<const Eigen::Vector3d>;

[[noreturn]] void refuse(CellType type) {
  throw std::invalid_argument(std::string(cell::topology(type).name) + " is no bulk cell of this physics");
}

void check_dimension(CellType type, Physics physics) {
  if (cell::topology(type).dimension != component_count(physics))
    refuse(type);
}

/// Of a cell that is checked.
CellGradients gradients_of(CellType type, Points points, const Section& section) {
  return {type, points, section, PointRule::stiffness};
}

/// Where components of the physics are among all six.
std::span<const int> voigt_places(Physics physics) {
  static constexpr std::array solid{0, 1, 2, 3, 4, 5};
  static constexpr std::array axisymmetric{0, 1, 2, 3};
  static constexpr std::array plane{0, 1, 3};
  switch (physics) {
  case Physics::solid:
    return solid;
  case Physics::axisymmetric:
    return axisymmetric;
  default:
    return plane;
  }
}

/// `tangent` with all six components, times `factor`; what the physics leaves out is 0.
void put_whole(const material::Tangent& tangent, double factor, std::span<const int> places,
               material::Tangent6& whole) {
  whole.setZero();
  for (std::size_t j = 0; j < places.size(); ++j)
    for (std::size_t i = 0; i < places.size(); ++i)
      whole(places[i], places[j]) = factor * tangent(static_cast<Index>(i), static_cast<Index>(j));
}

/// `tangent_at`: D of a point.
template <class TangentAt>
void put_stiffness(CellType type, Points points, const TangentAt& tangent_at, const Section& section,
                   Eigen::Ref<Eigen::MatrixXd> k) {
  check_dimension(type, section.physics);
  const auto gradients = gradients_of(type, points, section);
  const auto places = voigt_places(section.physics);
  AtPoints<material::Tangent6> moduli;
  const auto of_points = std::span(moduli).first(static_cast<std::size_t>(gradients.points()));
  for (std::size_t q = 0; q < of_points.size(); ++q)
    put_whole(tangent_at(q), gradients.weight(static_cast<int>(q)), places, of_points[q]);
  put_block_sums(gradients, of_points, 0, gradients.nodes(), {k.data(), static_cast<int>(k.outerStride())});
}

/// det ∂x/∂ξ at a point of a table.
template <int d> double jacobian(const cell::ShapeTable& table, Points points, Index q) {
  const double* const gradients = table.gradients.col(q).data();
  std::array<double, static_cast<std::size_t>(d * d)> j{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double* const x = points[i].data();
    unrolled<d * d>([&](auto m) { j[m] += x[m % d] * gradients[static_cast<int>(i) * d + m / d]; });
  }
  if constexpr (d == 2)
    return j[0] * j[3] - j[2] * j[1];
  else
    return j[0] * (j[4] * j[8] - j[7] * j[5]) - j[3] * (j[1] * j[8] - j[7] * j[2]) +
           j[6] * (j[1] * j[5] - j[4] * j[2]);
}

double jacobian(const cell::ShapeTable& table, Points points, Index q, int dimension) {
  return dimension == 3 ? jacobian<3>(table, points, q) : jacobian<2>(table, points, q);
}

double radius(const cell::ShapeTable& table, Points points, Index q) {
  double radius = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    radius += points[i][0] * table.values(static_cast<Index>(i), q);
  return radius;
}

/// `density_at`: that of a point.
template <class DensityAt>
void put_mass(CellType type, Points points, const DensityAt& density_at, const Section& section,
              Eigen::Ref<Eigen::MatrixXd> m) {
  check_dimension(type, section.physics);
  const auto& table = cell::mass_table(type);
  const int dimension = cell::topology(type).dimension;
  const auto nodes = points.size();
  constexpr std::size_t most_pairs = most_stride / 2;
  const auto pairs = static_cast<std::size_t>(even(static_cast<int>(nodes))) / 2;
  std::array<std::array<Pair, most_pairs>, most_nodes_of_cell> sums;
  for (std::size_t j = 0; j < nodes; ++j)
    std::fill_n(sums[j].begin(), pairs, Pair{});
  std::array<Pair, most_pairs> scaled;
  for (Index q = 0; q < table.weights.size(); ++q) {
    double volume = table.weights[q] * jacobian(table, points, q, dimension);
    if (dimension == 2)
      volume *= measure(section, radius(table, points, q));
    const double root = std::sqrt(density_at(q) * volume);
    const double* const n = table.values.col(q).data();
    for (std::size_t p = 0; p < pairs; ++p)
      scaled[p] = root * Pair{n[2 * p], 2 * p + 1 < nodes ? n[2 * p + 1] : 0};
    for (std::size_t j = 0; j < nodes; ++j)
      for (std::size_t p = 0; p < pairs; ++p)
        sums[j][p] += scaled[p] * scaled[j / 2][j % 2];
  }
  for (std::size_t j = 0; j < nodes; ++j)
    for (std::size_t i = 0; i < nodes; ++i)
      m(static_cast<Index>(i), static_cast<Index>(j)) = sums[j][i / 2][i % 2];
}

/// The smallest at the points of a table.
double worst_jacobian_of(const cell::ShapeTable& table, Points points, int dimension) {
  double worst = std::numeric_limits<double>::infinity();
  for (Index q = 0; q < table.weights.size(); ++q)
    if (const double here = jacobian(table, points, q, dimension); !(here >= worst))
      worst = here;
  return worst;
}

/// Lumped masses: sums of rows where they cannot be negative, else the diagonal scaled to the cell's mass.
void lump(CellType type, const Eigen::MatrixXd& consistent, Eigen::Ref<Eigen::VectorXd> m) {
  double whole = 0, trace = 0;
  for (Index j = 0; j < m.size(); ++j) {
    m[j] = 0;
    for (Index i = 0; i < m.size(); ++i)
      m[j] += consistent(i, j);
    whole += m[j];
    trace += consistent(j, j);
  }
  if (cell::topology(type).order == 1)
    return;
  for (Index j = 0; j < m.size(); ++j)
    m[j] = consistent(j, j) * (whole / trace);
}

} // namespace

int component_count(Physics physics) {
  return physics == Physics::solid ? 3 : 2;
}

double measure(const Section& section, double x) {
  switch (section.physics) {
  case Physics::solid:
    return 1;
  case Physics::axisymmetric:
    return 2 * std::numbers::pi * x;
  default:
    return section.thickness;
  }
}

void stiffness(CellType type, Points points, const material::Law& law, const Section& section,
               Eigen::Ref<Eigen::MatrixXd> k) {
  const auto lame = material::isotropic(law, section.physics);
  if (!lame)
    return stiffness(type, points, material::tangent(law, section.physics), section, k);
  check_dimension(type, section.physics);
  isotropic_stiffness(type, points, *lame, section, k);
}

void stiffness(CellType type, Points points, const material::Tangent& tangent, const Section& section,
               Eigen::Ref<Eigen::MatrixXd> k) {
  put_stiffness(
      type, points, [&](std::size_t) -> const material::Tangent& { return tangent; }, section, k);
}

void varying_stiffness(CellType type, Points points, std::span<const material::Tangent> tangents,
                       const Section& section, Eigen::Ref<Eigen::MatrixXd> k) {
  put_stiffness(
      type, points, [&](std::size_t q) -> const material::Tangent& { return tangents[q]; }, section, k);
}

void mass(CellType type, Points points, double density, const Section& section,
          Eigen::Ref<Eigen::MatrixXd> m) {
  put_mass(
      type, points, [density](Index) { return density; }, section, m);
}

void varying_mass(CellType type, Points points, std::span<const double> densities, const Section& section,
                  Eigen::Ref<Eigen::MatrixXd> m) {
  put_mass(
      type, points, [densities](Index q) { return densities[static_cast<std::size_t>(q)]; }, section, m);
}

Eigen::Matrix3Xd places(const cell::ShapeTable& table, Points points) {
  Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, table.values.cols());
  for (Index q = 0; q < x.cols(); ++q)
    for (Index i = 0; i < table.values.rows(); ++i)
      for (int a = 0; a < 3; ++a)
        x(a, q) += points[static_cast<std::size_t>(i)][a] * table.values(i, q);
  return x;
}

void lumped_mass(CellType type, Points points, double density, const Section& section,
                 Eigen::Ref<Eigen::VectorXd> m) {
  Eigen::MatrixXd consistent(m.size(), m.size());
  mass(type, points, density, section, consistent);
  lump(type, consistent, m);
}

void varying_lumped_mass(CellType type, Points points, std::span<const double> densities,
                         const Section& section, Eigen::Ref<Eigen::VectorXd> m) {
  Eigen::MatrixXd consistent(m.size(), m.size());
  varying_mass(type, points, densities, section, consistent);
  lump(type, consistent, m);
}

void strains(CellType type, Points points, Physics physics, std::span<const double> displacement,
             Eigen::Ref<Eigen::MatrixXd> strain) {
  check_dimension(type, physics);
  const auto gradients = gradients_of(type, points, {physics, 1});
  AtPoints<Eigen::Matrix3d> h;
  gradients.set_displacement_gradients(gradients.by_component(displacement), h);
  const auto places_of_physics = voigt_places(physics);
  for (int q = 0; q < gradients.points(); ++q) {
    const auto& at = h[static_cast<std::size_t>(q)];
    const std::array all{at(0, 0),           at(1, 1), at(2, 2), at(0, 1) + at(1, 0), at(1, 2) + at(2, 1),
                         at(0, 2) + at(2, 0)};
    for (std::size_t i = 0; i < places_of_physics.size(); ++i)
      strain(static_cast<Index>(i), q) = all[static_cast<std::size_t>(places_of_physics[i])];
  }
}

void stress_forces(CellType type, Points points, const Section& section, const Eigen::MatrixXd& stress,
                   Eigen::Ref<Eigen::MatrixXd> g) {
  check_dimension(type, section.physics);
  const auto gradients = gradients_of(type, points, section);
  const auto& values = cell::stiffness_table(type).values;
  const auto places_of_physics = voigt_places(section.physics);
  g.setZero();
  for (int q = 0; q < gradients.points(); ++q) {
    material::Stress6 all = material::Stress6::Zero();
    for (std::size_t i = 0; i < places_of_physics.size(); ++i)
      all[places_of_physics[i]] = stress(static_cast<Index>(i), q);
    std::array<double, static_cast<std::size_t>(3 * most_nodes_of_cell)> force;
    auto nodal = gradients.no_force();
    gradients.add_force(q, tensor_of(all), nodal);
    gradients.put(nodal, force);
    for (int j = 0; j < gradients.nodes(); ++j)
      for (int i = 0; i < gradients.dofs(); ++i)
        g(i, j) += force[static_cast<std::size_t>(i)] * values(j, q);
  }
}

void point_volumes(CellType type, Points points, const Section& section, Eigen::Ref<Eigen::VectorXd> volume) {
  check_dimension(type, section.physics);
  const auto gradients = gradients_of(type, points, section);
  for (int q = 0; q < gradients.points(); ++q)
    volume[q] = gradients.weight(q);
}

double worst_jacobian(CellType type, Points points) {
  const int dimension = cell::topology(type).dimension;
  if (dimension < 2)
    refuse(type);
  const double in_stiffness = worst_jacobian_of(cell::stiffness_table(type), points, dimension);
  const double in_mass = worst_jacobian_of(cell::mass_table(type), points, dimension);
  return in_mass < in_stiffness ? in_mass : in_stiffness;
}

} // namespace rubato::element
