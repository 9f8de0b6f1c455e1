// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/mean_cell.hpp"

#include "rubato/element/nonlinear/bubble_cell.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::element {
namespace {

/// Rounding of the force on the bubble, relative to the largest stress that its strains could cause.
constexpr double rounding_of_bubble = 4 * std::numeric_limits<double>::epsilon();
/// Factor of that rounding that is accepted where no Newton step reduces the force.
constexpr double stalled_bubble = 1e3;

} // namespace

MeanCell::MeanCell(CellPoints& cell, CellGradients& gradients, bool wants_tangent)
    : cell_(cell), mean_(cell), modes_(mode_count(cell.kind)), wants_tangent_(wants_tangent) {
  if (modes_ == 0)
    return;
  put_bubble(cell.kind.type, cell.input.points, gradients);
  for (std::size_t q = 0; q < cell.at.seen.size(); ++q)
    of_nodes_[q] = cell.at.gradient[q];
  std::ranges::copy(cell.input.old.subspan(cell.law_states(), place(modes_)), unknowns_.begin());
}

CellResult MeanCell::solve() {
  if (modes_ == 0)
    return respond();
  auto result = solve_modes(
      cell_.input.modes.most_iterations, [&] { return respond(); }, [&] { return is_solved(); },
      [&] { return improved(); });
  result.mode_force = scale_;
  std::copy_n(unknowns_.begin(), modes_, cell_.output.now.subspan(cell_.law_states()).begin());
  return result;
}

void MeanCell::put_tangent(const MatrixView& k) {
  if (modes_ == 0)
    return put_stiffness(0, k);
  put_stiffness(0, whole());
  condense_modes(whole(), node_dofs(), modes_, k);
}

/// Evaluates the laws, P_c and the force on the bubble at the present α.
CellResult MeanCell::respond() {
  const bool wants_tangent = wants_tangent_ || modes_ > 0;
  if (modes_ > 0)
    for (std::size_t q = 0; q < cell_.at.seen.size(); ++q)
      add_bubble(q);
  auto result = mean_.see();
  if (result)
    result = cell_.respond(wants_tangent ? material::Want::tangent : material::Want::stress);
  if (!result)
    return result;
  mean_.set_conjugates(wants_tangent);
  if (modes_ > 0)
    set_residual();
  return result;
}

void MeanCell::add_bubble(std::size_t q) {
  auto& h = cell_.at.gradient[q];
  h = of_nodes_[q];
  const int point = static_cast<int>(q), bubble = cell_.gradients.nodes();
  for (int row = 0; row < cell_.gradients.rows(); ++row)
    for (int a = 0; a < d(); ++a)
      if (const int at = tensor_place(a, row, d()); at >= 0)
        h.data()[at] += cell_.gradients.at(point, row, bubble) * unknowns_[place(a)];
}

/// Sets the force on the bubble, its scale and its rounding.
void MeanCell::set_residual() {
  residual_.fill(0);
  scale_ = noise_ = 0;
  const int bubble = cell_.gradients.nodes();
  for (int q = 0; q < cell_.count(); ++q) {
    const auto& stress = cell_.at.conjugate[place(q)];
    const double weight = cell_.gradients.weight(q);
    double squares = 0;
    for (int row = 0; row < cell_.gradients.rows(); ++row) {
      const double g = cell_.gradients.at(q, row, bubble);
      squares += g * g;
      for (int a = 0; a < d(); ++a)
        if (const int at = tensor_place(a, row, d()); at >= 0)
          residual_[place(a)] += weight * stress.data()[at] * g;
    }
    const double size = weight * std::sqrt(squares);
    const double stiffness = cell_.at.response[place(q)].tangent.cwiseAbs().maxCoeff();
    scale_ += size * stress.norm();
    noise_ += rounding_of_bubble * size * (stiffness * of_nodes_[place(q)].norm() + stress.norm());
  }
}

bool MeanCell::is_solved() const {
  const double scale = std::max(scale_, cell_.input.modes.force);
  const double floor = is_stalled_ ? stalled_bubble * noise_ : noise_;
  return largest(residual_, modes_) <= std::max(cell_.input.modes.relative * scale, floor);
}

/// One step of Newton's method, halved while a law fails or the force, measured by K_αα⁻¹, grows.
CellResult MeanCell::improved() {
  put_stiffness(cell_.gradients.nodes(), whole());
  const ModeFactor factor(whole(), node_dofs(), modes_);
  return improve_modes(
      factor, modes_, unknowns_, is_stalled_, [&]() -> const ModeValues& { return residual_; },
      [&] { return respond(); }, [&] { return is_solved(); });
}

/// Sets K of the nodes from `first_node`, which is even, and of the bubble.
void MeanCell::put_stiffness(int first_node, const MatrixView& k) {
  const int last = cell_.gradients.nodes() + (modes_ > 0 ? 1 : 0);
  const auto size = place(cell_.count());
  const auto put = [&](auto moduli) {
    mean_.set_moduli(moduli);
    put_block_sums(cell_.gradients, moduli, first_node, last, k);
  };
  if (cell_.is_small()) {
    AtPoints<material::Tangent6> moduli;
    put(std::span(moduli).first(size));
  } else {
    AtPoints<Moduli> moduli;
    put(std::span(moduli).first(size));
  }
  add_dilatation(first_node * d(), k);
}

/// K += Σ_m (t_m⊗r_m + r_m⊗t_m) + Σ_mn c_mn t_m⊗t_n, the last term by halves.
void MeanCell::add_dilatation(int first_dof, const MatrixView& k) const {
  const auto& space = mean_.space();
  const auto along = mean_.along();
  const auto first = place(first_dof), size = place(all_dofs());
  std::array<Forces, static_cast<std::size_t>(most_dilatations)> change;
  for (int m = 0; m < space.size(); ++m)
    change[place(m)] = forces_of(mean_.change(), m);
  for (int m = 0; m < space.size(); ++m) {
    const auto& t = change[place(m)];
    auto r = forces_of(mean_.across(), m);
    for (int n = 0; n < space.size(); ++n)
      for (std::size_t i = first; i < size; ++i)
        r[i] += along(m, n) / 2 * change[place(n)][i];
    for (std::size_t j = first; j < size; ++j) {
      double* const column = k.column(static_cast<int>(j));
      for (std::size_t i = first; i < size; ++i)
        column[i] += t[i] * r[j] + r[i] * t[j];
    }
  }
}

/// Returns the forces of φ_m times the tensors of the points on nodes and bubble.
MeanCell::Forces MeanCell::forces_of(const AtPoints<Eigen::Matrix3d>& tensors, int m) const {
  const auto& gradients = cell_.gradients;
  const auto weighted = mean_.space().weighted(m, tensors);
  auto nodal = gradients.no_force();
  gradients.add_forces(std::span(weighted).first(place(cell_.count())), nodal);
  Forces forces;
  gradients.put(nodal, forces);
  if (modes_ == 0)
    return forces;
  std::fill_n(forces.begin() + node_dofs(), modes_, 0.);
  for (int q = 0; q < cell_.count(); ++q)
    for (int row = 0; row < gradients.rows(); ++row)
      for (int a = 0; a < d(); ++a)
        if (const int at = tensor_place(a, row, d()); at >= 0)
          forces[place(node_dofs() + a)] +=
              gradients.weight(q) * weighted[place(q)].data()[at] * gradients.at(q, row, gradients.nodes());
  return forces;
}

} // namespace rubato::element
