// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when groups of relations, and connectors, turn too far.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/references.hpp"
#include "rubato/model/springs.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/state.hpp"

#include <string>
#include <vector>

namespace rubato::run {

/// Rigid relations are linear, u = t + θ × r: a group that turns by θ becomes longer by θ²/2 across the axis.
/// The forces and supports of a distributed reference are shared out by the undeformed shape in the same way.
/// A connector along the way between its ends keeps the undeformed direction, unless it rotates.
/// Said once of each relation and connector.
class TurnWatch {
public:
  /// Everything must outlive this.
  TurnWatch(const model::Model& model, const Watch& watch);

  void note(const step::State& now);
  /// None without such relations and connectors.
  std::vector<results::Plausibility> checks() const;

private:
  struct Largest {
    double turn = 0; ///< [radians]; of what has turned too far, where that was found
    double t = 0;
    std::string where;
  };

  void note_relations(const step::State& now);
  void note_connectors(const step::State& now);

  const model::Model& model_;
  const Watch& watch_;
  std::vector<const model::Reference*> watched_;
  std::vector<const model::ConnectorWay*> ways_;
  Largest largest_;
};

} // namespace rubato::run
