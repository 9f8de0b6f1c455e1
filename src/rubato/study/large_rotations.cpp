// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/large_rotations.hpp"

#include "rubato/study/formulation.hpp"

#include <algorithm>

namespace rubato::study {

bool takes_large_rotations(const Study& study) {
  return std::ranges::any_of(study.materials, [](const Material& material) {
    return strain_of(material) != StrainKind::small;
  });
}

} // namespace rubato::study
