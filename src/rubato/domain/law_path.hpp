// SPDX-License-Identifier: LGPL-3.0-or-later
/// The works at the points of cells along many short steps, for runs that keep no records of all points:
/// each evaluation leaves what the next one needs of it. Notation of balance.hpp.
#pragma once

#include "rubato/domain/balance_terms.hpp"
#include "rubato/material/point_response.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::domain {

/// What the law saw at a point, and the stress that is conjugate to it.
struct LawPoint {
  material::Strain6 strain = material::Strain6::Zero();
  material::Strain6 free = material::Strain6::Zero(); ///< element::PointRecord::free
  material::Stress6 stress = material::Stress6::Zero();
  bool operator==(const LawPoint&) const = default;
};

struct LawPath {
  // At the end of the last evaluation:
  /// Of the cells that are heated, or whose law has a stress that is linear in the elastic strain and
  /// remembers something or sees logarithmic strain: a point after the other in the order of Bulk::cells.
  std::vector<LawPoint> points;
  Eigen::VectorXd forces; ///< f of the cells that are not constant, one a dof [force]
  double stored = 0;      ///< in these cells, hourglasses with it [force · length]
  double elsewhere = 0; ///< the part of it in cells without `points`, in hyperelastic ones and in hourglasses
  // Over its step:
  Balance taken; ///< its `scheme` stays 0
  /// Σ w {stress}:[strain + free], of hyperelastic laws Σ w [stored] less heat, and [stored] of hourglasses.
  /// What {f}·[u] exceeds it by is Balance::scheme.
  double law_work = 0;
};

} // namespace rubato::domain
