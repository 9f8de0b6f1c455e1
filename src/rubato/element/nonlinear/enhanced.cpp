// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/enhanced.hpp"

#include "rubato/element/nonlinear/enhanced_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::element {
namespace {

/// What rounding leaves of a force by the largest stress that its strains could make.
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
/// Where no step makes forces on modes smaller, so much of rounding is an end.
constexpr double stalled_rounding = 1e3;

} // namespace

EnhancedCell::EnhancedCell(CellPoints& cell, CellGradients& gradients)
    : cell_(cell), modes_(mode_count(cell.kind)) {
  const auto& reference = reference_gradients(cell.kind.type);
  const auto ratios = put_modes(reference, cell.input.points, gradients);
  for (std::size_t q = 0; q < points(); ++q) {
    of_nodes_[q] = cell.at.gradient[q];
    const auto xi = reference.xi.col(static_cast<Eigen::Index>(q));
    volume_modes_[q] = Eigen::Vector3d(ratios[q] * (xi[0] * xi[1]), ratios[q] * (xi[1] * xi[2]),
                                       ratios[q] * (xi[2] * xi[0]));
  }
  std::ranges::copy(cell.input.old.subspan(cell.law_states(), place(modes_)), unknowns_.begin());
}

CellResult EnhancedCell::solve() {
  auto result = solve_modes(
      cell_.input.modes.most_iterations, [&] { return respond(); }, [&] { return is_solved(); },
      [&] { return improved(); });
  result.mode_force = scale_;
  std::copy_n(unknowns_.begin(), modes_, cell_.output.now.subspan(cell_.law_states()).begin());
  return result;
}

void EnhancedCell::put_tangent(const MatrixView& k) {
  set_blocks(0);
  condense_modes(whole(), node_dofs(), modes_, k);
}

template <int d> Eigen::Matrix3d EnhancedCell::strain_of_modes(int q) const {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  const double* const modes = cell_.gradients.row(q, 0) + nodes();
  const int stride = cell_.gradients.stride();
  unrolled<d>([&](auto row) {
    unrolled<d>([&](auto m) {
      const double mode = modes[row * stride + m];
      unrolled<d>([&](auto a) { h.data()[a + 3 * row] += mode * unknowns_[m * d + a]; });
    });
  });
  if (has_volume_modes())
    for (int a = 0; a < 3; ++a)
      h(a, a) += volume_modes_[place(q)][0] * unknowns_[9] + volume_modes_[place(q)][1] * unknowns_[10] +
                 volume_modes_[place(q)][2] * unknowns_[11];
  return h;
}

/// The stresses and moduli of the laws at the present unknowns.
CellResult EnhancedCell::respond() {
  for (std::size_t q = 0; q < points(); ++q) {
    const int point = static_cast<int>(q);
    const auto of_modes = d() == 3 ? strain_of_modes<3>(point) : strain_of_modes<2>(point);
    cell_.at.seen[q].h = cell_.at.gradient[q] = of_nodes_[q] + of_modes;
  }
  const auto result = cell_.respond(material::Want::tangent);
  if (result)
    set_residual();
  return result;
}

/// Forces on the modes, what they are compared with, and what rounding leaves of them.
void EnhancedCell::set_residual() {
  residual_.fill(0);
  ModeValues size{}, noise{};
  for (std::size_t q = 0; q < points(); ++q) {
    const int point = static_cast<int>(q);
    const auto mode_size = d() == 3 ? add_residual<3>(point) : add_residual<2>(point);
    const double stress = cell_.at.piola[q].norm();
    const double stiffness = cell_.at.response[q].tangent.cwiseAbs().maxCoeff();
    const double of_rounding = stiffness * of_nodes_[q].norm() + stress;
    for (std::size_t m = 0; m < size.size(); ++m) {
      size[m] += stress * mode_size[m];
      noise[m] += of_rounding * mode_size[m];
    }
  }
  scale_ = largest(size, modes_);
  noise_ = rounding * largest(noise, modes_);
}

