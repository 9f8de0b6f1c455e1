// SPDX-License-Identifier: LGPL-3.0-or-later
/// Seeded studies of bodies in contact, each run in several ways that must give the same answer.
///
/// A way is a list of changes of the deck, as by `--set`: contact points on the nodes, slave and master
/// swapped, another time scheme, half the step, the whole system in every iteration. Forces and moments of
/// zones, support forces, energies and probes of two ways are compared, and again on a finer mesh.
#pragma once

#include "rubato/deck/setting.hpp"
#include "rubato/mesh/mesh.hpp"

#include "verification/dice.hpp"
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rubato::verification {

/// How the nodes of a body are moved once its grid is made. Coordinates are relative to the rectangle of the
/// body: its width w, its height h.
enum class Form {
  tilt,       ///< turned by `amount` [radians], then lifted until the lowest node has the height it had
  ski,        ///< the bottom rises with the slope `amount` over the last third
  wedge,      ///< the bottom rises with the slope `amount` over the right half, half as steeply on the left
  crown,      ///< the bottom rises as a parabola to `amount` [length] at both ends
  crown_top,  ///< the top falls as a parabola by `amount` [length] at both ends
  slant,      ///< the right side leans: x grows by `amount` times the height above the bottom
  slant_back, ///< the left side leans likewise
  polar,      ///< x over `amount` is an angle [radians], clockwise, y a radius about the origin
  rounded     ///< square to disc, by the part `amount` of the way
};

struct Forming {
  std::string body;
  Form form = Form::tilt;
  double amount = 0;
  std::array<double, 2> from{}, to{}; ///< the rectangle [length]
};

struct ContactPair {
  std::string name, slave, master;
};

/// A study and what its ways need of it.
struct WayStudy {
  int number = 0;
  std::string family;
  std::string words; ///< everything that was drawn, in a line
  std::string deck;
  std::vector<Forming> forms;
  std::vector<ContactPair> pairs;
  std::string scheme; ///< "static", "hht" or "moreau_jean"
  double step = 0;    ///< [time]
  double arm = 0;     ///< length that moments are measured by [length]
  bool solid = false;
  int finest = 3;             ///< level that runs are made at
  bool fast_explicit = false; ///< explicit runs take seconds
  double stiff_spring = 0;    ///< k_n of explicit runs [force/length³]
};

/// Studies `first` to `first + count − 1` of a seed; families take turns.
std::vector<WayStudy> way_studies(std::uint32_t seed, int first, int count);

struct Way {
  std::string name;
  std::vector<deck::Setting> changes;
  bool swapped = false;
};

/// The way the deck has, then the other ones.
std::vector<Way> ways_of(const WayStudy& study);

/// The mesh of the study with every edge cut into `level` parts, formed.
void form(mesh::Mesh& mesh, const std::vector<Forming>& forms);

/// A column of a run, as its means over the quarters of the run.
struct Quantity {
  std::string name; ///< "joint.x"
  std::array<double, 4> mean{};
};

/// Quantities that are compared on one scale.
struct QuantityKind {
  std::string name; ///< "force", "moment", "energy", "displacement"
  double scale = 0; ///< largest magnitude at any instant
  std::vector<Quantity> quantities;
};

struct WayResult {
  std::string failure;               ///< why the run did not come to its end, or empty
  std::vector<std::string> warnings; ///< but those of the mesh alone, which every way has
  std::vector<QuantityKind> kinds;
  double seconds = 0;
  double friction_given = 0; ///< energy that friction gave, over the largest energy; a defect
  bool finished() const { return failure.empty(); }
};

/// Level k: every edge of the mesh in k parts, the step divided by k.
WayResult run_way(const WayStudy& study, const Way& way, int level);

struct WayDifference {
  double size = 0; ///< over the scale of its kind, the larger one of both runs
  std::string quantity;
};

/// The largest difference of two runs that came to their ends.
WayDifference largest_difference(const WayResult& a, const WayResult& b);

/// What a study's ways differ by.
struct Comparison {
  std::string way;
  std::string failure;       ///< of one of the runs, or empty
  WayDifference coarse;      ///< from the way of the deck
  double fine = -1;          ///< the same at level 2; −1: was not asked for
  double finest = -1;        ///< the same at level 4, where level 2 does not explain it
  double friction_given = 0; ///< the larger one of the two runs
  bool warned = false;       ///< one of the two runs has a warning
  std::vector<std::string> warnings;
  bool large() const;     ///< above 2 %
  bool explained() const; ///< refinement takes it away, or shrinks it as an error of first order
};

struct StudyComparison {
  std::vector<Comparison> ways;
  double seconds = 0;
  int runs = 0;
};
StudyComparison compare_ways(const WayStudy& study);

} // namespace rubato::verification
