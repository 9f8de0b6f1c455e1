// SPDX-License-Identifier: LGPL-3.0-or-later
/// Says when contact springs, or gaps of points that press, take part of what a given way squeezes.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace rubato::run {

/// A penalty is in series with the bodies that it holds apart. Of what a given way squeezes, the springs take
/// the part of it that they have of the energy, and forces are too small by that part. Said once, at the end,
/// of the zone whose springs held most. Exact zones have no springs, but a law of velocities keeps the gap
/// that a point had when it closed: bodies are squeezed by so much less or more.
class SpringWatch {
public:
  /// Everything must outlive this.
  SpringWatch(const model::Model& model, const Watch& watch) : model_(model), watch_(watch) {}

  void note(const step::State& now, const step::EnergyLedger& ledger);
  /// At the end of the run.
  void tell() const;
  /// contact_springs of zones that have springs, closed_gaps of exact zones; ties have neither.
  std::vector<results::Plausibility> checks() const;

private:
  /// ½ Σ N |g| of a zone, and its point of the largest pressure.
  struct Held {
    double energy = 0; ///< [force · length]
    double t = 0;
    std::size_t zone = 0;
    mesh::NodeIndex node = -1;
    double depth = 0;     ///< of that point [length]
    double stiffness = 0; ///< of its spring, as a coefficient of its method
  };

  double part_of(const Held& held) const;
  std::string place_of(const Held& held) const;
  Held held_by(std::size_t zone, const step::State& now) const;

  const model::Model& model_;
  const Watch& watch_;
  double most_in_bodies_ = 0; ///< largest strain energy
  Held most_in_springs_, most_in_gaps_;
};

} // namespace rubato::run
