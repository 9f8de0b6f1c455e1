// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/tie_gap.hpp"

#include "rubato/contact/small_vectors.hpp"

namespace rubato::contact {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Part of the product of their lengths below which two tangents span no surface.
constexpr double no_frame = 1e-8;

/// The sums of the master's tangents and the frame that they give.
struct TieFrame {
  Vector3d first, second; ///< a₁, a₂
  Vector3d e1, e2, n;
  double length = 0; ///< |a₁|
  double area = 0;   ///< |a₁ × a₂|

  Vector3d vector_of(const Vector3d& parts) const {
    return sum_of(sum_of(scaled(parts[0], e1), scaled(parts[1], e2)), scaled(parts[2], n));
  }
  Vector3d parts_of(const Vector3d& v) const { return {dot(e1, v), dot(e2, v), dot(n, v)}; }
};

TieFrame frame_of(const TieGap& gap, const Stencil& stencil, const NodePlace& at) {
  TieFrame frame;
  frame.first = {0, 0, 0};
  frame.second = {0, 0, gap.in_plane ? 1. : 0.};
  for (std::size_t l = 0; l < gap.places.size(); ++l) {
    const Vector3d x = at(stencil.nodes[gap.places[l]]);
    add_scaled(gap.slopes[l][0], x, frame.first);
    add_scaled(gap.slopes[l][1], x, frame.second);
  }
  const auto across = cross(frame.first, frame.second);
  frame.length = length_of(frame.first);
  frame.area = length_of(across);
  frame.e1 = unit_of(frame.first);
  frame.n = unit_of(across);
  frame.e2 = cross(frame.n, frame.e1);
  return frame;
}

/// v ↦ a × v
Matrix3d cross_matrix(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

Matrix3d product_of(const Matrix3d& a, const Matrix3d& b) {
  Matrix3d product;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      product(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return product;
}

/// (1 − u uᵀ) factor
Matrix3d across_matrix(const Vector3d& unit, double factor) {
  Matrix3d m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m(i, j) = factor * ((i == j ? 1 : 0) - unit[i] * unit[j]);
  return m;
}

/// factor · 1 + a ×
Matrix3d scaled_and_turned(double factor, const Vector3d& a) {
  Matrix3d m = cross_matrix(a);
  for (int i = 0; i < 3; ++i)
    m(i, i) += factor;
  return m;
}

/// ∂G/∂a₁ and ∂G/∂a₂. With δn = P (a₁ × δa₂ − a₂ × δa₁)/|a₁ × a₂| and δe₁ = P₁ δa₁/|a₁|:
/// δG = γ₁ δe₁ + γ₂ (n × δe₁ − e₁ × δn) + γ₃ δn.
std::array<Matrix3d, 2> derivatives_of(const TieFrame& frame, const Vector3d& parts) {
  const auto across = across_matrix(frame.n, 1 / frame.area);
  const auto by_normal = scaled_and_turned(parts[2], scaled(-parts[1], frame.e1));
  const auto by_first = scaled_and_turned(parts[0], scaled(parts[1], frame.n));
  const auto normal_by_first = product_of(across, cross_matrix(scaled(-1, frame.second)));
  const auto normal_by_second = product_of(across, cross_matrix(frame.first));
  std::array<Matrix3d, 2> derivatives{product_of(by_first, across_matrix(frame.e1, 1 / frame.length)),
                                      product_of(by_normal, normal_by_second)};
  const auto through_normal = product_of(by_normal, normal_by_first);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      derivatives[0](i, j) += through_normal(i, j);
  return derivatives;
}

} // namespace

TieGap make_tie_gap(const Stencil& stencil, std::span<const SurfaceGradient> gradients, const Vector3d& gap,
                    const Vector3d& normal, const NodePlace& at) {
  TieGap made;
  made.in_plane = stencil.components == 2;
  const Vector3d first = made.in_plane ? Vector3d(-normal[1], normal[0], 0) : unit_across(normal);
  const Vector3d second = cross(normal, first);
  for (const auto& [place, gradient] : gradients) {
    if (is_zero(gradient))
      continue;
    made.places.push_back(place);
    made.slopes.emplace_back(dot(gradient, first), made.in_plane ? 0 : dot(gradient, second));
  }
  const auto frame = frame_of(made, stencil, at);
  if (!(frame.area > no_frame * length_of(frame.first) * length_of(frame.second)))
    return {};
  made.parts = frame.parts_of(gap);
  made.facing = frame.parts_of(normal);
  return made;
}

TurnedGap turn(std::span<const TieGap> gaps, const NodePlace& at, Stencil& stencil) {
  TurnedGap turned;
  if (gaps.empty())
    return turned;
  stencil.turning.assign(stencil.nodes.size(), Matrix3d::Zero());
  for (const auto& gap : gaps) {
    const auto frame = frame_of(gap, stencil, at);
    const auto vector = frame.vector_of(gap.parts);
    const auto derivatives = derivatives_of(frame, gap.parts);
    for (int row = 0; row < 3; ++row) {
      if (!gap.rows[static_cast<std::size_t>(row)])
        continue;
      turned.gap[row] = vector[row];
      for (std::size_t l = 0; l < gap.places.size(); ++l)
        for (int of = 0; of < stencil.components; ++of)
          stencil.turning[gap.places[l]](row, of) -=
              gap.slopes[l][0] * derivatives[0](row, of) + gap.slopes[l][1] * derivatives[1](row, of);
    }
    if (is_zero(turned.facing))
      turned.facing = frame.vector_of(gap.facing);
  }
  return turned;
}

} // namespace rubato::contact
