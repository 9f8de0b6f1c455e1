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
using hexa8::Pair;
using hexa8::pair_of;
using hexa8::starts;
using hexa8::Tensors;

constexpr std::size_t corner_count = hexa8::corner_count;

/// Of every component of tensors of a point, in Voigt's order.
using SixLanes = std::array<Lanes, 6>;

/// Place and displacement of the corners.
std::array<Eigen::Array<double, 6, 1>, corner_count> corners_of(const CellInput& input) {
  std::array<Eigen::Array<double, 6, 1>, corner_count> corners;
  for (std::size_t corner = 0; corner < corner_count; ++corner) {
    const auto node = node_of_corner[corner];
    const auto& x = input.points[node];
    const double* u = input.displacement.data() + 3 * node;
    pair_of(corners[corner], 0) = Pair(x[0], x[1]);
    pair_of(corners[corner], 1) = Pair(x[2], u[0]);
    pair_of(corners[corner], 2) = Pair(u[1], u[2]);
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
      result.stored += weight_[lane(q)] * response_[q].stored;
    if (!finite)
      result.failure = Failure::not_finite;
    return result;
  }

private:
  static Eigen::Index lane(std::size_t q) { return static_cast<Eigen::Index>(q); }

  void set_gradients() {
    Tensors j, u;
    hexa8::derive(
        corners_of(input_), [&](std::size_t component) -> auto& {
          return component < 3 ? j[component] : u[component - 3];
        });
    weight_ = hexa8::set_cofactors(j, cofactor_);
    const Lanes inverse = 1 / weight_;
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        gradient_[a][b] =
            (u[a][0] * cofactor_[b][0] + u[a][1] * cofactor_[b][1] + u[a][2] * cofactor_[b][2]) * inverse;
  }

  void set_strains() {
    const auto& h = gradient_;
    SixLanes strain{h[0][0], h[1][1], h[2][2], h[0][1] + h[1][0], h[1][2] + h[2][1], h[0][2] + h[2][0]};
    if (averages_) {
      const Lanes change = h[0][0] + h[1][1] + h[2][2];
      const Lanes missing = (mean(change) - change) / 3;
      for (std::size_t a = 0; a < 3; ++a)
        strain[a] += missing;
    }
    for (std::size_t q = 0; q < corner_count; ++q) {
      for (std::size_t i = 0; i < 3; ++i)
        pair_of(strain_[q], i) = Pair(strain[2 * i][lane(q)], strain[2 * i + 1][lane(q)]);
      free_strains_.take_from(q, strain_[q]);
    }
  }

  double mean(const Lanes& values) const { return (weight_ * values).sum() / weight_.sum(); }

  /// What forces are made of: with mean dilatation the pressure is its mean, too.
  void set_stresses() {
    for (std::size_t pair = 0; pair < 4; ++pair)
      for (std::size_t i = 0; i < 6; ++i)
        pair_of(stress_[i], pair) =
            Pair(response_[2 * pair].stress[lane(i)], response_[2 * pair + 1].stress[lane(i)]);
    if (!averages_)
      return;
    const Lanes pressure = (stress_[0] + stress_[1] + stress_[2]) / 3;
    const Lanes missing = mean(pressure) - pressure;
    for (std::size_t a = 0; a < 3; ++a)
      stress_[a] += missing;
  }

  const Lanes& stress(std::size_t a, std::size_t b) const {
    return stress_[static_cast<std::size_t>(voigt_place(static_cast<int>(a), static_cast<int>(b)))];
  }

  /// Whether they are finite.
  bool put_forces() {
    using Force = Eigen::Array<double, 4, 1>; // the last one is 0: two numbers at once
    std::array<Force, corner_count> forces;
    forces.fill(Force::Zero());
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<Lanes, 3> by_xi;
      for (std::size_t a = 0; a < 3; ++a)
        by_xi[a] =
            stress(a, 0) * cofactor_[0][k] + stress(a, 1) * cofactor_[1][k] + stress(a, 2) * cofactor_[2][k];
      std::array<Force, 4> along;
      for (std::size_t i = 0; i < 4; ++i) {
        const auto start = lane(starts[k][i]), end = lane(starts[k][i] + across(k));
        const auto half = [&](std::size_t a) { return 0.5 * (by_xi[a][start] + by_xi[a][end]); };
        pair_of(along[i], 0) = Pair(half(0), half(1));
        pair_of(along[i], 1) = Pair(half(2), 0);
      }
      hexa8::mix(along);
      for (std::size_t i = 0; i < 4; ++i) {
        forces[starts[k][i]] -= along[i];
        forces[starts[k][i] + across(k)] += along[i];
      }
    }
    double sum = 0;
    for (std::size_t corner = 0; corner < corner_count; ++corner)
      for (std::size_t a = 0; a < 3; ++a)
        sum += output_.force[3 * node_of_corner[corner] + a] = forces[corner][lane(a)];
    return std::isfinite(sum);
  }

  void put_records() const {
    for (std::size_t q = 0; q < corner_count; ++q) {
      auto& record = output_.records[q];
      record.volume = weight_[lane(q)];
      record.stored = response_[q].stored;
      record.strain = strain_[q];
      record.free = free_strains_.at(q);
      record.stress = record.cauchy = response_[q].stress;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b) {
          record.gradient(lane(a), lane(b)) = gradient_[a][b][lane(q)];
          record.piola(lane(a), lane(b)) = stress(a, b)[lane(q)];
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
