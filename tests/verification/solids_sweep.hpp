// SPDX-License-Identifier: LGPL-3.0-or-later
/// Random variants of bodies that yield or stretch and touch: beams that rub, blocks that are squeezed and
/// slide, seals, rings, press fits and snap fits. Nothing is helped along: decks have neither newton nor
/// coefficients. The same seed gives the same variants everywhere.
#pragma once

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

/// What a family draws from; the number, family and title of the variant are filled in afterwards.
SolidVariant plastic_beams(Dice& dice);
SolidVariant stretched_beams(Dice& dice);
SolidVariant squeezed_block(Dice& dice);
SolidVariant seal_in_groove(Dice& dice);
SolidVariant squeezed_ring(Dice& dice);
SolidVariant press_fit(Dice& dice);
SolidVariant snap_fit(Dice& dice);

} // namespace rubato::verification
