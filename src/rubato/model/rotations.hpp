// SPDX-License-Identifier: LGPL-3.0-or-later
/// Groups that supports rotate.
#pragma once

#include "rubato/model/relations.hpp"

#include <memory>
#include <span>
#include <string>

namespace rubato::model {

/// Bodies of small strain that rotate stretch by 1 − cos of the angle, by 1.2e-3 at this one [radians].
inline constexpr double largest_small_angle = 0.05;

/// A rotation of the study, its angle integrated over the run where it gives a velocity or an acceleration.
/// Throws InputError where that cannot be done.
std::shared_ptr<const constraint::Rotation> shared_rotation(const Parts& parts, const study::Rotation& given,
                                                            const std::string& path);

/// The angle of the largest magnitude, and when.
struct AngleAt {
  double angle = 0; ///< [radians]
  double t = 0;
};
/// At the instants of a run that are known before it: those of its steps, 1000 where it finds their length
/// itself, at most 100,000.
AngleAt largest_angle(const constraint::Rotation& rotation, const study::TimeStepping& time);

/// Throws InputError at the path where nodes of bodies rotate farther than the study's strains take. Surfaces
/// that bound no body may rotate by any angle.
void check_angle(const Parts& parts, std::span<const mesh::NodeIndex> nodes,
                 const constraint::Rotation& rotation, const std::string& path);

} // namespace rubato::model
