// SPDX-License-Identifier: LGPL-3.0-or-later
/// V1, V2, V8, V10: bodies that hit something and leave it again.
#pragma once

#include "verification/case_runs.hpp"
#include <functional>

namespace rubato::verification {

/// What theory has for the force between first and last touch, and the energy that errors are measured by.
struct ImpactTheory {
  double begin = 0;
  double end = 0;
  std::function<double(double)> force; ///< at an instant between them
  double energy = 0;
};

/// V1 of cases/: 300 = v √(E ρ) on [0.5, 0.5 + 2L/c].
ImpactTheory bar_on_wall();
/// V2: 300 + 300 (t − 1) on [1, 1 + 2L/c].
ImpactTheory dropped_bar();
/// V10: 150 = v √(E ρ)/2 on [0.1, 0.1 + 2L/c].
ImpactTheory rod_on_rod();

/// What a run has.
struct Impact {
  /// First and last instant with more than half of the force that theory has there: waves in a mesh have no
  /// sharp fronts.
  double begin = 0;
  double end = 0;
  double impulse = 0;
  double largest_force = 0;
  /// Root of the mean square of (force − theory)/theory's first force, after the first 5 % of the contact.
  double pressure_error = 0;
  /// Largest |kinetic + strain + contact − work of the loads, less what it was at the start|/energy.
  double energy_error = 0;
};
Impact measure_impact(const CaseRun& run, const std::string& zone, const ImpactTheory& theory);

/// An elastic sphere against a rigid plane (H. Hertz 1882; W. Goldsmith, Impact, 1960, ch. IV): quasi-static
/// contact, F = 4/3 E* √R δ^{3/2}, while the whole sphere moves as one.
struct SphereImpact {
  double force = 0;    ///< largest
  double approach = 0; ///< largest
  double duration = 0;
};
SphereImpact hertz_impact(double radius, double young, double poisson, double density, double velocity);
/// The run of cases/v8_hertz_impact: the sphere touches at the start, approach is how far its centre sinks.
SphereImpact measure_sphere(const CaseRun& run);

} // namespace rubato::verification
