// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far bodies of a study may rotate.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::study {

/// Bodies of small strain that rotate stretch by 1 − cos of the angle, by 1.2e-3 at this one [radians].
inline constexpr double largest_small_angle = 0.05;

/// Whether bodies keep their size however far they rotate.
bool takes_large_rotations(const Study& study);

} // namespace rubato::study
