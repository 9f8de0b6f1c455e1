// SPDX-License-Identifier: LGPL-3.0-or-later
/// The laws of a point in space, which give all six stresses from six strains. Functions as point_law.hpp
/// describes them.
#pragma once

#include "rubato/material/elastic_point.hpp"
#include "rubato/material/mooney_rivlin.hpp"
#include "rubato/material/ogden.hpp"
#include "rubato/material/plastic.hpp"
#include "rubato/material/prony.hpp"
#include "rubato/material/yeoh.hpp"

#include <variant>

namespace rubato::material {

using SpaceLaw = std::variant<ElasticPoint, Plastic, Prony, MooneyRivlin, Yeoh, Ogden>;

} // namespace rubato::material
