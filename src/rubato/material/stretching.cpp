// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/stretching.hpp"

#include "rubato/study/words.hpp"

namespace rubato::material {

double stretching_stiffness(const Law& law, study::Physics physics) {
  const auto axes = study::dimension_of(physics);
  return tangent(law, physics).diagonal().head(axes).mean();
}

} // namespace rubato::material
