// SPDX-License-Identifier: LGPL-3.0-or-later
/// V4 and V5: a long cylinder pressed on a block, and then pushed sideways.
#pragma once

#include "rubato/contact/law.hpp"

#include "verification/case_runs.hpp"
#include <vector>

namespace rubato::verification {

/// Two bodies that touch along a line (H. Hertz 1882; K. L. Johnson, Contact Mechanics, 1985, ch. 4).
struct HertzLine {
  double half_width = 0; ///< √(4 P R/(π E*))
  double peak = 0;       ///< 2 P/(π a)
};
/// `load` a unit of length; 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂, 1/R = 1/R₁ + 1/R₂.
HertzLine hertz_line(double load, double radius, double modulus);

/// That of cases/v4_hertz_cylinder: 35 kN/mm, radius 50 mm, 210 on 70 GPa, ν = 0.3.
HertzLine v4_theory();

/// A contact point of a 2D run's end.
struct SurfacePoint {
  double x = 0;
  double pressure = 0;
  double traction = 0; ///< of the master on the slave along x [force/area]
  contact::Status status = contact::Status::open;
};
/// Those of the run's first zone, ascending x.
std::vector<SurfacePoint> surface_at_end(const CaseRun& run);

/// The half-ellipse p² = p₀² (1 − ((x − x₀)/a)²) nearest to the pressures above a fifth of the largest, with
/// x₀ the centre of pressure: a and p₀.
HertzLine fitted_ellipse(const std::vector<SurfacePoint>& points);

double largest_pressure(const std::vector<SurfacePoint>& points);

/// What stick and slip must be in cases/v5_cattaneo_mindlin, from the forces that its run has at the end.
struct MindlinTheory {
  HertzLine normal;
  double friction = 0;
  double mobilised = 0; ///< Q/(μP)
  double stick = 0;     ///< c = a √(1 − Q/(μP))
};
MindlinTheory mindlin_theory(const CaseRun& run);
/// Edge of the cells that touch [mm].
inline constexpr double v5_cell = 0.2;

/// C. Cattaneo 1938, R. D. Mindlin 1949: q/(μ p₀) at x for stick within |x| ≤ c.
double mindlin_traction(double x, double a, double c);

/// Half the width of what sticks: halfway to the first points that slip on either side.
double stick_half_width(const std::vector<SurfacePoint>& points);

/// Root of the mean square of (|q| − theory)/(μ p₀) over the points that touch.
double traction_error(const std::vector<SurfacePoint>& points, const MindlinTheory& theory);

} // namespace rubato::verification
