// SPDX-License-Identifier: LGPL-3.0-or-later
/// Random variants of bodies that yield or stretch and touch: beams that rub, blocks that are squeezed and
/// slide, seals, rings, press fits and snap fits. Nothing is helped along: decks have neither newton nor
/// coefficients. The same seed gives the same variants everywhere.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/run/run_study.hpp"

#include "verification/dice.hpp"
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {

/// What becomes of the generated mesh. `polar`: x is an angle [radians], clockwise, y a radius. `rounded`:
/// the square of half side `Shape::half` about `Shape::x`, 0 gets rounder.
enum class Mapping { none, polar, rounded };

struct Shape {
  Mapping mapping = Mapping::none;
  double x = 0;
  double half = 0;
};

struct SolidVariant {
  int number = 0;
  std::string family;
  std::string words; ///< everything that was drawn, in a line
  int steps = 0;     ///< wanted
  Shape shape;
  std::string deck;
};

/// Variants `first` to `first + count − 1` of a seed.
std::vector<SolidVariant> solid_variants(std::uint32_t seed, int first, int count);

/// Where a node of the generated mesh is put.
std::array<double, 2> placed(const Shape& shape, double x, double y);

struct SolidSurvival {
  run::RunResult result;
  std::string failure;     ///< why it did not come to its end, or empty
  int bulk_iterations = 0; ///< of all attempts, cut ones included
  int factorisations = 0;  ///< likewise
  double balance = 0;      ///< largest, over the largest energy
  double plastic = 0;      ///< plastic work, over the largest energy
  double penetration = 0;  ///< of exact contact at the end, but by moreau_jean, over the size of the mesh
  double tension = 0;      ///< of contact at the end, over its largest pressure
  bool finished() const { return failure.empty(); }
};

/// Runs a variant in a folder that is gone afterwards. It is given up when it has tried far more steps than
/// it has. `changes` are laid over the deck as by `--set`.
SolidSurvival survive(const SolidVariant& variant, const std::vector<deck::Setting>& changes = {});

/// What a family draws from; the number, family and title of the variant are filled in afterwards.
SolidVariant plastic_beams(Dice& dice);
SolidVariant stretched_beams(Dice& dice);
SolidVariant squeezed_block(Dice& dice);
SolidVariant seal_in_groove(Dice& dice);
SolidVariant squeezed_ring(Dice& dice);
SolidVariant press_fit(Dice& dice);
SolidVariant snap_fit(Dice& dice);

} // namespace rubato::verification
