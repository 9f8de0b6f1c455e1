// SPDX-License-Identifier: LGPL-3.0-or-later
// How stiff the cells are, without a matrix of the whole.
#include "rubato/cell/height.hpp"
#include "rubato/domain/cell_rates.hpp"
#include "rubato/domain/law_path.hpp"
#include "rubato/domain/nonlinear_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::domain {

using Eigen::VectorXd;

namespace {

/// Symmetric, of which the lower triangle counts: a[row][column].
using Tensor = std::array<std::array<double, 3>, 3>;

/// By the roots of the characteristic polynomial of the scaled deviator.
double largest_eigenvalue(Tensor a) {
  const double mean = (a[0][0] + a[1][1] + a[2][2]) / 3;
  double scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i][i] -= mean;
    for (std::size_t j = 0; j <= i; ++j)
      scale = std::max(scale, std::abs(a[i][j]));
  }
  if (!(scale > 0))
    return mean;
  for (auto& row : a)
    for (double& value : row)
      value /= scale;
  const double c0 = a[0][0] * a[1][1] * a[2][2] + 2 * a[1][0] * a[2][0] * a[2][1] -
                    a[0][0] * a[2][1] * a[2][1] - a[1][1] * a[2][0] * a[2][0] - a[2][2] * a[1][0] * a[1][0];
  const double c1 = a[0][0] * a[1][1] - a[1][0] * a[1][0] + a[0][0] * a[2][2] - a[2][0] * a[2][0] +
                    a[1][1] * a[2][2] - a[2][1] * a[2][1];
  const double third = (a[0][0] + a[1][1] + a[2][2]) / 3;
  const double square = std::max(0.0, (3 * third * third - c1) / 3);
  const double half = 0.5 * (c0 + third * (2 * third * third - c1));
  const double q = std::max(0.0, square * square * square - half * half);
  const double angle = std::atan2(std::sqrt(q), half) / 3;
  return (third + 2 * std::sqrt(square) * std::cos(angle)) * scale + mean;
}

/// The largest one of the waves, each with one direction of displacement; without waves ‖K_e‖. `stiffness`
/// has `size` columns.
double stiffness_of_waves(const Eigen::MatrixXd& waves, const double* stiffness, Eigen::Index size) {
  if (waves.cols() == 0)
    return Eigen::Map<const VectorXd>(stiffness, size * size).norm();
  const auto d = size / waves.rows();
  double largest = 0;
  for (Eigen::Index wave = 0; wave < waves.cols(); ++wave) {
    Tensor sum{};
    for (Eigen::Index j = 0; j < waves.rows(); ++j)
      for (Eigen::Index i = 0; i < waves.rows(); ++i) {
        const double share = waves(i, wave) * waves(j, wave);
        const double* const block = stiffness + j * d * size + i * d;
        for (Eigen::Index b = 0; b < d; ++b)
          for (Eigen::Index a = b; a < d; ++a)
            sum[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] += share * block[b * size + a];
      }
    largest = std::max(largest, largest_eigenvalue(sum));
  }
  return largest;
}

} // namespace

/// Cells without mass are held: they do not vibrate.
void NonlinearCells::find_rates(const mesh::Mesh& mesh, const Bulk& bulk,
                                std::span<const double> mass_factors) {
  rates_.reserve(cells_.size());
  for (const auto& cell : cells_) {
    Rate rate;
    if (group_of(cell).kind.strain != element::StrainKind::small) {
      const auto vibration = vibration_of(mesh, bulk, cell.place);
      rate.stiffness =
          stiffness_of_waves(group_of(cell).waves, vibration.stiffness.data(), vibration.stiffness.rows());
      if (vibration.mass.minCoeff() > 0)
        rate.lambda = vibration.bound() / (mass_factors.empty() ? 1 : mass_factors[cell.place]);
    }
    rates_.push_back(rate);
  }
}

