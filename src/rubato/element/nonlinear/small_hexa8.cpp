// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/small_hexa8.hpp"

#include "rubato/element/nonlinear/free_strains.hpp"
#include "rubato/element/nonlinear/hexa8_points.hpp"
#include "rubato/element/nonlinear/voigt_tensor.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace rubato::element {
namespace {

using hexa8::across;
using hexa8::Lanes;
using hexa8::node_of_corner;
using hexa8::starts;
using hexa8::Tensors;

constexpr std::size_t corner_count = hexa8::corner_count;

/// Of every component of tensors of a point, in Voigt's order.
using SixLanes = std::array<Lanes, 6>;

/// Place and displacement of the corners.
std::array<std::array<Pair, 3>, corner_count> corners_of(const CellInput& input) {
  std::array<std::array<Pair, 3>, corner_count> corners;
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    const auto node = node_of_corner[corner];
    const auto& x = input.points[node];
    const double* u = input.displacement.data() + 3 * node;
    corners[corner] = {Pair{x[0], x[1]}, Pair{x[2], u[0]}, Pair{u[1], u[2]}};
  }
  return corners;
}

class SmallHexa8 {
public:
  SmallHexa8(const CellKind& kind, const PointLaws& laws, const CellInput& input, const CellOutput& output)
      : laws_(laws), input_(input), output_(output),
        averages_(kind.formulation == Formulation::mean_dilatation),
        free_strains_(kind.strain, laws, input.free_strain) {
    set_gradients();
    set_strains();
  }

