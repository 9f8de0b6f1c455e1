// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the points of a cell expand freely: taken from the strain or, of hyperelastic laws, divided out of F.
///
/// With F' = F/(1 + a), Green–Lagrange's strain is E' = (E − (a + a²/2) 1)/(1 + a)². The energy by undeformed
/// volume is W(E'), so that its derivatives by E are S'/(1 + a)² and D'/(1 + a)⁴.
#pragma once

#include "rubato/element/nonlinear.hpp"

#include <cstddef>

namespace rubato::element {

class FreeStrains {
public:
  /// `strains`: one a point, or empty.
  FreeStrains(StrainKind kind, const PointLaws& laws, std::span<const material::Strain6> strains)
      : strains_(strains), divides_(kind != StrainKind::small && laws.is_hyperelastic()) {}

  /// At a point.
  material::Strain6 at(std::size_t point) const {
    return strains_.empty() ? material::Strain6::Zero().eval() : strains_[point];
  }

  /// Whether something is left of what expands freely at a point.
  bool is_possible(std::size_t point) const {
    return strains_.empty() || !divides_ || strains_[point][0] > -1;
  }

  /// What the law sees of the strain at a point.
  void take_from(std::size_t point, material::Strain6& strain) const {
    if (strains_.empty())
      return;
    if (!divides_) {
      strain -= strains_[point];
      return;
    }
    const double a = strains_[point][0];
    strain.head<3>().array() -= a * (1 + a / 2);
    strain *= shrinking(point);
  }

  /// Change of the strain that the law sees by that of the cell: 1/(1 + a)² or 1.
  double shrinking(std::size_t point) const {
    if (!divides_ || strains_.empty())
      return 1;
    const double stretch = 1 + strains_[point][0];
    return 1 / (stretch * stretch);
  }

private:
  std::span<const material::Strain6> strains_;
  bool divides_;
};

} // namespace rubato::element
