// SPDX-License-Identifier: LGPL-3.0-or-later
/// The surface compliance S of a body whose surface is eliminated within it, block by block.
#pragma once

#include "rubato/linalg/surface_in_factor.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::step {

/// S between two blocks of neighbouring positions is computed when first asked for, and kept as long as all
/// that is kept takes no more memory than was counted for it (SurfaceInFactor::most_formed). Its digits do
/// not depend on what was asked for before, so that a resumed run has the same ones.
class BlockCompliance {
public:
  /// S is not meant to be formed whole. `surface` must outlive this. `most_bytes`: from where on what is kept
  /// is forgotten when more is asked for.
  BlockCompliance(const linalg::SurfaceInFactor& surface, std::size_t most_bytes);
  explicit BlockCompliance(const linalg::SurfaceInFactor& surface)
      : BlockCompliance(surface, surface.bytes_of_compliance()) {}

  /// The surface's factor has other values: all of S is to be computed again.
  void forget();
  /// S between these positions of the body goes into `s`.
  void between(std::span<const int> positions, Eigen::MatrixXd& s);
  /// How far a unit force at a position moves it.
  double own(int position);
  /// d += factor S force, one a position each.
  void add(double factor, const Eigen::Ref<const Eigen::VectorXd>& force,
           Eigen::Ref<Eigen::VectorXd> d) const;

private:
  /// Neighbours in a list of positions that belong to one block.
  struct Run {
    std::size_t block = 0;
    std::size_t first = 0; ///< in the list
    std::size_t count = 0;
  };
  void make_room();
  void count(const Eigen::MatrixXd& kept);
  std::vector<Run> runs_of(std::span<const int> positions) const;
  const Eigen::MatrixXd& half_way(std::size_t block);
  const Eigen::MatrixXd& block(std::size_t row, std::size_t column);

  const linalg::SurfaceInFactor& surface_;
  std::size_t most_bytes_;
  std::size_t bytes_ = 0;                            ///< of half_way_ and blocks_
  std::vector<std::size_t> block_of_;                ///< by position
  std::vector<Eigen::MatrixXd> half_way_;            ///< by block; empty until used
  std::vector<std::vector<Eigen::MatrixXd>> blocks_; ///< by row and column ≤ row; empty until used
};

} // namespace rubato::step
