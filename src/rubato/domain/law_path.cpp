// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/law_path.hpp"

namespace rubato::domain {

void go_along(const material::PointLaw& law, const CellEnd& now, std::span<const double> old_states,
              std::span<LawPoint> points, LawPath& path) {
  const auto size = static_cast<std::size_t>(material::state_size(law));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& record = now.records[i];
    const material::Stress6 mean = 0.5 * (points[i].stress + record.stress);
    const auto taken = material::dissipation(law, old_states.subspan(i * size, size),
                                             now.states.subspan(i * size, size), mean);
    path.taken.plastic += record.volume * taken.plastic;
    path.taken.back_stress += record.volume * taken.back_stress;
    path.taken.viscous += record.volume * taken.viscous;
    path.law_work += record.volume * mean.dot(record.strain - points[i].strain);
    points[i] = {record.strain, record.stress};
  }
}

} // namespace rubato::domain
