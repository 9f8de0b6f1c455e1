// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/between_motion.hpp"

#include "rubato/element/nonlinear/bubble_cell.hpp"
#include "rubato/element/nonlinear/enhanced_modes.hpp"
#include "rubato/element/nonlinear/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::element {
namespace {

/// sym (1 + H)ᵀ C.
Eigen::Matrix3d symmetric_part(const Eigen::Matrix3d& h, const Eigen::Matrix3d& c) {
  Eigen::Matrix3d turned = c, symmetric;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      turned(i, j) += h(0, i) * c(0, j) + h(1, i) * c(1, j) + h(2, i) * c(2, j);
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      symmetric(i, j) = 0.5 * (turned(i, j) + turned(j, i));
  return symmetric;
}

} // namespace

BetweenMotion::BetweenMotion(const CellKind& kind, const BetweenInput& input, int modes)
    : gradients_(kind.type, input.points, kind.section, rule_of(kind.formulation)),
      nodes_(gradients_.nodes() + modes) {
  if (modes > 0 && has_bubble(kind.type))
    put_bubble(kind.type, input.points, gradients_);
  else if (modes > 0)
    put_modes(reference_gradients(kind.type), input.points, gradients_);
  before_ = relative(input.before);
  after_ = relative(input.after);
}

CellResult BetweenMotion::move() {
  change_ = gradients_.no_force();
  for (int a = 0; a < gradients_.components(); ++a)
    for (int i = 0; i < nodes_; ++i)
      change_.component(a, gradients_.stride())[i] = value(after_, i, a) - value(before_, i, a);
  for (int q = 0; q < points(); ++q)
    if (!move(q))
      return {Failure::inverted, q};
  return {};
}

void BetweenMotion::add_force(int q, const Eigen::Matrix3d& tensor, NodalValues& sum) const {
  const int d = gradients_.components();
  for (int row = 0; row < gradients_.rows(); ++row) {
    const double* const g = gradients_.row(q, row);
    for (int a = 0; a < d; ++a)
      if (const int place = tensor_place(a, row, d); place >= 0) {
        const double weighted = gradients_.weight(q) * tensor.data()[place];
        double* const component = sum.component(a, gradients_.stride());
        for (int i = 0; i < nodes_; ++i)
          component[i] += weighted * g[i];
      }
  }
}

NodalValues BetweenMotion::relative(std::span<const double> values) const {
  const int d = gradients_.components();
  auto u = gradients_.no_force();
  for (int a = 0; a < d; ++a) {
    // axisymmetric: a radial motion is none of a rigid body
    const double rigid = a == 0 && gradients_.rows() > d ? 0 : values[static_cast<std::size_t>(a)];
    for (int i = 0; i < gradients_.nodes(); ++i)
      u.component(a, gradients_.stride())[i] = values[static_cast<std::size_t>(i * d + a)] - rigid;
  }
  return u;
}

void BetweenMotion::put(const ModeValues& values, NodalValues& u) const {
  const int d = gradients_.components(), nodes = gradients_.nodes();
  for (int m = 0; m < nodes_ - nodes; ++m)
    for (int a = 0; a < d; ++a)
      u.component(a, gradients_.stride())[nodes + m] = values[static_cast<std::size_t>(m * d + a)];
}

Eigen::Matrix3d BetweenMotion::gradient_of(int q, const NodalValues& u) const {
  const int d = gradients_.components();
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  for (int row = 0; row < gradients_.rows(); ++row)
    for (int a = 0; a < d; ++a)
      if (const int place = tensor_place(a, row, d); place >= 0) {
        const double* const g = gradients_.row(q, row);
        const double* const component = u.component(a, gradients_.stride());
        double sum = 0;
        for (int i = 0; i < nodes_; ++i)
          sum += component[i] * g[i];
        h.data()[place] = sum;
      }
  return h;
}

double BetweenMotion::reach_of(int q) const {
  double squares = 0;
  for (int row = 0; row < gradients_.rows(); ++row)
    for (int a = 0; a < gradients_.components(); ++a) {
      double sum = 0;
      for (int i = 0; i < nodes_; ++i) {
        const double size = std::max(std::abs(value(before_, i, a)), std::abs(value(after_, i, a)));
        sum += size * std::abs(gradients_.at(q, row, i));
      }
      squares += sum * sum;
    }
  return std::sqrt(squares);
}

bool BetweenMotion::move(int q) {
  const auto p = static_cast<std::size_t>(q);
  before[p] = gradient_of(q, before_);
  after[p] = gradient_of(q, after_);
  middle[p] = 0.5 * (before[p] + after[p]);
  half_change[p] = symmetric_part(middle[p], gradient_of(q, change_));
  reach[p] = reach_of(q);
  return volume_change(before[p]) > -1 && volume_change(after[p]) > -1;
}

} // namespace rubato::element
