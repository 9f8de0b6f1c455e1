// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace rubato::linalg {

/// A pivot smaller than this, beside an entry of size one, is made of rounding errors. Floating elastic
/// bodies of 600 to 10,000 unknowns leave pivots of 4e-16 to 3e-14 for their rigid motions; a clamped beam a
/// thousand times longer than thick leaves 1e-9.
inline constexpr double negligible_pivot = 1e-13;

} // namespace rubato::linalg
