// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/compliance.hpp"

#include <algorithm>

namespace rubato::step {
namespace {

/// Right-hand sides solved together: enough for matrix–matrix products, little enough memory.
constexpr std::size_t block_size = 32;

} // namespace

Compliance::Compliance(linalg::CholeskyFactor factor, std::vector<int> surface, Eigen::Index unknowns)
    : factor_(std::move(factor)), surface_(std::move(surface)), size_(unknowns), columns_(surface_.size()) {}

Eigen::MatrixXd Compliance::between(std::span<const int> unknowns) {
  std::vector<int> positions;
  positions.reserve(unknowns.size());
  for (const int unknown : unknowns)
    positions.push_back(static_cast<int>(std::ranges::lower_bound(surface_, unknown) - surface_.begin()));
  compute_missing(positions);
  Eigen::MatrixXd s(static_cast<Eigen::Index>(positions.size()), static_cast<Eigen::Index>(positions.size()));
  for (std::size_t j = 0; j < positions.size(); ++j)
    s.col(static_cast<Eigen::Index>(j)) = columns_[static_cast<std::size_t>(positions[j])](positions);
  return s;
}

void Compliance::compute_missing(std::span<const int> positions) {
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
