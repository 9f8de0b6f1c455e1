// SPDX-License-Identifier: LGPL-3.0-or-later
/// Materials, contact and time of the variants of solids_sweep.hpp.
#pragma once

#include "verification/dice.hpp"
#include <string>

namespace rubato::verification {

struct DrawnMaterial {
  std::string keys;     ///< of an entry of `materials`, without density and cells
  std::string words;    ///< in short
  double young = 0;     ///< at small strain [force/length²]
  double yield = 0;     ///< 0: none [force/length²]
  double density = 0;   ///< [mass/length³]
  bool rubbery = false; ///< strains of any size
};

/// Steel in N, m, kg, s, with one of the hardening laws; `strain`: of the deck.
DrawnMaterial drawn_metal(Dice& dice, double young, double least_yield, double most_yield,
                          const std::string& strain, double density);
/// One of the hyperelastic laws, its shear modulus within the bounds.
DrawnMaterial drawn_rubber(Dice& dice, double least_shear, double most_shear, double density);
DrawnMaterial drawn_elastic(double young, double poisson, const std::string& more, double density);

/// An entry of `materials`; `cells`: empty for all.
std::string material_entry(const std::string& name, const DrawnMaterial& material,
                           const std::string& cells = "");

struct DrawnContact {
  std::string keys; ///< ", method: penalty" or none, ", friction: 0.2"
  std::string words;
  double friction = 0;
  bool exact = false; ///< neither springs of contact nor of friction
};

/// Two of three times what a deck has that says nothing of it. `rigid`: before an obstacle.
DrawnContact drawn_contact(Dice& dice, double most_friction, bool rigid = false);

/// "scheme: hht, alpha: -0.1", of the dynamic ones.
std::string drawn_scheme(Dice& dice, bool exact_contact);

} // namespace rubato::verification
