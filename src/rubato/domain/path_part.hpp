// SPDX-License-Identifier: LGPL-3.0-or-later
/// The part of one cell in the works of a path.
#pragma once

#include "rubato/domain/balance.hpp"
#include "rubato/domain/law_path.hpp"

#include <span>

namespace rubato::domain {

/// What one cell adds to a path.
struct PathPart {
  double stored = 0;
  double elsewhere = 0;
  Balance taken;
  double law_work = 0; ///< but for what `elsewhere` changes by
};

/// Adds what happened at the points of one cell since `points`, which go on to `now`.
void go_along(const material::PointLaw& law, const CellEnd& now, std::span<const double> old_states,
              std::span<LawPoint> points, PathPart& part);
void add(const PathPart& part, LawPath& path);

} // namespace rubato::domain
