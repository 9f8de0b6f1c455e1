// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/elastic_point.hpp"

#include "rubato/study/study.hpp"

namespace rubato::material {

ElasticPoint make_elastic_point(double young, double poisson) {
  return {tangent(LinearElastic{young, poisson, 0}, study::Physics::solid)};
}

ElasticPoint make_elastic_point(const Orthotropic& law) {
  return {law.stiffness};
}

bool respond(const ElasticPoint& law, const Strain6& strain, std::span<const double>, std::span<double>,
             const StepInfo&, Want want, Response& out) {
  out.stress.noalias() = law.stiffness * strain;
  out.stored = 0.5 * strain.dot(out.stress);
  if (want == Want::tangent)
    out.tangent = law.stiffness;
  return true;
}

} // namespace rubato::material
