// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bounds of the numbers that no row of a table has: the rules and the deck's grammar read them here.
#pragma once

#include "rubato/study/range.hpp"

namespace rubato::study::bounds {

inline constexpr Range thickness = above(0);
inline constexpr Range divisions = at_least(1);
inline constexpr Range refine = from_to(1, 1000);
inline constexpr Range within = at_least(0);
inline constexpr Range normal_angle = {0, 180, false, true};
inline constexpr Range frequency = above(0);
inline constexpr Range tangent_modulus = at_least(0);
inline constexpr Range back_stress = at_least(0);
inline constexpr Range prony_shear = above(0);
inline constexpr Range relaxation_time = above(0);
inline constexpr Range density = at_least(0);
inline constexpr Range density_in_place = above(0);
inline constexpr Range rayleigh = at_least(0);
inline constexpr Range damping_ratio = at_least(0);
inline constexpr Range damped_modes = from_to(1, 1000);
inline constexpr Range spring = above(0);
inline constexpr Range connector = at_least(0);
inline constexpr Range point_mass = at_least(0);
inline constexpr Range inertia = at_least(0);
inline constexpr Range friction = at_least(0);
inline constexpr Range restitution = from_to(0, 1);
inline constexpr Range projection_tolerance = from_to(0, 1);
inline constexpr Range tangential = above(0);
inline constexpr Range radius = above(0);
inline constexpr Range loop_tolerance = between(0, 1);
inline constexpr Range max_loops = from_to(1, 10'000);
inline constexpr Range step = above(0);
inline constexpr Range record = above(0);
inline constexpr Range arc_length = above(0);
inline constexpr Range max_step = above(0);
inline constexpr Range max_plastic_step = above(0);
inline constexpr Range scaled_step = above(0);
inline constexpr Range cut_parts = from_to(2, 1000);
inline constexpr Range cut_levels = from_to(0, 50);
inline constexpr Range max_iterations = from_to(1, 1'000'000);
inline constexpr Range residual = between(0, 1);
inline constexpr Range every = at_least(0);
inline constexpr Range step_number = from_to(1, 99999);
inline constexpr Range digits = from_to(6, 17);
inline constexpr Range check_tolerance = above(0);

} // namespace rubato::study::bounds