double NonlinearCells::growth_of_cell(std::size_t i, const Motion& motion, double rate,
                                      Scratch& scratch) const {
  const auto& cell = cells_[i];
  const auto kind = group_of(cell).kind.strain;
  if (kind == element::StrainKind::small) // no law is stiffer than at first
    return 0;
  const bool by_shape = kind == element::StrainKind::logarithmic;
  if (motion.heat != nullptr && !by_shape)
    motion.heat->put_free_strains(cell.place, scratch.temperatures, group_of(cell).expansion, scratch.free);
  const double own = by_shape ? growth_of_shape(cell, motion.u, motion.path, scratch)
                              : growth_of_tangent(i, motion.u, motion.states, scratch);
  const double part = rates_[i].lambda / rate;
  const bool bounded = !by_shape && group_of(cell).waves.cols() == 0;
  return own * (bounded ? part : std::min(1.0, part));
}

/// Cells that are turned inside out, or nearly so, are left to their next evaluation, which fails: steps do
/// not become so short that they never come there.
double NonlinearCells::growth(const VectorXd& u, const QuadratureStates& states, const LawPath& path,
                              double rate, const Heat* heat, double t) const {
  const Motion motion{u, states, path, heat};
  Scratch first;
  if (heat != nullptr)
    first.temperatures = heat->temperatures(t);
  std::vector<Scratch> scratches(static_cast<std::size_t>(shares_.count()), first);
  std::vector<double> growths(scratches.size(), 0.0);
  shares_.each([&](int s, std::size_t i) {
    const auto share = static_cast<std::size_t>(s);
    growths[share] = std::max(growths[share], growth_of_cell(i, motion, rate, scratches[share]));
  });
  const double growth = std::ranges::max(growths);
  constexpr double most = 1e6; // steps a thousandth as long
  return std::min(growth, most);
}

namespace {

/// Not below the largest principal stress.
double magnitude(const material::Stress6& stress) {
  return std::sqrt(stress.squaredNorm() + stress.tail<3>().squaredNorm());
}

} // namespace

/// (l₀/l)² (1 + 2 max |T|/D₀). The moduli of logarithmic strain are those of the law, which are never larger
/// than at first, and stresses: along a principal direction ρ₀c² = D − T (docs/theory/explicit.md).
double NonlinearCells::growth_of_shape(const Cell& cell, const VectorXd& u, const LawPath& path,
                                       Scratch& scratch) const {
  const auto& group = group_of(cell);
  const auto places = std::span(points_).subspan(cell.first_node, static_cast<std::size_t>(group.nodes));
  scratch.places.assign(places.begin(), places.end());
  for (std::size_t n = 0; n < places.size(); ++n)
    scratch.places[n].head(components_) += u.segment(dofs_[cell.first_node + n], components_);
  const double height = cell::least_height(group.kind.type, scratch.places);
  if (!(height > 0))
    return 0;
  double stress = 0;
  for (const auto& point :
       std::span(path.points).subspan(cell.first_follow, static_cast<std::size_t>(group.points)))
    stress = std::max(stress, magnitude(point.stress));
  const double thinner = cell::least_height(group.kind.type, places) / height;
  return thinner * thinner * (1 + 2 * stress / group.first.stiffness.diagonal().head<2>().minCoeff());
}

/// Of the waves of now over those at first; of cells without waves ‖K_e‖ over that at first.
double NonlinearCells::growth_of_tangent(std::size_t i, const VectorXd& u, const QuadratureStates& states,
                                         Scratch& scratch) const {
  const auto& cell = cells_[i];
  const auto& group = group_of(cell);
  gather(cell, u, scratch.displacement);
  scratch.force.resize(scratch.displacement.size());
  scratch.tangent.resize(scratch.displacement.size() * scratch.displacement.size());
  scratch.states.resize(group.state_size);
  const element::CellInput input{
      std::span(points_).subspan(cell.first_node, static_cast<std::size_t>(group.nodes)),
      scratch.displacement,
      std::span(states.values).subspan(cell.first_state, group.state_size),
      {},
      {},
      scratch.free};
  if (!element::evaluate(group.kind, element::PointLaws(group.law), input,
                         {scratch.states, scratch.force, scratch.tangent}))
    return 0;
  const auto size = static_cast<Eigen::Index>(scratch.displacement.size());
  return stiffness_of_waves(group.waves, scratch.tangent.data(), size) / rates_[i].stiffness;
}

} // namespace rubato::domain
