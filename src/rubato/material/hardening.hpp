// SPDX-License-Identifier: LGPL-3.0-or-later
/// Isotropic hardening: the yield stress R by the cumulated plastic strain p and, where it depends on the
/// rate, by dp/dt.
///
/// Each kind is a file with a type and two functions: `yield(kind, start, growth, step)` with p = start +
/// growth, and depends_on_rate(kind). R > 0, and it does not fall.
#pragma once

#include "rubato/material/johnson_cook.hpp"
#include "rubato/material/linear_hardening.hpp"
#include "rubato/material/table_hardening.hpp"
#include "rubato/material/voce_hardening.hpp"

#include <variant>

namespace rubato::material {

using Hardening = std::variant<LinearHardening, TableHardening, VoceHardening, JohnsonCook>;

} // namespace rubato::material
