// SPDX-License-Identifier: LGPL-3.0-or-later
/// Isotropic elasticity needs of a cell's shape only the Gram matrix of the physical gradients g_i,
///   A_ab(i,j) = ∫ ∂_a N_i ∂_b N_j,
/// one matrix product over all quadrature points; then
///   K_ab(i,j) = λ A_ab(i,j) + μ A_ba(i,j) + μ δ_ab Σ_c A_cc(i,j).
/// Axisymmetric cells add the hoop row N_i / r to the gradients: ε_zz = u_x / r. A tangent D that is not
/// isotropic needs no more: with B_i = Σ_r g_i^r L_r, L_r constant,
///   K(i,j) = Σ_rs A_rs(i,j) L_rᵀ D L_s.
#include "rubato/element/element.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/element/isotropic_stiffness.hpp"

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace rubato::element {
namespace {

using Eigen::Index;
using study::Physics;
using Points = std::span<const Eigen::Vector3d>;

constexpr Index most_points = 27;
constexpr Index most_nodes = 27;

[[noreturn]] void refuse(CellType type) {
  throw std::invalid_argument(std::string(cell::topology(type).name) + " is no bulk cell of this physics");
}

void check_dimension(CellType type, Physics physics) {
  if (cell::topology(type).dimension != component_count(physics))
    refuse(type);
}

/// Calls `work` with the dimension of the type, known at compile time.
template <class Work> void with_dimension(CellType type, const Work& work) {
  switch (cell::topology(type).dimension) {
  case 2:
    return work(std::integral_constant<int, 2>{});
  case 3:
    return work(std::integral_constant<int, 3>{});
  default:
    refuse(type);
  }
}

/// A vector of D components for each node.
template <int D> using Nodal = Eigen::Matrix<double, D, Eigen::Dynamic, Eigen::ColMajor, D, most_nodes>;
template <int D> using Square = Eigen::Matrix<double, D, D>;
/// One column a quadrature point.
template <int MostRows>
using Columns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, MostRows, most_points>;

template <int D> Nodal<D> coordinates(Points points) {
  Nodal<D> x(D, static_cast<Index>(points.size()));
  for (Index i = 0; i < x.cols(); ++i)
    x.col(i) = points[static_cast<std::size_t>(i)].template head<D>();
  return x;
}

template <int D> auto reference_gradients(const cell::ShapeTable& table, Index q) {
  return Eigen::Map<const Eigen::Matrix<double, D, Eigen::Dynamic>>(table.gradients.col(q).data(), D,
                                                                    table.values.rows());
}

template <int D> Square<D> jacobian(const Nodal<D>& x, const cell::ShapeTable& table, Index q) {
  const auto n_xi = reference_gradients<D>(table, q);
  Square<D> j = Square<D>::Zero();
  for (Index i = 0; i < x.cols(); ++i)
    j += x.col(i) * n_xi.col(i).transpose();
  return j;
}

template <int D> double radius(const Nodal<D>& x, const cell::ShapeTable& table, Index q) {
  return x.row(0).dot(table.values.col(q));
}

/// One quadrature point in space.
template <int D> struct PointInSpace {
  Square<D> inverse; ///< transposed inverse Jacobian: takes reference gradients to ∂N_i/∂x_a
  double jacobian;
  double radius; ///< x
};

template <int D> PointInSpace<D> point_in_space(const Nodal<D>& x, const cell::ShapeTable& table, Index q) {
  const auto j = jacobian<D>(x, table, q);
  return {j.inverse().transpose(), j.determinant(), radius<D>(x, table, q)};
}

/// The gradients of every point times the root of its volume; with Rows = D + 1 the hoop row N_i / r follows
/// those of each node.
template <int D, int Rows>
Columns<Rows * most_nodes> scaled_gradients(const cell::ShapeTable& table, Points points,
                                            const Section& section) {
  const auto x = coordinates<D>(points);
  Columns<Rows * most_nodes> scaled(Rows * x.cols(), table.weights.size());
  for (Index q = 0; q < table.weights.size(); ++q) {
    const auto at = point_in_space<D>(x, table, q);
    const auto n_xi = reference_gradients<D>(table, q);
    const double root = std::sqrt(table.weights[q] * at.jacobian * measure(section, at.radius));
    const Square<D> to_space = root * at.inverse;
    Eigen::Map<Eigen::Matrix<double, Rows, Eigen::Dynamic>> column(scaled.col(q).data(), Rows, x.cols());
    for (Index i = 0; i < x.cols(); ++i)
      column.col(i).template head<D>() = to_space * n_xi.col(i);
    if constexpr (Rows > D)
      column.row(D) = root / at.radius * table.values.col(q).transpose();
  }
  return scaled;
}

/// K_ab(i,j) from A_ab(i,j), both for one pair of nodes, of an isotropic law.
template <int D, int Rows> struct IsotropicBlock {
  material::Lame lame;

  Square<D> operator()(const Square<Rows>& a) const {
    const Square<D> plane = a.template topLeftCorner<D, D>();
    Square<D> block = lame.lambda * plane + lame.mu * plane.transpose();
    block.diagonal().array() += lame.mu * plane.trace();
    if constexpr (Rows > D) {
      block.row(0) += lame.lambda * a.row(D).template head<D>();
      block.col(0) += lame.lambda * a.col(D).template head<D>();
      block(0, 0) += (lame.lambda + 2 * lame.mu) * a(D, D);
    }
    return block;
  }
};

/// L_r: what the r-th gradient of a shape function gives to the strains of its node's displacements.
template <int D, int Rows> Eigen::Matrix<double, Eigen::Dynamic, D, 0, 6, D> strain_of_gradient(int r) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, D, 0, 6, D>;
  if constexpr (D == 3) {
    Matrix l = Matrix::Zero(6, 3);
    l(r, r) = 1;
    constexpr std::array<std::array<int, 2>, 3> shears{{{0, 1}, {1, 2}, {0, 2}}};
    for (int s = 0; s < 3; ++s)
      for (int end = 0; end < 2; ++end)
        if (shears[s][end] == r)
          l(3 + s, shears[s][1 - end]) = 1;
    return l;
  } else {
    Matrix l = Matrix::Zero(Rows + 1, 2); // xx yy xy, or xx yy zz xy
    if (r == D) {
      l(2, 0) = 1;
    } else {
      l(r, r) = 1;
      l(Rows, 1 - r) = 1;
    }
    return l;
  }
}

/// The same of any symmetric tangent.
template <int D, int Rows> struct GeneralBlock {
  std::array<Square<D>, static_cast<std::size_t>(Rows* Rows)> terms; ///< L_rᵀ D L_s at r + Rows s

  explicit GeneralBlock(const material::Tangent& tangent) {
    for (int s = 0; s < Rows; ++s)
      for (int r = 0; r < Rows; ++r)
        terms[static_cast<std::size_t>(r + Rows * s)] =
            strain_of_gradient<D, Rows>(r).transpose() * tangent * strain_of_gradient<D, Rows>(s);
  }

  Square<D> operator()(const Square<Rows>& a) const {
    Square<D> block = Square<D>::Zero();
    for (int s = 0; s < Rows; ++s)
      for (int r = 0; r < Rows; ++r)
        block += a(r, s) * terms[static_cast<std::size_t>(r + Rows * s)];
    return block;
  }
};

template <int D, int Rows, class Block>
void stiffness_of(const cell::ShapeTable& table, Points points, const Block& block_of, const Section& section,
                  Eigen::Ref<Eigen::MatrixXd> k) {
  const auto scaled = scaled_gradients<D, Rows>(table, points, section);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Rows * most_nodes, Rows * most_nodes>
      gram(scaled.rows(), scaled.rows());
  gram.noalias() = scaled * scaled.transpose();
  const auto nodes = static_cast<Index>(points.size());
  for (Index j = 0; j < nodes; ++j)
    for (Index i = 0; i <= j; ++i) {
      const Square<D> block = block_of(gram.template block<Rows, Rows>(Rows * i, Rows * j));
      k.block<D, D>(D * i, D * j) = block;
      k.block<D, D>(D * j, D * i) = block.transpose();
    }
}

/// Calls `work` with the components and the rows of gradients of the physics, known at compile time.
template <class Work> void with_rows(CellType type, Physics physics, const Work& work) {
  with_dimension(type, [&]<int D>(std::integral_constant<int, D> dimension) {
    if constexpr (D == 2)
      if (physics == Physics::axisymmetric)
        return work(dimension, std::integral_constant<int, 3>{});
    work(dimension, dimension);
  });
}

/// B of one point times the root of its volume, from the scaled gradients of that point.
template <int D, int Rows, class Column> auto strain_matrix(const Column& gradients, Index nodes) {
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, D * most_nodes> b;
  b.setZero(D == 3 ? 6 : Rows + 1, D * nodes);
  for (int r = 0; r < Rows; ++r) {
    const auto of_gradient = strain_of_gradient<D, Rows>(r);
    for (Index i = 0; i < nodes; ++i)
      b.template middleCols<D>(D * i) += gradients[Rows * i + r] * of_gradient;
  }
  return b;
}

template <int D, int Rows>
void varying_stiffness_of(const cell::ShapeTable& table, Points points,
                          std::span<const material::Tangent> tangents, const Section& section,
                          Eigen::Ref<Eigen::MatrixXd> k) {
  const auto scaled = scaled_gradients<D, Rows>(table, points, section);
  k.setZero();
  for (Index q = 0; q < scaled.cols(); ++q) {
    const auto b = strain_matrix<D, Rows>(scaled.col(q), static_cast<Index>(points.size()));
    k.noalias() += b.transpose() * (tangents[static_cast<std::size_t>(q)] * b).eval();
  }
  k.template triangularView<Eigen::StrictlyLower>() = k.transpose().eval();
}

template <int D, class Density>
void mass_of(const cell::ShapeTable& table, Points points, const Density& density_at, const Section& section,
             Eigen::Ref<Eigen::MatrixXd> m) {
  const auto x = coordinates<D>(points);
  Columns<most_nodes> scaled(x.cols(), table.weights.size());
  for (Index q = 0; q < table.weights.size(); ++q) {
    const double volume =
        table.weights[q] * jacobian<D>(x, table, q).determinant() * measure(section, radius<D>(x, table, q));
    scaled.col(q) = std::sqrt(density_at(q) * volume) * table.values.col(q);
  }
  m.noalias() = scaled * scaled.transpose();
}

/// Small-strain Voigt vector from the displacement gradient h_ab = ∂u_a/∂x_b (and u_x / r).
material::Voigt voigt(const Eigen::Matrix3d& h) {
  material::Voigt strain(6);
  strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
  return strain;
}

material::Voigt voigt(const Eigen::Matrix2d& h, double hoop, Physics physics) {
  material::Voigt strain(material::strain_size(physics));
  if (physics == Physics::axisymmetric)
    strain << h(0, 0), h(1, 1), hoop, h(0, 1) + h(1, 0);
  else
    strain << h(0, 0), h(1, 1), h(0, 1) + h(1, 0);
  return strain;
}

template <int D>
void strains_of(const cell::ShapeTable& table, Points points, Physics physics,
                std::span<const double> displacement, Eigen::Ref<Eigen::MatrixXd> strain) {
  const auto x = coordinates<D>(points);
  const Eigen::Map<const Eigen::Matrix<double, D, Eigen::Dynamic>> u(displacement.data(), D, x.cols());
  for (Index q = 0; q < table.weights.size(); ++q) {
    const auto at = point_in_space<D>(x, table, q);
    const auto n_xi = reference_gradients<D>(table, q);
    Square<D> h = Square<D>::Zero();
    for (Index i = 0; i < x.cols(); ++i)
      h += u.col(i) * (at.inverse * n_xi.col(i)).transpose();
    if constexpr (D == 3)
      strain.col(q) = voigt(h);
    else
      strain.col(q) = voigt(h, u.row(0).dot(table.values.col(q)) / at.radius, physics);
  }
}

template <int D, int Rows>
void stress_forces_of(const cell::ShapeTable& table, Points points, const Section& section,
                      const Eigen::MatrixXd& stress, Eigen::Ref<Eigen::MatrixXd> g) {
  const auto x = coordinates<D>(points);
  const auto scaled = scaled_gradients<D, Rows>(table, points, section);
  g.setZero();
  for (Index q = 0; q < table.weights.size(); ++q) {
    const auto at = point_in_space<D>(x, table, q);
    const double root = std::sqrt(table.weights[q] * at.jacobian * measure(section, at.radius));
    Eigen::Matrix<double, D, Rows> by_gradient;
    for (int r = 0; r < Rows; ++r)
      by_gradient.col(r) = root * strain_of_gradient<D, Rows>(r).transpose() * stress.col(q);
    for (Index i = 0; i < x.cols(); ++i)
      g.block(D * i, 0, D, x.cols()) +=
          by_gradient * scaled.col(q).template segment<Rows>(Rows * i) * table.values.col(q).transpose();
  }
}

template <int D> double worst_jacobian_of(const cell::ShapeTable& table, Points points) {
  const auto x = coordinates<D>(points);
  double worst = std::numeric_limits<double>::infinity();
  for (Index q = 0; q < table.weights.size(); ++q)
    if (const double here = jacobian<D>(x, table, q).determinant(); !(here >= worst))
      worst = here;
  return worst;
}

/// Diagonal of the consistent mass scaled to the cell's mass.
void scale_diagonal(const Eigen::MatrixXd& consistent, Eigen::Ref<Eigen::VectorXd> m) {
  m = consistent.diagonal() * (consistent.sum() / consistent.trace());
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
  if (isotropic_stiffness(type, points, *lame, section, k))
    return;
  with_rows(type, section.physics,
            [&]<int D, int Rows>(std::integral_constant<int, D>, std::integral_constant<int, Rows>) {
              stiffness_of<D, Rows>(cell::stiffness_table(type), points, IsotropicBlock<D, Rows>{*lame},
                                    section, k);
            });
}

void stiffness(CellType type, Points points, const material::Tangent& tangent, const Section& section,
               Eigen::Ref<Eigen::MatrixXd> k) {
  check_dimension(type, section.physics);
  with_rows(type, section.physics,
            [&]<int D, int Rows>(std::integral_constant<int, D>, std::integral_constant<int, Rows>) {
              stiffness_of<D, Rows>(cell::stiffness_table(type), points, GeneralBlock<D, Rows>(tangent),
                                    section, k);
            });
}

void varying_stiffness(CellType type, Points points, std::span<const material::Tangent> tangents,
                       const Section& section, Eigen::Ref<Eigen::MatrixXd> k) {
  check_dimension(type, section.physics);
  with_rows(type, section.physics,
            [&]<int D, int Rows>(std::integral_constant<int, D>, std::integral_constant<int, Rows>) {
              varying_stiffness_of<D, Rows>(cell::stiffness_table(type), points, tangents, section, k);
            });
}

namespace {

template <class Density>
void mass_with(CellType type, Points points, const Density& density_at, const Section& section,
               Eigen::Ref<Eigen::MatrixXd> m) {
  check_dimension(type, section.physics);
  const auto& table = cell::mass_table(type);
  with_dimension(type, [&]<int D>(std::integral_constant<int, D>) {
    mass_of<D>(table, points, density_at, section, m);
  });
}

/// Sums of rows where they cannot be negative.
void lump(CellType type, const Eigen::MatrixXd& consistent, Eigen::Ref<Eigen::VectorXd> m) {
  if (cell::topology(type).order == 1)
    m = consistent.rowwise().sum();
  else
    scale_diagonal(consistent, m);
}

} // namespace

void mass(CellType type, Points points, double density, const Section& section,
          Eigen::Ref<Eigen::MatrixXd> m) {
  mass_with(
      type, points, [density](Index) { return density; }, section, m);
}

void varying_mass(CellType type, Points points, std::span<const double> densities, const Section& section,
                  Eigen::Ref<Eigen::MatrixXd> m) {
  mass_with(
      type, points, [densities](Index q) { return densities[static_cast<std::size_t>(q)]; }, section, m);
}

Eigen::Matrix3Xd places(const cell::ShapeTable& table, Points points) {
  Eigen::Matrix3Xd x(3, table.values.rows());
  for (Index i = 0; i < x.cols(); ++i)
    x.col(i) = points[static_cast<std::size_t>(i)];
  return x * table.values;
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
  const auto& table = cell::stiffness_table(type);
  with_dimension(type, [&]<int D>(std::integral_constant<int, D>) {
    strains_of<D>(table, points, physics, displacement, strain);
  });
}

void stress_forces(CellType type, Points points, const Section& section, const Eigen::MatrixXd& stress,
                   Eigen::Ref<Eigen::MatrixXd> g) {
  check_dimension(type, section.physics);
  with_rows(type, section.physics,
            [&]<int D, int Rows>(std::integral_constant<int, D>, std::integral_constant<int, Rows>) {
              stress_forces_of<D, Rows>(cell::stiffness_table(type), points, section, stress, g);
            });
}

void point_volumes(CellType type, Points points, const Section& section, Eigen::Ref<Eigen::VectorXd> volume) {
  check_dimension(type, section.physics);
  const auto& table = cell::stiffness_table(type);
  with_dimension(type, [&]<int D>(std::integral_constant<int, D>) {
    const auto x = coordinates<D>(points);
    for (Index q = 0; q < table.weights.size(); ++q)
      volume[q] = table.weights[q] * jacobian<D>(x, table, q).determinant() *
                  measure(section, radius<D>(x, table, q));
  });
}

double worst_jacobian(CellType type, Points points) {
  double worst = 0;
  with_dimension(type, [&]<int D>(std::integral_constant<int, D>) {
    const double in_stiffness = worst_jacobian_of<D>(cell::stiffness_table(type), points);
    const double in_mass = worst_jacobian_of<D>(cell::mass_table(type), points);
    worst = in_mass < in_stiffness ? in_mass : in_stiffness;
  });
  return worst;
}

} // namespace rubato::element
