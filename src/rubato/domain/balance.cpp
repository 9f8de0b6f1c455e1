// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/balance.hpp"

#include <vector>

namespace rubato::domain {
namespace {

using element::PointRecord;
using element::StrainKind;
using material::PointLaw;

std::span<const double> state_at(const CellEnd& end, std::size_t point, std::size_t size) {
  return end.states.subspan(point * size, size);
}

/// {P}:[F]
double work_of_cell(const PointRecord& old, const PointRecord& now) {
  return 0.5 * (old.piola + now.piola).cwiseProduct(now.gradient - old.gradient).sum();
}

/// {stress}:[strain]
double work_of_law(const PointRecord& old, const PointRecord& now) {
  return 0.5 * (old.stress + now.stress).dot(now.strain - old.strain);
}

LawEnd law_end(const PointRecord& record) {
  return {record.strain, record.free, record.stress};
}

/// ∂W/∂a
double slope_by_expansion(const LawEnd& end) {
  return -(end.stress.head<3>().sum() + 2 * end.stress.dot(end.strain)) / (1 + end.free[0]);
}

} // namespace

void add(const Balance& part, Balance& sum) {
  sum.plastic += part.plastic;
  sum.back_stress += part.back_stress;
  sum.viscous += part.viscous;
  sum.scheme += part.scheme;
  sum.heat += part.heat;
}

double heat_between(const PointLaw& law, const LawEnd& old, const LawEnd& now) {
  if (has_linear_stress(law))
    return -0.5 * (old.stress + now.stress).dot(now.free - old.free);
  return 0.5 * (slope_by_expansion(old) + slope_by_expansion(now)) * (now.free[0] - old.free[0]);
}

bool has_linear_stress(const PointLaw& law) {
  return !material::is_hyperelastic(law);
}

void add_balance(const PointLaw& law, StrainKind strain, const CellEnd& old, const CellEnd& now,
                 Balance& sum) {
  const auto size = static_cast<std::size_t>(material::state_size(law));
  const bool linear = has_linear_stress(law);
  for (std::size_t point = 0; point < now.records.size(); ++point) {
    const auto& before = old.records[point];
    const auto& after = now.records[point];
    const auto taken = material::dissipation(law, state_at(old, point, size), state_at(now, point, size),
                                             0.5 * (before.stress + after.stress));
    sum.plastic += after.volume * taken.plastic;
    sum.back_stress += after.volume * taken.back_stress;
    sum.viscous += after.volume * taken.viscous;
    const double heat = heat_between(law, law_end(before), law_end(after));
    sum.heat += after.volume * heat;
    if (strain != StrainKind::small)
      sum.scheme += after.volume * (work_of_cell(before, after) + heat -
                                    (linear ? work_of_law(before, after) : after.stored - before.stored));
  }
}

double back_stress_energy(const PointLaw& law, const CellEnd& end) {
  const auto size = static_cast<std::size_t>(material::state_size(law));
  const std::vector<double> untouched(size, 0.0);
  double sum = 0;
  for (std::size_t point = 0; point < end.records.size(); ++point)
    sum += end.records[point].volume *
           material::dissipation(law, untouched, state_at(end, point, size), material::Stress6::Zero())
               .back_stress;
  return sum;
}

} // namespace rubato::domain
