// SPDX-License-Identifier: LGPL-3.0-or-later
/// ∂N_i/∂X at every point of a cell, nodes next to each other in memory, and the sums over nodes and points
/// that are made with them. The sums are compiled for the cells that most meshes are made of with their
/// number of nodes, and once for all other cells.
///
/// d components a node and `rows` gradients: axisymmetric cells have a third one, N_i/R, which gives the hoop
/// strain to the first component. Cells of one point have there the means of the gradients over their volume.
/// Gradients of the cell's own modes of displacement follow those of the nodes.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/reference_gradients.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

constexpr int most_nodes_of_cell = 27;
constexpr int most_points_of_cell = 27;
constexpr int most_stride = even(most_nodes_of_cell);

/// Index in a standard array.
constexpr std::size_t place(int i) {
  return static_cast<std::size_t>(i);
}

constexpr PointRule rule_of(Formulation formulation) {
  switch (formulation) {
  case Formulation::reduced:
    return PointRule::one;
  case Formulation::lower_order:
    return PointRule::lower_order;
  default:
    return PointRule::stiffness;
  }
}

template <class T> using AtPoints = std::array<T, static_cast<std::size_t>(most_points_of_cell)>;

/// Where component a of gradient row I is in a tensor of the point: at a + 3 I, −1 where nowhere (the axial
/// displacement has no hoop strain).
constexpr int tensor_place(int a, int row, int d) {
  if (row < d)
    return a + 3 * row;
  return a == 0 ? 8 : -1;
}

/// Modes of displacement that a cell may have: one for each direction in QUAD4 and HEXA8, the bubble of
/// QUAD8, PENTA15 and HEXA20.
constexpr int modes_of(int nodes, int d) {
  if (nodes == 1 << d)
    return d;
  return nodes == (d == 2 ? 8 : 20) ? 1 : 0;
}

/// Nodes, modes, and what makes their number even.
constexpr int stride_of(int nodes, int d) {
  return even(nodes + modes_of(nodes, d));
}

/// Numbers of the nodes, component a of node i at a · stride + i with the stride of the gradients.
struct NodalValues {
  alignas(16) std::array<double, static_cast<std::size_t>(3 * most_stride)> values;

  double* component(int a, int stride) { return values.data() + a * stride; }
  const double* component(int a, int stride) const { return values.data() + a * stride; }
};

class CellGradients {
public:
  /// On the undeformed shape.
  CellGradients(CellType type, std::span<const Eigen::Vector3d> points, const Section& section,
                PointRule rule);

  int components() const { return d_; }
  int rows() const { return rows_; }
  int nodes() const { return nodes_; }
  int points() const { return points_; }
  int dofs() const { return nodes_ * d_; }
  /// Distance of the rows of a point, even.
  int stride() const { return stride_; }

  /// Volume of a point, measure included.
  double weight(int q) const { return weight_[static_cast<std::size_t>(q)]; }
  /// Axisymmetric cells only.
  double radius(int q) const { return radius_[static_cast<std::size_t>(q)]; }
  /// det ∂X/∂ξ.
  double jacobian(int q) const { return jacobian_[static_cast<std::size_t>(q)]; }

  /// Gradients of all nodes, then of the modes; the address is a multiple of 16.
  const double* row(int q, int row) const { return values_.data() + (q * rows_ + row) * stride_; }
  double* row(int q, int row) { return values_.data() + (q * rows_ + row) * stride_; }
  double at(int q, int of_row, int i) const { return row(q, of_row)[i]; }

  /// From dof numbered node · d + component.
  NodalValues by_component(std::span<const double> values) const;
  NodalValues no_force() const;

  /// ∂u/∂X at all points.
  void set_displacement_gradients(const NodalValues& u, std::span<Eigen::Matrix3d> gradients) const;
  /// `sum` += Σ weight · tensor_aI ∂N_i/∂X_I of all points.
  void add_forces(std::span<const Eigen::Matrix3d> tensors, NodalValues& sum) const;
  /// The same of one point.
  void add_force(int q, const Eigen::Matrix3d& tensor, NodalValues& sum) const;
  /// Into dof numbered node · d + component. Returns the sum of all.
  double put(const NodalValues& nodal, std::span<double> values) const;

private:
  void set_means(CellType type, std::span<const Eigen::Vector3d> points, const Section& section);
  template <class Sizes> void set_points(const ReferenceGradients& reference, const Section& section);
  template <class Sizes> void set_gradients_of(const double* u, std::span<Eigen::Matrix3d> gradients) const;
  template <class Sizes> void add_force_to(int q, const double* tensor, double* sum) const;

  int d_, rows_, nodes_, points_, stride_;
  NodalValues coordinates_;
  alignas(16) std::array<double, static_cast<std::size_t>(most_points_of_cell * 3 * most_stride)> values_;
  AtPoints<double> weight_, radius_, jacobian_;
};

} // namespace rubato::element