/// Volume times the size of ∂H/∂α of each mode.
template <int d> ModeValues EnhancedCell::add_residual(int q) {
  ModeValues size{};
  const double weight = cell_.gradients.weight(q);
  const Eigen::Matrix3d weighted = weight * cell_.at.piola[place(q)];
  const double* const modes = cell_.gradients.row(q, 0) + nodes();
  const int stride = cell_.gradients.stride();
  unrolled<d>([&](auto m) {
    double squares = 0;
    unrolled<d>([&](auto row) {
      const double g = modes[row * stride + m];
      squares += g * g;
      unrolled<d>([&](auto a) { residual_[m * d + a] += weighted.data()[a + 3 * row] * g; });
    });
    const double of_mode = weight * std::sqrt(squares);
    unrolled<d>([&](auto a) { size[m * d + a] = of_mode; });
  });
  if (has_volume_modes())
    for (int m = 0; m < 3; ++m) {
      residual_[place(9 + m)] += weighted.trace() * volume_modes_[place(q)][m];
      size[place(9 + m)] = weight * std::abs(volume_modes_[place(q)][m]);
    }
  return size;
}

bool EnhancedCell::is_solved() const {
  const auto& modes_wanted = cell_.input.modes;
  const double scale = std::max(scale_, modes_wanted.force);
  const double floor = is_stalled_ ? stalled_rounding * noise_ : noise_;
  return largest(residual_, modes_) <= std::max(modes_wanted.relative * scale, floor);
}

/// One step of Newton's method, halved while a law fails or the forces, measured by K_αα⁻¹, grow.
CellResult EnhancedCell::improved() {
  set_blocks(nodes());
  const ModeFactor factor(whole(), node_dofs(), modes_);
  return improve_modes(
      factor, modes_, unknowns_, is_stalled_, [&]() -> const ModeValues& { return residual_; },
      [&] { return respond(); }, [&] { return is_solved(); });
}

/// K of nodes and modes from `first` on.
void EnhancedCell::set_blocks(int first) {
  if (!cell_.is_small()) {
    std::array<Moduli, most_points> memory;
    const auto moduli = std::span(memory).first(points());
    cell_.set_moduli(moduli);
    put_block_sums(cell_.gradients, moduli, first, all_nodes(), whole());
    return;
  }
  std::array<material::Tangent6, most_points> memory;
  const auto moduli = std::span(memory).first(points());
  cell_.set_moduli(moduli);
  put_block_sums(cell_.gradients, moduli, first, all_nodes(), whole());
  if (has_volume_modes())
    put_volume_modes(first, moduli);
}

/// Columns and rows of β, for nodes and modes from `first` on.
void EnhancedCell::put_volume_modes(int first, std::span<const material::Tangent6> moduli) {
  const auto all = whole();
  const int start = 3 * all_nodes();
  for (int m = 0; m < 3; ++m)
    std::fill_n(all.column(start + m), start + 3, 0.);
  for (std::size_t q = 0; q < points(); ++q) {
    const auto& tangent = moduli[q];
    material::Stress6 y;
    for (int i = 0; i < 6; ++i)
      y[i] = tangent(i, 0) + tangent(i, 1) + tangent(i, 2);
    const Eigen::Matrix3d tensor = tensor_of(y);
    const auto& modes = volume_modes_[q];
    const double* const g = cell_.gradients.row(static_cast<int>(q), 0);
    const int stride = cell_.gradients.stride();
    for (int i = first; i < all_nodes(); ++i)
      for (int a = 0; a < 3; ++a) {
        const double force =
            tensor(a, 0) * g[i] + tensor(a, 1) * g[stride + i] + tensor(a, 2) * g[2 * stride + i];
        for (int m = 0; m < 3; ++m)
          all(3 * i + a, start + m) += force * modes[m];
      }
    for (int m = 0; m < 3; ++m)
      for (int n = 0; n < 3; ++n)
        all(start + n, start + m) += tensor.trace() * modes[n] * modes[m];
  }
  for (int m = 0; m < 3; ++m)
    for (int i = 0; i < start; ++i)
      all(start + m, i) = all(i, start + m);
}

} // namespace rubato::element
