// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when bodies of small strain turn or stretch too far.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace rubato::run {

/// The largest strain that small strain takes: what it leaves out, ε²/2, is 1.2e-3 as at the largest angle
/// (model::largest_small_angle).
inline constexpr double largest_small_strain = 0.05;

/// Strains of `strain: small` are the symmetric part of ∂u/∂X. A body that turns by θ stretches by 1 − cos θ
/// in it, and what stretches by ε is off by ε²/2. Looks at every cell of such materials, in the middle of its
/// corners, where one of them may have come beyond since. Turns and stretches are each said once a run.
class StrainWatch {
public:
  /// Everything must outlive this.
  StrainWatch(const model::Model& model, const Watch& watch);

  /// `u`: displacements, one a dof.
  void note(double t, const Eigen::VectorXd& u);
  /// None where no material has small strain. Values are those of the instants at which cells were looked at.
  std::vector<results::Plausibility> checks() const;

private:
  struct Worst {
    double size = 0;
    std::size_t cell = 0; ///< index in the bulk's cells
    double t = 0;
  };

  struct Found {
    Worst turn, stretch;
  };
  struct Cell {
    std::size_t index = 0; ///< in the bulk's cells
    int corners = 0;
    double by_radius = 0; ///< axisymmetric: 1/r in the middle, else 0
  };

  void add(std::size_t cell);
  template <int D> Found worst_at(const Eigen::VectorXd& u) const;
  void tell_turn(double t, const Worst& turn);
  void tell_stretch(double t, const Worst& stretch);
  bool told_turn() const;
  bool told_stretch() const;
  const study::Material& material_of(std::size_t cell) const;

  const model::Model& model_;
  const Watch& watch_;
  std::vector<Cell> cells_;   ///< of small strain
  std::vector<int> dofs_;     ///< the first dof of each corner, cell after cell
  std::vector<float> slopes_; ///< ∂N_i/∂X of each corner, in the middle of its cell [1/length]
  double steepest_ = 0;       ///< largest Σ|∂N_i/∂X| of a cell [1/length]
  Eigen::VectorXd looked_at_; ///< u where all were looked at last
  double margin_ = 0;         ///< how far any dof may move from there before one can be beyond [length]
  Found largest_;             ///< so far; beyond its limit once it is told
};

} // namespace rubato::run
