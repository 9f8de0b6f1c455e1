// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far parts of a study rotate.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::study {

/// Bodies of small strain that rotate stretch: by 1 − cos θ, at this angle by 1.2e-3 [radians].
inline constexpr double largest_small_angle = 0.05;

/// Whether bodies keep their size however far they rotate.
bool takes_large_rotations(const Study& study);

struct AngleAt {
  double angle = 0; ///< [radians]
  double t = 0;
};

/// The angle of the largest magnitude at the instants of the run that are known before it: those of its
/// steps, 1000 where it finds their length itself, at most 100,000. The run must have a length > 0. Throws
/// InputError where the angle is no finite number or cannot be integrated.
AngleAt largest_angle(const Rotation& rotation, const Study& study);

} // namespace rubato::study
