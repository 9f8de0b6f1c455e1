// SPDX-License-Identifier: LGPL-3.0-or-later
/// The numbers, other than the user's, that decide when a step ends and what stands in its answer. Numbers
/// that only choose a way there are where they are used.
#pragma once

#include <array>
#include <limits>
#include <string_view>

namespace rubato {

struct Tolerances {
  // When a step has converged, beside the residual:

  /// Motion of a projection between two iterates, in reference lengths (Code_Aster's RESI_GEOM for Newton).
  double settled_projection = 1e-6;
  double closed_gap = 1e-9; ///< of a point in contact, in edges of its zone
  /// Units in the last digit of the largest term that a sum of forces may be off by.
  double rounding_units = 16;
  double free_body_residual = 1e-4; ///< of bodies that only contact holds, in parts of newton.residual
  /// Of an equation's entries, in parts of the largest one: below it the equation says nothing, as between
  /// parts that are held.
  double empty_row = 1e-13;

  // Which points face each other and touch:

  /// Penetration below which an open point stays open: rounding makes that much. In edges.
  double closing_gap = 1e-11;
  double touching_gap = 1e-9; ///< below which a point touches when a step of velocities begins, in edges
  /// How far outside its face a point still faces it, in parts of the face, where the zone does not say.
  double paired_overshoot = 0.25;
  /// Beyond which a point held on a face is released, likewise. Places are settled to that.
  double released_overshoot = 1e-6;

  // Coefficients that are chosen where the deck gives none:

  double saturation_slip = 2e-3;  ///< at which friction saturates, in edges
  double penalty_stiffening = 10; ///< penalties in units of the augmentation
  /// Springs of friction in units of what the node resists. With stiffer ones points that slip look as if
  /// they stuck in every other iteration.
  double friction_spring_share = 0.1;
  /// Squares of the frequencies of explicit springs over the bulk's highest. With matching surfaces they
  /// shorten the stable step by a sixth.
  double explicit_spring_share = 0.1;

  /// Of a sum, relative.
  constexpr double rounding() const { return rounding_units * std::numeric_limits<double>::epsilon(); }
};

inline constexpr Tolerances tolerances{};

struct NamedTolerance {
  std::string_view name;
  double Tolerances::*value;
};

/// For the echo in the results.
inline constexpr std::array named_tolerances{
    NamedTolerance{"settled_projection", &Tolerances::settled_projection},
    NamedTolerance{"closed_gap", &Tolerances::closed_gap},
    NamedTolerance{"rounding_units", &Tolerances::rounding_units},
    NamedTolerance{"free_body_residual", &Tolerances::free_body_residual},
    NamedTolerance{"empty_row", &Tolerances::empty_row},
    NamedTolerance{"closing_gap", &Tolerances::closing_gap},
    NamedTolerance{"touching_gap", &Tolerances::touching_gap},
    NamedTolerance{"paired_overshoot", &Tolerances::paired_overshoot},
    NamedTolerance{"released_overshoot", &Tolerances::released_overshoot},
    NamedTolerance{"saturation_slip", &Tolerances::saturation_slip},
    NamedTolerance{"penalty_stiffening", &Tolerances::penalty_stiffening},
    NamedTolerance{"friction_spring_share", &Tolerances::friction_spring_share},
    NamedTolerance{"explicit_spring_share", &Tolerances::explicit_spring_share},
};

} // namespace rubato
