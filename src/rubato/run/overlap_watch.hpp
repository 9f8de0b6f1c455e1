// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when surfaces have come deep into each other within a step.
#pragma once

#include "rubato/contact/buried_nodes.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/state.hpp"

#include <vector>

namespace rubato::run {

/// A master whose nodes are looked at.
struct BuriedMaster {
  std::size_t zone = 0;
  std::vector<double> limits; ///< by position in its nodes, the depth from which on one is buried [length]
  contact::BuriedNodes nodes;
};

/// Warns of deep overlaps, each kind once a run. A slave point lies deeper than a whole face after a step
/// before which it lay at most half a face deep: the step was too long, or the spring is too soft. Bodies may
/// then pass through each other. A master node lies behind the slave by more than half of its own edges, and
/// deeper than the slave's points behind the master: the slave's faces are too large for it. This warning
/// comes only without the former. In explicit runs also, once a run, a slave point that comes onto the master
/// from beyond its border and lies behind it by more than a fiftieth of a face.
class OverlapWatch {
public:
  /// Everything must outlive this.
  OverlapWatch(const model::Model& model, const Watch& watch);

  void note(const step::State& before, const step::State& now);

private:
  void note_from_beyond(const step::State& before, const step::State& now);
  void note_buried(const step::State& before, const step::State& now);

  const model::Model& model_;
  const Watch& watch_;
  std::vector<BuriedMaster> masters_; ///< those that could lie unfelt behind their slave
  bool warned_ = false, buried_ = false, from_beyond_ = false;
};

} // namespace rubato::run
