// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/block_compliance.hpp"

#include <utility>

namespace rubato::step {

using Eigen::Index;
using Eigen::MatrixXd;

BlockCompliance::BlockCompliance(const linalg::SurfaceInFactor& surface, std::size_t most_bytes)
    : surface_(surface), most_bytes_(most_bytes) {
  const auto& starts = surface.block_starts();
  half_way_.resize(starts.size() - 1);
  blocks_.resize(starts.size() - 1);
  for (std::size_t b = 0; b + 1 < starts.size(); ++b)
    block_of_.insert(block_of_.end(), static_cast<std::size_t>(starts[b + 1] - starts[b]), b);
}

void BlockCompliance::forget() {
  for (auto& columns : half_way_)
    columns.resize(0, 0);
  for (auto& of_row : blocks_)
    of_row.clear();
  bytes_ = 0;
}

void BlockCompliance::make_room() {
  if (bytes_ > most_bytes_)
    forget();
}

void BlockCompliance::count(const MatrixXd& kept) {
  bytes_ += static_cast<std::size_t>(kept.size()) * sizeof(double);
}

/// Entries on both sides of the diagonal are read from the lower triangle.
void BlockCompliance::between(std::span<const int> positions, MatrixXd& s) {
  make_room();
  const auto size = static_cast<Index>(positions.size());
  s.resize(size, size);
  const auto runs = runs_of(positions);
  const auto& starts = surface_.block_starts();
  for (const auto& a : runs)
    for (const auto& b : runs) {
      if (a.block < b.block || (a.block == b.block && a.first < b.first))
        continue;
      const auto& values = block(a.block, b.block);
      for (std::size_t j = b.first; j < b.first + b.count; ++j)
        for (std::size_t i = a.first; i < a.first + a.count; ++i) {
          Index row = positions[i] - starts[a.block];
          Index column = positions[j] - starts[b.block];
          if (a.block == b.block && row < column)
            std::swap(row, column);
          s(static_cast<Index>(i), static_cast<Index>(j)) = s(static_cast<Index>(j), static_cast<Index>(i)) =
              values(row, column);
        }
    }
}

double BlockCompliance::own(int position) {
  make_room();
  const auto b = block_of_[static_cast<std::size_t>(position)];
  const Index place = position - surface_.block_starts()[b];
  return block(b, b)(place, place);
}

void BlockCompliance::add(double factor, const Eigen::Ref<const Eigen::VectorXd>& force,
                          Eigen::Ref<Eigen::VectorXd> d) const {
  if (!force.isZero(0))
    d += factor * surface_.moved_by(force);
}

std::vector<BlockCompliance::Run> BlockCompliance::runs_of(std::span<const int> positions) const {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const auto block = block_of_[static_cast<std::size_t>(positions[i])];
    if (runs.empty() || runs.back().block != block)
      runs.push_back({block, i, 0});
    ++runs.back().count;
  }
  return runs;
}

const MatrixXd& BlockCompliance::half_way(std::size_t block) {
  auto& columns = half_way_[block];
  if (columns.size() == 0) {
    columns = surface_.half_way_of(block);
    count(columns);
  }
  return columns;
}

/// Row not before column.
const MatrixXd& BlockCompliance::block(std::size_t row, std::size_t column) {
  auto& of_row = blocks_[row];
  if (of_row.empty())
    of_row.resize(row + 1);
  auto& values = of_row[column];
  if (values.size() == 0) {
    values = surface_.compliance(row, half_way(row), column, half_way(column));
    count(values);
  }
  return values;
}

} // namespace rubato::step
