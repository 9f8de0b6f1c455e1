// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far an iteration may move surfaces of bodies that only contact holds: as far as frames that were
/// measured before the move still tell about.
#pragma once

#include "rubato/model/fwd.hpp"

#include <Eigen/Core>

namespace rubato::step {

struct EffectiveSystem;

class Reach {
public:
  /// Moves at most so far [length]; infinite: any move is taken.
  explicit Reach(double most) : most_(most), allowed_(most) {}

  /// The part of a move to take, `more` being allowed on top of the reach. Moves that turn back halve the
  /// reach, others double it again.
  double part_of(const Eigen::VectorXd& move, double more = 0);
  double most() const { return most_; }
  void start() { *this = Reach(most_); }

private:
  double most_;
  double allowed_;
  Eigen::VectorXd last_;
};

/// The shortest edge of any contact zone [length]; infinite without zones.
double finest_edge(const model::Model& model);

/// Largest moves of the surfaces of bodies that only contact holds, by half an edge of the finest zone;
/// infinite where there are none.
Reach reach_of(const model::Model& model, const EffectiveSystem& system);

} // namespace rubato::step
