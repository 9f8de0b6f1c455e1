// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace rubato::material {

struct Yield {
  double stress = 0; ///< R [stress]
  double slope = 0;  ///< ∂R/∂p in the step [stress]
};

} // namespace rubato::material
