// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/prony.hpp"

#include "rubato/material/six.hpp"

#include <cmath>

namespace rubato::material {
namespace {

constexpr std::size_t place_of_viscous(std::size_t term) {
  return 6 + 6 * term;
}

/// a and (1 − a)/r of a term over a step.
struct Decay {
  double kept;
  double mean;
};
Decay decay_of(const Prony::Term& term, const StepInfo& step) {
  const double r = step.length / term.time;
  if (!(r > 0))
    return {1, 1};
  const double lost = -std::expm1(-r);
  return {1 - lost, lost / r};
}

/// h_i of a state.
Stress6 overstress(const Prony& law, std::size_t term, std::span<const double> state) {
  return 2 * law.terms[term].shear * halved_shears(six_at(state, 0) - six_at(state, place_of_viscous(term)));
}

} // namespace

bool respond(const Prony& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out) {
  const double shear = law.young / (2 * (1 + law.poisson));
  const double bulk = law.young / (3 * (1 - 2 * law.poisson));
  const double volume = trace(strain);
  const Strain6 e = deviator(strain);
  const Stress6 change = halved_shears(e - six_at(old, 0));
  Stress6 s = 2 * shear * halved_shears(e);
  out.stored = 0.5 * bulk * volume * volume + shear * strain_double_dot(e, e);
  double stiffness = shear;
  for (std::size_t i = 0; i < law.terms.size(); ++i) {
    const double g = law.terms[i].shear;
    const auto [kept, mean] = decay_of(law.terms[i], step);
    const Stress6 h = kept * overstress(law, i, old) + 2 * g * mean * change;
    six_at(now, place_of_viscous(i)) = e - doubled_shears(h) / (2 * g);
    s += h;
    out.stored += double_dot(h, h) / (4 * g);
    stiffness += g * mean;
  }
  six_at(now, 0) = e;
  out.stress = s + bulk * volume * six_of(six_of_one);
  if (want == Want::tangent)
    set_isotropic(out.tangent, bulk, 2 * stiffness);
  return true;
}

Dissipation dissipation(const Prony& law, std::span<const double> old, std::span<const double> now,
                        const Stress6&) {
  Dissipation all;
  for (std::size_t i = 0; i < law.terms.size(); ++i) {
    const Stress6 mean = 0.5 * (overstress(law, i, old) + overstress(law, i, now));
    all.viscous += mean.dot(six_at(now, place_of_viscous(i)) - six_at(old, place_of_viscous(i)));
  }
  return all;
}

} // namespace rubato::material
