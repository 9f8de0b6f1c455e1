// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/law_path.hpp"

#include "rubato/domain/balance.hpp"
#include "rubato/domain/path_part.hpp"
#include "rubato/material/point_law.hpp"

namespace rubato::domain {

void go_along(const material::PointLaw& law, const CellEnd& now, std::span<const double> old_states,
              std::span<LawPoint> points, PathPart& part) {
  const auto size = static_cast<std::size_t>(material::state_size(law));
  const bool linear = has_linear_stress(law);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& record = now.records[i];
    const material::Stress6 mean = 0.5 * (points[i].stress + record.stress);
    const auto taken = material::dissipation(law, old_states.subspan(i * size, size),
                                             now.states.subspan(i * size, size), mean);
    part.taken.plastic += record.volume * taken.plastic;
    part.taken.back_stress += record.volume * taken.back_stress;
    part.taken.viscous += record.volume * taken.viscous;
    const double heat = linear ? -mean.dot(record.free - points[i].free)
                               : heat_between(law, {points[i].strain, points[i].free, points[i].stress},
                                              {record.strain, record.free, record.stress});
    part.taken.heat += record.volume * heat;
    part.law_work += record.volume * ((linear ? mean.dot(record.strain - points[i].strain) : 0) - heat);
    points[i] = {record.strain, record.free, record.stress};
  }
}

void add(const PathPart& part, LawPath& path) {
  path.stored += part.stored;
  path.elsewhere += part.elsewhere;
  add(part.taken, path.taken);
  path.law_work += part.law_work;
}

} // namespace rubato::domain
