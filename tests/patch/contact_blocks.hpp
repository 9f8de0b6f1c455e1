// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact patch test (R. L. Taylor and P. Papadopoulos 1991; N. El-Abbasi and K.-J. Bathe, Comput.
/// Struct. 79, 2001): two blocks of side 1 on one another, pressed together by 0.1. With E = 2e6 and ν = 0
/// the strain is 0.05, the pressure 1e5 everywhere, and the interface moves by −0.05.
#pragma once

#include "rubato/core/cell_type.hpp"
#include "rubato/mesh/mesh.hpp"

#include <functional>
#include <optional>
#include <string>

namespace rubato::test {

/// Cells of each block along every direction; equal numbers make a conforming interface.
struct ContactBlocks {
  CellType cells = CellType::quad4;
  int upper = 2;
  int lower = 2;
  double friction = 0;
  std::string zone;  ///< further entries of the contact zone, each with a comma before it
  double turned = 0; ///< the whole is turned by that angle, in space about an axis along none of the blocks
  std::function<mesh::Mesh(const mesh::Mesh&)> change = {}; ///< what becomes of the mesh before it is turned
  std::optional<CellType> lower_cells = {};                 ///< of the same dimension, if others
};

struct PatchOutcome {
  bool converged = false;
  std::string failure;
  double pressure = 0;     ///< largest |λ/1e5 − 1|
  double displacement = 0; ///< largest |u + 0.05|/0.1 along the push, on the slave surface
};

std::string deck_of(const ContactBlocks& blocks);

PatchOutcome press(const ContactBlocks& blocks);

} // namespace rubato::test
