// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/cell_gradients.hpp"

#include "rubato/element/nonlinear/mean_gradients.hpp"
#include "rubato/element/nonlinear/pair.hpp"
#include "rubato/element/nonlinear/small_square.hpp"

namespace rubato::element {
namespace {

/// Components, rows and nodes of a cell; 0 nodes: a number known at run time.
template <int Components, int GradientRows, int Nodes> struct Sizes {
  static constexpr int d = Components;
  static constexpr int rows = GradientRows;
  static constexpr bool is_fixed = Nodes > 0;
  static constexpr int known_pairs = even(Nodes) / 2;

  static constexpr int pairs(int nodes) { return is_fixed ? known_pairs : even(nodes) / 2; }
  static constexpr int stride(int of_cell) { return is_fixed ? stride_of(Nodes, d) : of_cell; }
};

/// Calls work(Sizes), with the number of nodes where it is among `known`.
template <int d, int rows, int... known, class Work> void with_nodes(int nodes, const Work& work) {
  const bool is_known = ((nodes == known && (work(Sizes<d, rows, known>{}), true)) || ...);
  if (!is_known)
    work(Sizes<d, rows, 0>{});
}

/// Calls work(Sizes) with the sizes of the cell.
template <class Work> void with_sizes(const CellGradients& cell, const Work& work) {
  if (cell.components() == 3)
    return with_nodes<3, 3, 8, 20, 4, 10>(cell.nodes(), work);
  if (cell.rows() == 3)
    return with_nodes<2, 3, 4, 8>(cell.nodes(), work);
  return with_nodes<2, 2, 4, 8>(cell.nodes(), work);
}

/// Component a of node i from i · distance + a; an odd number of nodes is made even by zeros.
template <class Sizes, int distance>
void gather(const double* values, int nodes, int of_cell, NodalValues& nodal) {
  constexpr int d = Sizes::d;
  const int pairs = Sizes::pairs(nodes), stride = Sizes::stride(of_cell);
  for (int p = 0; p < pairs; ++p) {
    const double* const node = values + 2 * p * distance;
    const bool has_both = Sizes::is_fixed || 2 * p + 1 < nodes;
    for (int a = 0; a < d; ++a)
      put_pair(Pair{node[a], has_both ? node[distance + a] : 0}, nodal.component(a, stride) + 2 * p);
  }
}

/// The reverse, to i · d + a. Returns the sum of all.
template <class Sizes> double scatter(const NodalValues& nodal, int nodes, int of_cell, double* values) {
  constexpr int d = Sizes::d;
  const int pairs = Sizes::pairs(nodes), stride = Sizes::stride(of_cell);
  std::array<Pair, static_cast<std::size_t>(d)> sums{};
  for (int p = 0; p < pairs; ++p) {
    double* const node = values + 2 * p * d;
    const bool has_both = Sizes::is_fixed || 2 * p + 1 < nodes;
    unrolled<d>([&](auto a) {
      const Pair pair = pair_at(nodal.component(a, stride) + 2 * p);
      sums[a] += pair;
      node[a] = pair[0];
      if (has_both)
        node[d + a] = pair[1];
    });
  }
  Pair sum = sums[0];
  for (std::size_t a = 1; a < sums.size(); ++a)
    sum += sums[a];
  return sum_of(sum);
}

} // namespace

CellGradients::CellGradients(CellType type, std::span<const Eigen::Vector3d> points, const Section& section,
                             PointRule rule)
    : d_(component_count(section.physics)), rows_(section.physics == study::Physics::axisymmetric ? 3 : d_) {
  const bool has_one_point = rule == PointRule::one;
  const auto& reference = reference_gradients(type, has_one_point ? PointRule::stiffness : rule);
  nodes_ = reference.nodes;
  points_ = has_one_point ? 1 : reference.points;
  stride_ = stride_of(nodes_, d_);
  with_sizes(*this, [&]<class Sizes>(Sizes) {
    gather<Sizes, 3>(points.front().data(), nodes_, stride_, coordinates_);
    if (!has_one_point)
      set_points<Sizes>(reference, section);
  });
  if (has_one_point)
    set_means(type, points, section);
}

NodalValues CellGradients::by_component(std::span<const double> values) const {
  NodalValues u;
  with_sizes(*this, [&]<class Sizes>(Sizes) { gather<Sizes, Sizes::d>(values.data(), nodes_, stride_, u); });
  return u;
}

NodalValues CellGradients::no_force() const {
  NodalValues force;
  with_sizes(*this, [&]<class Sizes>(Sizes) {
    const int size = Sizes::d * Sizes::stride(stride_);
    for (int i = 0; i < size; i += 2)
      put_pair(Pair{}, force.values.data() + i);
  });
  return force;
}

void CellGradients::set_displacement_gradients(const NodalValues& u,
                                               std::span<Eigen::Matrix3d> gradients) const {
  with_sizes(*this, [&]<class Sizes>(Sizes) { set_gradients_of<Sizes>(u.values.data(), gradients); });
}

void CellGradients::add_forces(std::span<const Eigen::Matrix3d> tensors, NodalValues& sum) const {
  with_sizes(*this, [&]<class Sizes>(Sizes) {
    for (int q = 0; q < points_; ++q)
      add_force_to<Sizes>(q, tensors[static_cast<std::size_t>(q)].data(), sum.values.data());
  });
}

void CellGradients::add_force(int q, const Eigen::Matrix3d& tensor, NodalValues& sum) const {
  with_sizes(*this, [&]<class Sizes>(Sizes) { add_force_to<Sizes>(q, tensor.data(), sum.values.data()); });
}

double CellGradients::put(const NodalValues& nodal, std::span<double> values) const {
  double sum = 0;
  with_sizes(*this, [&]<class Sizes>(Sizes) { sum = scatter<Sizes>(nodal, nodes_, stride_, values.data()); });
  return sum;
}

template <class Sizes>
void CellGradients::set_points(const ReferenceGradients& reference, const Section& section) {
  constexpr int d = Sizes::d, rows = Sizes::rows;
  const int pairs = Sizes::pairs(nodes_), stride = Sizes::stride(stride_);
  for (int q = 0; q < points_; ++q) {
    const double* const by_xi = reference.gradients.data() + static_cast<std::ptrdiff_t>(q * d * 2 * pairs);
    const auto place = static_cast<std::size_t>(q);
    Square<d> inverse;
    jacobian_[place] = invert(
        products<d, d, Sizes::known_pairs>(coordinates_.values.data(), stride, by_xi, 2 * pairs, pairs),
        inverse);
    weight_[place] = reference.weights[q] * jacobian_[place];
    double* const out = values_.data() + q * rows * stride;
    for (int p = 0; p < pairs; ++p)
      unrolled<d>([&](auto row) {
        Pair sum = pair_at(by_xi + 2 * p) * inverse[d * row];
        unrolled<d - 1>(
            [&](auto m) { sum += pair_at(by_xi + ((m + 1) * pairs + p) * 2) * inverse[m + 1 + d * row]; });
        put_pair(sum, out + row * stride + 2 * p);
      });
    if constexpr (rows > d) {
      const double* const n = reference.values.data() + static_cast<std::ptrdiff_t>(q * 2 * pairs);
      radius_[place] = products<1, 1, Sizes::known_pairs>(coordinates_.values.data(), 0, n, 0, pairs)[0];
      for (int p = 0; p < pairs; ++p)
        put_pair(pair_at(n + 2 * p) / radius_[place], out + d * stride + 2 * p);
      weight_[place] *= measure(section, radius_[place]);
    } else if constexpr (d == 2) {
      weight_[place] *= measure(section, 0);
    }
  }
}

void CellGradients::set_means(CellType type, std::span<const Eigen::Vector3d> points,
                              const Section& section) {
  if (rows_ == d_) {
    double volume = 0;
    if (d_ == 3)
      volume = set_mean_gradients<3>(points, stride_, values_.data());
    else
      volume = set_mean_gradients<2>(points, stride_, values_.data());
    weight_[0] = volume * measure(section, 0);
    return;
  }
  const CellGradients at_points(type, points, section, PointRule::stiffness);
  const int size = rows_ * stride_;
  weight_[0] = 0;
  for (int q = 0; q < at_points.points(); ++q)
    weight_[0] += at_points.weight(q);
  for (int i = 0; i < size; ++i) {
    double sum = 0;
    if (i % stride_ < nodes_)
      for (int q = 0; q < at_points.points(); ++q)
        sum += at_points.weight(q) * at_points.row(q, 0)[i];
    values_[static_cast<std::size_t>(i)] = sum / weight_[0];
  }
}

template <class Sizes>
void CellGradients::set_gradients_of(const double* u, std::span<Eigen::Matrix3d> gradients) const {
  constexpr int d = Sizes::d, rows = Sizes::rows;
  const int pairs = Sizes::pairs(nodes_), stride = Sizes::stride(stride_);
  for (int q = 0; q < points_; ++q) {
    const auto sums =
        products<d, rows, Sizes::known_pairs>(u, stride, values_.data() + q * rows * stride, stride, pairs);
    double* const h = gradients[static_cast<std::size_t>(q)].data();
    if constexpr (d == 2)
      h[2] = h[5] = h[6] = h[7] = h[8] = 0;
    unrolled<rows * d>([&](auto m) {
      constexpr int place = tensor_place(m % d, m / d, d);
      if constexpr (place >= 0)
        h[place] = sums[m];
    });
  }
}

template <class Sizes> void CellGradients::add_force_to(int q, const double* tensor, double* sum) const {
  constexpr int d = Sizes::d, rows = Sizes::rows;
  const int pairs = Sizes::pairs(nodes_), stride = Sizes::stride(stride_);
  const double* const gradients = values_.data() + q * rows * stride;
  std::array<Pair, static_cast<std::size_t>(d * rows)> weighted;
  unrolled<rows * d>([&](auto m) {
    constexpr int place = tensor_place(m % d, m / d, d);
    if constexpr (place >= 0)
      weighted[m] = twice(weight(q) * tensor[place]);
  });
  for (int p = 0; p < pairs; ++p)
    unrolled<d>([&](auto a) {
      Pair of_point = pair_at(gradients + 2 * p) * weighted[a];
      unrolled<rows - 1>([&](auto m) {
        if constexpr (tensor_place(a, m + 1, d) >= 0)
          of_point += pair_at(gradients + (m + 1) * stride + 2 * p) * weighted[a + d * (m + 1)];
      });
      double* const at = sum + a * stride + 2 * p;
      put_pair(pair_at(at) + of_point, at);
    });
}

} // namespace rubato::element
