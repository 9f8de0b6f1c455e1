// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/table_hardening.hpp"

#include <algorithm>

namespace rubato::material {

Yield yield(const TableHardening& kind, double start, double growth, const StepInfo&) {
  const auto& points = kind.points;
  if (points.size() == 1)
    return {points.front().stress, 0};
  const double p = start + growth;
  const auto above = std::upper_bound(points.begin() + 1, points.end() - 1, p,
                                      [](double value, const auto& point) { return value < point.strain; });
  const auto& high = *above;
  const auto& low = *(above - 1);
  const double slope = (high.stress - low.stress) / (high.strain - low.strain);
  return {low.stress + slope * (p - low.strain), slope};
}

TableHardening hardening_of_tension(double young, std::span<const TableHardening::Point> curve) {
  TableHardening table;
  table.points.reserve(curve.size());
  for (const auto& [strain, stress] : curve)
    table.points.push_back({table.points.empty() ? 0 : strain - stress / young, stress});
  return table;
}

} // namespace rubato::material
