// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/mooney_rivlin.hpp"

#include "rubato/material/invariant_form.hpp"

namespace rubato::material {

bool respond(const MooneyRivlin& law, const Strain6& strain, std::span<const double>, std::span<double>,
             const StepInfo&, Want want, Response& out) {
  Invariants at;
  if (!find_invariants(strain, at))
    return false;
  const InvariantEnergy shape{law.c10 * at.first + law.c01 * at.second, law.c10, law.c01, 0};
  set_response(at, shape, volume_energy(law.volumetric, law.bulk, at.square), want, out);
  return true;
}

} // namespace rubato::material
