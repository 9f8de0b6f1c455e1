// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/hourglass_control.hpp"

#include "rubato/element/nonlinear/mean_gradients.hpp"
#include "rubato/element/nonlinear/pair.hpp"
#include "rubato/element/nonlinear/small_square.hpp"

#include <cmath>

namespace rubato::element {
namespace {

/// Patterns that one point does not see, among the waves (mean_gradients.hpp).
template <int d> constexpr auto unseen_waves() {
  if constexpr (d == 2)
    return std::array{2};
  else
    return std::array{2, 4, 5, 6};
}

template <int d> double trace_of_inverse(const Square<d>& m) {
  Square<d> inverse;
  invert(m, inverse);
  double trace = 0;
  for (std::size_t a = 0; a < static_cast<std::size_t>(d); ++a)
    trace += inverse[a * (d + 1)];
  return trace;
}

} // namespace

HourglassForces::HourglassForces(const CellKind& kind, const CellGradients& gradients,
                                 std::span<const Eigen::Vector3d> points, const NodalValues& u)
    : d_(gradients.components()), stride_(gradients.stride()), rolls_(gradients.rows() > d_),
      limit_(kind.hourglass.limit),
      stiffness_(hourglass_coefficient * kind.hourglass.modulus * gradients.weight(0)) {
  if (d_ == 3) {
    set_shapes<3>(gradients, points);
    set_half_gradient<3>(u);
  } else {
    set_shapes<2>(gradients, points);
    set_half_gradient<2>(u);
  }
  if (rolls_)
    add_rolling(gradients, kind, points, u);
  root_ = limit_ > 0 ? std::sqrt(1 + strain_squared_ / (limit_ * limit_)) : 1;
}

NodalValues HourglassForces::forces() const {
  return d_ == 3 ? forces_of<3>() : forces_of<2>();
}

template <int d> NodalValues HourglassForces::forces_of() const {
  constexpr int nodes = Waves<d>::nodes, stride = stride_of(nodes, d);
  NodalValues forces;
  const Pair secant = twice(stiffness_ / root_);
  for (int a = 0; a < d; ++a)
    for (int i = 0; i < nodes; i += 2)
      put_pair(secant * pair_at(half_gradient_.component(a, stride) + i), forces.component(a, stride) + i);
  return forces;
}

void HourglassForces::add_tangent(const MatrixView& k) const {
  if (d_ == 3)
    add_tangent_of<3>(k);
  else
    add_tangent_of<2>(k);
}

template <int d> void HourglassForces::add_tangent_of(const MatrixView& k) const {
  constexpr int nodes = Waves<d>::nodes, patterns = static_cast<int>(unseen_waves<d>().size());
  const double secant = stiffness_ / root_;
  for (int j = 0; j < nodes; ++j)
    for (int i = 0; i < nodes; i += 2) {
      Pair dots{};
      for (int m = 0; m < patterns; ++m)
        dots += pair_at(shapes_.data() + i + nodes * m) * shapes_[place(j + nodes * m)];
      dots *= secant * scale_;
      double* const block = k.column(j * d) + i * d;
      for (int a = 0; a < d; ++a) {
        block[a * k.leading + a] += dots[0];
        block[a * k.leading + d + a] += dots[1];
      }
    }
  if (rolls_)
    for (int j = 0; j < nodes; ++j)
      for (int i = 0; i < nodes; ++i) {
        double dot = 0;
        for (int q = 0; q < nodes; ++q)
          dot += rolling_[place(i + nodes * q)] * rolling_[place(j + nodes * q)];
        k(i * d, j * d) += secant * dot;
      }
  if (limit_ > 0)
    subtract_square<d>(secant / (limit_ * limit_ * root_ * root_), k);
}

/// γ_α, and b. The moments Σ_I φ_α X_I are sums of the waves.
template <int d>
void HourglassForces::set_shapes(const CellGradients& gradients, std::span<const Eigen::Vector3d> points) {
  constexpr int nodes = Waves<d>::nodes, stride = stride_of(nodes, d);
  constexpr auto unseen = unseen_waves<d>();
  const auto& all = waves<d>();
  const auto all_moments = wave_sums<d>(points); // of the constant wave, too
  const double* const mean = gradients.row(0, 0);
  for (std::size_t pattern = 0; pattern < unseen.size(); ++pattern) {
    const double* const wave = all.of(unseen[pattern]);
    const auto& moments = all_moments[place(unseen[pattern] + 1)];
    double* const shape = shapes_.data() + pattern * nodes;
    for (int i = 0; i < nodes; i += 2) {
      Pair seen = pair_at(mean + i) * moments[0];
      for (int a = 1; a < d; ++a)
        seen += pair_at(mean + a * stride + i) * moments[static_cast<std::size_t>(a)];
      put_pair(pair_at(wave + i) - seen, shape + i);
    }
  }
  const auto squares = products<d, d, nodes / 2>(mean, stride, mean, stride, nodes / 2);
  const double harmonic = d / trace_of_inverse<d>(squares);
  scale_ = harmonic * d / nodes;
}

template <int d> void HourglassForces::set_half_gradient(const NodalValues& u) {
  constexpr int nodes = Waves<d>::nodes, stride = stride_of(nodes, d);
  constexpr int patterns = static_cast<int>(unseen_waves<d>().size());
  const auto strains =
      products<d, patterns, nodes / 2>(u.values.data(), stride, shapes_.data(), nodes, nodes / 2);
  for (const double strain : strains)
    strain_squared_ += strain * strain;
  strain_squared_ *= scale_;
  for (int a = 0; a < d; ++a)
    for (int i = 0; i < nodes; i += 2) {
      Pair sum = pair_at(shapes_.data() + i) * strains[static_cast<std::size_t>(a)];
      for (int m = 1; m < patterns; ++m)
        sum += pair_at(shapes_.data() + m * nodes + i) * strains[static_cast<std::size_t>(a + d * m)];
      put_pair(scale_ * sum, half_gradient_.component(a, stride) + i);
    }
}

void HourglassForces::add_rolling(const CellGradients& gradients, const CellKind& kind,
                                  std::span<const Eigen::Vector3d> points, const NodalValues& u) {
  const CellGradients at(kind.type, points, kind.section, PointRule::stiffness);
  const int nodes = gradients.nodes();
  const double* const mean = gradients.row(0, d_);
  double* const radial = half_gradient_.component(0, stride_);
  for (int q = 0; q < nodes; ++q) {
    const double root = std::sqrt(2 * at.weight(q) / gradients.weight(0));
    double* const of_point = rolling_.data() + q * nodes;
    double strain = 0;
    for (int i = 0; i < nodes; ++i) {
      of_point[i] = root * (at.at(q, d_, i) - mean[i]);
      strain += of_point[i] * u.component(0, stride_)[i];
    }
    strain_squared_ += strain * strain;
    for (int i = 0; i < nodes; ++i)
      radial[i] += of_point[i] * strain;
  }
}

/// K −= factor g gᵀ, g the half gradient.
template <int d> void HourglassForces::subtract_square(double factor, const MatrixView& k) const {
  constexpr int nodes = Waves<d>::nodes;
  std::array<double, place(nodes * d)> g;
  for (int i = 0; i < nodes; ++i)
    for (int a = 0; a < d; ++a)
      g[place(i * d + a)] = half_gradient_.component(a, stride_)[i];
  for (std::size_t j = 0; j < g.size(); ++j) {
    double* const column = k.column(static_cast<int>(j));
    for (std::size_t i = 0; i < g.size(); ++i)
      column[i] -= factor * (g[i] * g[j]);
  }
}

double hourglass_energy(const CellKind& kind, std::span<const Eigen::Vector3d> points,
                        std::span<const double> displacement) {
  if (kind.formulation != Formulation::reduced)
    return 0;
  const CellGradients gradients(kind.type, points, kind.section, PointRule::one);
  return HourglassForces(kind, gradients, points, gradients.by_component(displacement)).energy();
}

} // namespace rubato::element
