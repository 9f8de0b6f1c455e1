// SPDX-License-Identifier: LGPL-3.0-or-later
/// ∂N_i/∂X at every point of a cell, nodes next to each other in memory, and the sums over nodes and points
/// that are made with them. Sizes are known at compile time for the cells that most meshes are made of.
///
/// D components a node and Rows gradients: axisymmetric cells have a third one, N_i/R, which gives the hoop
/// strain to the first component. Cells of one point have there the means of the gradients over their volume.
#pragma once

#include "rubato/element/nonlinear/kinematics.hpp"
#include "rubato/element/nonlinear/mean_gradients.hpp"
#include "rubato/element/nonlinear/reference_gradients.hpp"

#include <Eigen/LU>

#include <array>
#include <cstddef>

namespace rubato::element {

/// N nodes and Q points, or Eigen::Dynamic both.
template <int Components, int GradientRows, int N, int Q> struct Shape {
  static constexpr int d = Components;
  static constexpr int rows = GradientRows;
  static constexpr int nodes = N;
  static constexpr bool is_fixed = N != Eigen::Dynamic;
  static constexpr int most_nodes = is_fixed ? N : 27;
  static constexpr int most_points = is_fixed ? Q : 27;
  /// QUAD4 and HEXA8 with one point.
  static constexpr bool is_reduced = is_fixed && Q == 1 && N == (1 << d);
  /// QUAD4 and HEXA8 may have a mode of their own for each direction, behind the nodes.
  static constexpr bool may_be_enhanced = N == (1 << d) && !is_reduced;
  /// Those, and PENTA6 among the cells of any size.
  static constexpr bool may_average = is_fixed ? may_be_enhanced : d == 3;
  static constexpr int stride = even(most_nodes + (may_be_enhanced ? d : 0));

  using Gradient = Eigen::Matrix<double, d, rows>; ///< ∂u_a/∂X_I, the hoop at (0, 2)
  using Nodal = Eigen::Matrix<double, N, d, Eigen::ColMajor, most_nodes, d>;
};

/// Where component a of gradient row I stands in a tensor of the point: at a + 3 I, −1 where nowhere (the
/// axial displacement has no hoop strain).
constexpr int tensor_place(int a, int row, int d) {
  if (row < d)
    return a + 3 * row;
  return a == 0 ? 8 : -1;
}

template <class S> Eigen::Matrix3d whole(const typename S::Gradient& gradient) {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  h.template topLeftCorner<S::d, S::d>() = gradient.template leftCols<S::d>();
  if constexpr (S::rows > S::d)
    h(2, 2) = gradient(0, 2);
  return h;
}

template <class S> typename S::Gradient part(const Eigen::Matrix3d& tensor) {
  typename S::Gradient gradient;
  gradient.template leftCols<S::d>() = tensor.template topLeftCorner<S::d, S::d>();
  if constexpr (S::rows > S::d)
    gradient.col(2) << tensor(2, 2), 0;
  return gradient;
}

template <class S> class CellGradients {
public:
  using AllNodes = Eigen::Matrix<double, S::nodes, S::rows, Eigen::ColMajor, S::most_nodes, S::rows>;

  /// On the undeformed shape.
  CellGradients(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points,
                const Section& section)
      : nodes_(reference.nodes), points_(reference.points) {
    const auto x = coordinates(points);
    if constexpr (S::is_reduced)
      set_means(reference, x, points, section);
    else
      for (int q = 0; q < points_; ++q)
        set_point(reference, x, section, q);
  }

  int nodes() const {
    if constexpr (S::is_fixed)
      return S::nodes;
    else
      return nodes_;
  }
  int points() const {
    if constexpr (S::is_fixed)
      return S::most_points;
    else
      return points_;
  }
  /// Volume of a point, measure included.
  double weight(int q) const { return weight_[static_cast<std::size_t>(q)]; }
  double radius(int q) const { return radius_[static_cast<std::size_t>(q)]; }
  /// det ∂X/∂ξ.
  double jacobian(int q) const { return jacobian_[static_cast<std::size_t>(q)]; }

  /// Gradients of two nodes after each other stand at `pair(q, row, i)`, i even.
  const double* pair(int q, int row, int i) const {
    return values_.data() +
           (static_cast<std::size_t>(q) * S::rows + static_cast<std::size_t>(row)) * S::stride +
           static_cast<std::size_t>(i);
  }
  double* pair(int q, int row, int i) { return const_cast<double*>(std::as_const(*this).pair(q, row, i)); }
  double at(int q, int row, int i) const { return *pair(q, row, i); }

  /// Nodes × rows of one point.
  auto gradients(int q) const {
    return Eigen::Map<const AllNodes, Eigen::Aligned16, Eigen::OuterStride<S::stride>>(pair(q, 0, 0), nodes(),
                                                                                       S::rows);
  }

  typename S::Nodal coordinates(std::span<const Eigen::Vector3d> points) const {
    typename S::Nodal x(nodes(), S::d);
    for (int i = 0; i < nodes(); ++i)
      x.row(i) = points[static_cast<std::size_t>(i)].template head<S::d>().transpose();
    return x;
  }

  /// Nodal values, a column a component, of dof numbered node · d + component.
  typename S::Nodal by_component(std::span<const double> values) const {
    typename S::Nodal u(nodes(), S::d);
    for (int i = 0; i < nodes(); ++i)
      for (int a = 0; a < S::d; ++a)
        u(i, a) = values[static_cast<std::size_t>(i * S::d + a)];
    return u;
  }

  /// ∂u/∂X at a point.
  Eigen::Matrix3d displacement_gradient(int q, const typename S::Nodal& u) const {
    return whole<S>(u.transpose().lazyProduct(gradients(q)));
  }

  /// `sum` += weight · tensor_aI ∂N_i/∂X_I of one point.
  void add_force(int q, const Eigen::Matrix3d& tensor, typename S::Nodal& sum) const {
    const typename S::Gradient weighted = weight(q) * part<S>(tensor);
    sum += gradients(q).lazyProduct(weighted.transpose());
  }

  typename S::Nodal no_force() const { return S::Nodal::Zero(nodes(), S::d); }

private:
  auto reference_at(const ReferenceGradients& reference, int q) const {
    using Matrix = Eigen::Matrix<double, S::nodes, S::d, Eigen::ColMajor, S::most_nodes, S::d>;
    constexpr int outer = S::is_fixed ? even(S::most_nodes) : Eigen::Dynamic;
    return Eigen::Map<const Matrix, Eigen::Aligned16, Eigen::OuterStride<outer>>(
        reference.gradients.col(q * S::d).data(), nodes(), S::d,
        Eigen::OuterStride<outer>(reference.gradients.rows()));
  }

  void set_point(const ReferenceGradients& reference, const typename S::Nodal& x, const Section& section,
                 int q) {
    const auto n_xi = reference_at(reference, q);
    const Eigen::Matrix<double, S::d, S::d> j = x.transpose().lazyProduct(n_xi);
    const auto n = reference.values.col(q).head(nodes());
    const auto place = static_cast<std::size_t>(q);
    jacobian_[place] = j.determinant();
    radius_[place] = x.col(0).dot(n);
    weight_[place] = reference.weights[q] * jacobian_[place] * measure(section, radius_[place]);
    using Matrix = Eigen::Matrix<double, S::nodes, S::d, Eigen::ColMajor, S::most_nodes, S::d>;
    Eigen::Map<Matrix, Eigen::Aligned16, Eigen::OuterStride<S::stride>>(pair(q, 0, 0), nodes(), S::d) =
        n_xi.lazyProduct(j.inverse());
    if constexpr (S::rows > S::d)
      Eigen::Map<Eigen::VectorXd>(pair(q, S::d, 0), nodes()) = n / radius_[place];
    clear_rest(q);
  }

  void set_means(const ReferenceGradients& reference, const typename S::Nodal& x,
                 std::span<const Eigen::Vector3d> points, const Section& section) {
    clear_rest(0);
    if constexpr (S::rows > S::d) {
      set_means_of(CellGradients<Shape<S::d, S::rows, S::nodes, S::nodes>>(reference, points, section));
    } else {
      const auto means = mean_gradients<S::d>(x);
      weight_[0] = means.volume * measure(section, 0);
      Eigen::Map<typename S::Nodal, Eigen::Aligned16, Eigen::OuterStride<S::stride>>(pair(0, 0, 0)) =
          means.gradients;
    }
  }

  /// Of a cell with points.
  template <class Points> void set_means_of(const Points& of_points) {
    weight_[0] = 0;
    typename Points::AllNodes sum = Points::AllNodes::Zero();
    for (int q = 0; q < of_points.points(); ++q) {
      weight_[0] += of_points.weight(q);
      sum += of_points.weight(q) * of_points.gradients(q);
    }
    Eigen::Map<typename Points::AllNodes, Eigen::Aligned16, Eigen::OuterStride<S::stride>>(pair(0, 0, 0)) =
        sum / weight_[0];
  }

  /// Nodes that make the number even, and places of modes.
  void clear_rest(int q) {
    if constexpr (S::stride > S::most_nodes || !S::is_fixed)
      for (int row = 0; row < S::rows; ++row)
        for (int i = nodes(); i < S::stride; ++i)
          *pair(q, row, i) = 0;
  }

  int nodes_;
  int points_;
  alignas(16) std::array<double, static_cast<std::size_t>(S::most_points* S::rows* S::stride)> values_;
  std::array<double, static_cast<std::size_t>(S::most_points)> weight_;
  std::array<double, static_cast<std::size_t>(S::most_points)> radius_;
  std::array<double, static_cast<std::size_t>(S::most_points)> jacobian_;
};

} // namespace rubato::element
