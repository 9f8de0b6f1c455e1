// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/yeoh.hpp"

#include "rubato/material/invariant_form.hpp"

namespace rubato::material {

bool respond(const Yeoh& law, const Strain6& strain, std::span<const double>, std::span<double>,
             const StepInfo&, Want want, Response& out) {
  Invariants at;
  if (!find_invariants(strain, at))
    return false;
  const double x = at.first;
  const InvariantEnergy shape{x * (law.c10 + x * (law.c20 + x * law.c30)),
                              law.c10 + x * (2 * law.c20 + 3 * x * law.c30), 0,
                              2 * law.c20 + 6 * x * law.c30};
  set_response(at, shape, volume_energy(law.volumetric, law.bulk, at.square), want, out);
  return true;
}

} // namespace rubato::material