  CellResult evaluate() {
    const auto states = corner_count * static_cast<std::size_t>(laws_.state_size());
    const auto failed = laws_.respond({strain_, input_.old.first(states), output_.now.first(states),
                                       input_.step, material::Want::stress, response_});
    if (failed < corner_count)
      return {Failure::law, static_cast<int>(failed)};
    set_stresses();
    const bool finite = put_forces();
    if (!output_.records.empty())
      put_records();
    CellResult result;
    for (std::size_t q = 0; q < corner_count; ++q)
      result.stored += hexa8::at(weight_, q) * response_[q].stored;
    if (!finite)
      result.failure = Failure::not_finite;
    return result;
  }

private:
  void set_gradients() {
    Tensors j, u;
    hexa8::derive(
        corners_of(input_), [&](std::size_t component) -> auto& {
          return component < 3 ? j[component] : u[component - 3];
        });
    weight_ = hexa8::set_cofactors(j, cofactor_);
    Lanes inverse;
    for (std::size_t p = 0; p < 4; ++p)
      inverse[p] = 1. / weight_[p];
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t p = 0; p < 4; ++p)
          gradient_[a][b][p] = (u[a][0][p] * cofactor_[b][0][p] + u[a][1][p] * cofactor_[b][1][p] +
                                u[a][2][p] * cofactor_[b][2][p]) *
                               inverse[p];
  }

  void set_strains() {
    const auto& h = gradient_;
    SixLanes strain{h[0][0], h[1][1], h[2][2]};
    for (std::size_t p = 0; p < 4; ++p) {
      strain[3][p] = h[0][1][p] + h[1][0][p];
      strain[4][p] = h[1][2][p] + h[2][1][p];
      strain[5][p] = h[0][2][p] + h[2][0][p];
    }
    if (averages_)
      replace_mean(strain);
    for (std::size_t q = 0; q < corner_count; ++q) {
      double* const of_point = strain_[q].data();
      for (std::size_t i = 0; i < 3; ++i)
        put_pair(Pair{hexa8::at(strain[2 * i], q), hexa8::at(strain[2 * i + 1], q)}, of_point + 2 * i);
      free_strains_.take_from(q, strain_[q]);
    }
  }

  /// A third of the sum of the first three becomes its mean over the volume.
  void replace_mean(SixLanes& tensor) const {
    Lanes third;
    for (std::size_t p = 0; p < 4; ++p)
      third[p] = (tensor[0][p] + tensor[1][p] + tensor[2][p]) / 3.;
    const double mean_third = mean(third);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t p = 0; p < 4; ++p)
        tensor[a][p] += mean_third - third[p];
  }

  double mean(const Lanes& values) const {
    const auto sum = [](const Lanes& lanes) { return sum_of((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])); };
    Lanes weighted;
    for (std::size_t p = 0; p < 4; ++p)
      weighted[p] = weight_[p] * values[p];
    return sum(weighted) / sum(weight_);
  }

  /// What forces are made of: with mean dilatation the pressure is its mean, too.
  void set_stresses() {
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t i = 0; i < 6; ++i)
        stress_[i][p] = Pair{response_[2 * p].stress.data()[i], response_[2 * p + 1].stress.data()[i]};
    if (averages_)
      replace_mean(stress_);
  }

  const Lanes& stress(std::size_t a, std::size_t b) const {
    return stress_[static_cast<std::size_t>(voigt_place(static_cast<int>(a), static_cast<int>(b)))];
  }

  /// Whether they are finite.
  bool put_forces() {
    using Force = std::array<Pair, 2>; // the last number is 0: two numbers at once
    std::array<Force, corner_count> forces{};
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Lanes, 3> by_xi;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t p = 0; p < 4; ++p)
          by_xi[a][p] = stress(a, 0)[p] * cofactor_[0][k][p] + stress(a, 1)[p] * cofactor_[1][k][p] +
                        stress(a, 2)[p] * cofactor_[2][k][p];
      std::array<Force, 4> along;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto start = starts[k][i], end = starts[k][i] + across(k);
        const auto half = [&](std::size_t a) {
          return 0.5 * (hexa8::at(by_xi[a], start) + hexa8::at(by_xi[a], end));
        };
        along[i] = {Pair{half(0), half(1)}, Pair{half(2), 0}};
      }
      hexa8::mix(along);
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t m = 0; m < 2; ++m) {
          forces[starts[k][i]][m] -= along[i][m];
          forces[starts[k][i] + across(k)][m] += along[i][m];
        }
    }
    double sum = 0;
    for (std::size_t corner = 0; corner < corner_count; ++corner)
      for (std::size_t a = 0; a < 3; ++a)
        sum += output_.force[3 * node_of_corner[corner] + a] = forces[corner][a / 2][a % 2];
    return std::isfinite(sum);
  }

  void put_records() const {
    for (std::size_t q = 0; q < corner_count; ++q) {
      auto& record = output_.records[q];
      record.volume = hexa8::at(weight_, q);
      record.stored = response_[q].stored;
      record.strain = strain_[q];
      record.free = free_strains_.at(q);
      record.stress = record.cauchy = response_[q].stress;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
          record.gradient.data()[a + 3 * b] = hexa8::at(gradient_[a][b], q);
          record.piola.data()[a + 3 * b] = hexa8::at(stress(a, b), q);
        }
    }
  }

  const PointLaws& laws_;
  const CellInput& input_;
  const CellOutput& output_;
  bool averages_;
  FreeStrains free_strains_;
  Tensors cofactor_; ///< w J⁻ᵀ: row of X, column of ξ
  Tensors gradient_; ///< ∂u/∂X
  Lanes weight_;
  SixLanes stress_;
  std::array<material::Strain6, corner_count> strain_;
  std::array<material::Response, corner_count> response_;
};

} // namespace

bool is_small_hexa8(const CellKind& kind, const CellOutput& output) {
  return kind.type == CellType::hexa8 && kind.strain == StrainKind::small && output.tangent.empty() &&
         (kind.formulation == Formulation::full || kind.formulation == Formulation::mean_dilatation);
}

CellResult evaluate_small_hexa8(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                                const CellOutput& output) {
  return SmallHexa8(kind, laws, input, output).evaluate();
}

} // namespace rubato::element
