// SPDX-License-Identifier: LGPL-3.0-or-later
/// A cell without forces.
#pragma once

#include "rubato/element/failure.hpp"
#include "rubato/mesh/mesh.hpp"

#include <optional>

namespace rubato::domain {

/// A cell that has no forces at the end of a step: then nothing that was written has a meaning, and forces
/// are not finite.
struct CellFailure {
  element::Failure reason = element::Failure::none;
  mesh::CellIndex cell = -1;
  int point = -1; ///< of the cell; −1: none of its own
};
using Failed = std::optional<CellFailure>;

} // namespace rubato::domain
