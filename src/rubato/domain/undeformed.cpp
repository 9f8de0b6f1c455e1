// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/undeformed.hpp"

#include <cmath>
#include <type_traits>
#include <variant>
#include <vector>

namespace rubato::domain {

material::ElasticPoint first_tangent(const material::PointLaw& law) {
  const std::vector<double> old(static_cast<std::size_t>(material::state_size(law)), 0.0);
  auto now = old;
  material::Response response;
  material::respond(law, material::Strain6::Zero(), old, now, {}, material::Want::tangent, response);
  return {response.tangent};
}

namespace {

/// σ_y; 0 of laws that do not yield.
template <class Law> double first_yield_stress(const Law& law) {
  if constexpr (std::is_same_v<Law, material::PlaneStress>)
    return std::visit([](const auto& one) { return first_yield_stress(one); }, law.law);
  else if constexpr (std::is_same_v<Law, material::Plastic>)
    return std::visit([](const auto& kind) { return yield(kind, 0.0, 0.0, {}).stress; }, law.hardening);
  else
    return 0;
}

} // namespace

element::HourglassControl hourglass_control(const material::PointLaw& law, study::Physics physics) {
  const auto moduli = first_tangent(law).stiffness;
  const double shear =
      physics == study::Physics::solid ? moduli.diagonal().tail<3>().minCoeff() : moduli(3, 3);
  const double yield_stress = std::visit([](const auto& one) { return first_yield_stress(one); }, law);
  return {shear, yield_stress / (std::sqrt(3.0) * shear)};
}

} // namespace rubato::domain
