// SPDX-License-Identifier: LGPL-3.0-or-later
/// Statuses that alternate from step to step, pressures that oscillate from node to node.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/step/state.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace rubato::run {

/// Of exact zones that are no ties.
class PressureWatch {
public:
  /// The model must outlive this.
  explicit PressureWatch(const model::Model& model);

  /// Takes the statuses of a step.
  void note(const step::State& before, const step::State& now);
  /// Takes the pressures of neighbouring nodes, which costs more.
  void note_pressures(const step::State& now);
  std::vector<results::Plausibility> checks() const;

private:
  struct Worst {
    double value = 0;
    double t = 0;
    std::size_t zone = 0;
    mesh::NodeIndex node = -1;
  };

  std::string place_of(const Worst& worst) const;

  const model::Model& model_;
  std::vector<std::vector<std::uint16_t>> changes_;   ///< by zone and point: steps in a row that changed it
  std::vector<std::vector<std::vector<int>>> around_; ///< by zone: neighbours of each slave node, by position
  Worst changing_, oscillation_;
  bool any_exact_ = false;
};

} // namespace rubato::run
