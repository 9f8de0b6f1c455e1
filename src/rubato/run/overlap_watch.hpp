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

/// A slave point that was in front of its master, or no deeper behind it than half a face, and lies deeper
/// than a whole face after the step: it came too far in one step, or its spring is too soft. Results from
/// there on may be wrong, up to bodies that pass through each other. And a master node that came to lie
/// behind the slave by more than half of its own edges, and more than the slave's points do behind the
/// master: the slave's faces are too large to feel it. Said once a run, the latter only where the former was
/// not. In explicit runs also, once a run, a slave point that comes onto the master from beyond its border
/// and lies behind it by more than a fiftieth of a face.
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
