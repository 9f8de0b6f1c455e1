// SPDX-License-Identifier: LGPL-3.0-or-later
/// Why a cell has no forces.
#pragma once

namespace rubato::element {

enum class Failure {
  none,
  inverted,       ///< J ≤ 0
  law,            ///< the law has no response
  mode_iteration, ///< no end of the iteration for the cell's own unknowns
  not_finite,     ///< a force that is no number
  no_length       ///< the ends of a connector that rotates are at one place
};

/// The reason in words: "a point is turned inside out (J ≤ 0)".
const char* described(Failure failure);

} // namespace rubato::element
