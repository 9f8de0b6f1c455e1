// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/compliance.hpp"

#include <algorithm>

namespace rubato::step {
namespace {

/// Right-hand sides solved together: enough for matrix–matrix products, little enough memory.
constexpr std::size_t block_size = 128;

} // namespace

Compliance::Compliance(linalg::CholeskyFactor factor, std::vector<int> surface,
                       std::span<const int> free_dofs, Eigen::Index dofs)
    : factor_(std::move(factor)), surface_(std::move(surface)),
      positions_(static_cast<std::size_t>(dofs), -1), size_(static_cast<Eigen::Index>(free_dofs.size())),
      columns_(surface_.size()) {
  for (const int unknown : surface_) {
    const int dof = free_dofs[static_cast<std::size_t>(unknown)];
    positions_[static_cast<std::size_t>(dof)] = static_cast<int>(dofs_.size());
    dofs_.push_back(dof);
  }
}

Eigen::MatrixXd Compliance::between_unknowns(std::span<const int> unknowns) {
  std::vector<int> positions;
  positions.reserve(unknowns.size());
  for (const int unknown : unknowns)
    positions.push_back(static_cast<int>(std::ranges::lower_bound(surface_, unknown) - surface_.begin()));
  return between(positions);
}

Eigen::MatrixXd Compliance::between(std::span<const int> positions) {
  prepare(positions);
  const auto size = static_cast<Eigen::Index>(positions.size());
  Eigen::MatrixXd s(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const auto& column = columns_[static_cast<std::size_t>(positions[static_cast<std::size_t>(j)])];
    for (Eigen::Index i = 0; i < size; ++i)
      s(i, j) = column[positions[static_cast<std::size_t>(i)]];
  }
  return s;
}

void Compliance::add(double factor, std::span<const int> positions, std::span<const double> force,
                     Eigen::VectorXd& d) {
  prepare(positions);
  for (std::size_t i = 0; i < positions.size(); ++i)
    d += factor * force[i] * columns_[static_cast<std::size_t>(positions[i])];
}

void Compliance::add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d) {
  std::vector<int> loaded;
  std::vector<double> loads;
  for (Eigen::Index i = 0; i < force.size(); ++i)
    if (force[i] != 0) {
      loaded.push_back(static_cast<int>(i));
      loads.push_back(force[i]);
    }
  add(factor, loaded, loads, d);
}

void Compliance::prepare(std::span<const int> positions) {
  std::vector<std::size_t> missing;
  for (const int position : positions)
    if (columns_[static_cast<std::size_t>(position)].size() == 0)
      missing.push_back(static_cast<std::size_t>(position));
  for (std::size_t first = 0; first < missing.size(); first += block_size) {
    const auto count = std::min(block_size, missing.size() - first);
    Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(size_, static_cast<Eigen::Index>(count));
    for (std::size_t j = 0; j < count; ++j)
      loads(surface_[missing[first + j]], static_cast<Eigen::Index>(j)) = 1;
    const Eigen::MatrixXd moved = factor_.solve(loads);
    for (std::size_t j = 0; j < count; ++j)
      columns_[missing[first + j]] = moved.col(static_cast<Eigen::Index>(j))(surface_);
  }
}

} // namespace rubato::step
