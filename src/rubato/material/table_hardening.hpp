// SPDX-License-Identifier: LGPL-3.0-or-later
/// R(p) by a table, linear in between; beyond the last point the last slope continues. Code_Aster:
/// VMIS_ISOT_TRAC with TRACTION; Abaqus: *PLASTIC (which stays at the last stress).
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/yield.hpp"

#include <vector>

namespace rubato::material {

/// One point or more; the first has p = 0, p grows, the stresses are positive and do not fall. One point: no
/// hardening.
struct TableHardening {
  struct Point {
    double strain = 0; ///< p
    double stress = 0; ///< R [stress]
  };
  std::vector<Point> points;
};

Yield yield(const TableHardening& kind, double start, double growth, const StepInfo& step);

constexpr bool depends_on_rate(const TableHardening&) {
  return false;
}

/// From stresses by the whole strain of a bar: p = ε − σ/E. The first point is where yielding begins and gets
/// p = 0.
TableHardening hardening_of_tension(double young, std::span<const TableHardening::Point> curve);

} // namespace rubato::material
