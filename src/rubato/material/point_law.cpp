// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/point_law.hpp"

namespace rubato::material {

int state_size(const PointLaw& law) {
  return std::visit([](const auto& one) { return state_size(one); }, law);
}

bool respond(const PointLaw& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out) {
  return std::visit([&](const auto& one) { return respond(one, strain, old, now, step, want, out); }, law);
}

Dissipation dissipation(const PointLaw& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress) {
  return std::visit([&](const auto& one) { return dissipation(one, old, now, mean_stress); }, law);
}

Strain6 plastic_strain(const PointLaw& law, std::span<const double> state) {
  return std::visit([&](const auto& one) { return plastic_strain(one, state); }, law);
}

double cumulated_plastic_strain(const PointLaw& law, std::span<const double> state) {
  return std::visit([&](const auto& one) { return cumulated_plastic_strain(one, state); }, law);
}

bool tangent_is_symmetric(const PointLaw& law) {
  return std::visit([](const auto& one) { return tangent_is_symmetric(one); }, law);
}

bool is_hyperelastic(const PointLaw& law) {
  return std::visit([](const auto& one) { return is_hyperelastic(one); }, law);
}

bool depends_on_rate(const PointLaw& law) {
  return std::visit([](const auto& one) { return depends_on_rate(one); }, law);
}

} // namespace rubato::material
