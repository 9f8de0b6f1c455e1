// SPDX-License-Identifier: LGPL-3.0-or-later
/// Random variants of the two beams of SDNL140: steps, friction, loads, meshes, gaps, schemes and methods as
/// nobody would choose them all, with nothing helped along. The same seed gives the same variants everywhere.
#pragma once

#include "rubato/run/run_study.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::verification {

struct Variant {
  int number = 0;
  std::string cells;  ///< "quad4"
  std::string scheme; ///< words of the deck
  std::string method;
  std::string words; ///< everything that was drawn, in a line
  bool refined = false;
  bool overlaps = false; ///< bodies that begin inside one another bring an energy of their own
  bool massless = false; ///< contact surfaces have no mass
  bool matching = false; ///< node on node where they touch
  bool safe = false;     ///< pressures cannot give energy by the scheme's nature
  int steps = 0;         ///< wanted
  std::string deck;
};

enum class Meshes { coarse, any };

/// Where the contact points of a family of variants stand. `mortar`: cells of every kind, and slaves above or
/// below; `nodes`: linear cells, and nodal methods as well.
enum class Integration { nodes, mortar };

/// Variants `first` to `first + count − 1` of a seed. `coarse`: none is refined, and all are short.
std::vector<Variant> variants(std::uint32_t seed, int first, int count, Meshes meshes = Meshes::any,
                              Integration integration = Integration::nodes);

/// A variant of mortar contact with its points on the slave nodes.
Variant by_nodes(const Variant& variant);

struct Survival {
  run::RunResult result;
  std::string failure;     ///< why it did not come to its end, or empty
  double gain = 0;         ///< largest energy from nowhere, over the largest energy
  double contact_gain = 0; ///< largest that contact pressures gave more than they took, likewise
  bool warned = false;     ///< of a gain that was not soon given up again
  double balance = 0;      ///< largest, over the largest energy
  bool finished() const { return failure.empty(); }
  /// More than 1 % of the largest energy of the whole run, and not soon given up again.
  bool keeps_gain() const { return warned && std::max(gain, contact_gain) > 0.01; }
};

/// Runs a variant in a folder that is gone afterwards. It is given up when it has tried far more steps than
/// it has.
Survival survive(const Variant& variant);

/// A variant solved condensed and whole, both to a sharper residual.
struct SolverComparison {
  /// Largest difference of the tips' histories, at the instants that both have, over their largest
  /// displacement; negative when one of them did not come to its end.
  double difference = -1;
  int steps_condensed = 0;
  int steps_whole = 0;
  bool same_steps = false; ///< neither cuts a step that the other takes whole
};
SolverComparison compare_solvers(const Variant& variant);

} // namespace rubato::verification
