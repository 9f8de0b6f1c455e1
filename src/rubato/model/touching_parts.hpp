// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which parts of the bodies' skins can touch, where nobody has named them.
///
/// A body's skin is cut into parts along its edges of more than 60°. Two parts can touch when a face of one
/// and a face of the other face each other, each in front of the other or a little behind it (bodies that
/// overlap).
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/slave_side.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::model {

/// A part of a body's skin that is the slave of all that it can touch and that is not its slave.
struct TouchingParts {
  std::string name; ///< "block_plate", letters, digits, "_" and "-"
  std::string slave_name;
  std::string master_name;
  std::vector<mesh::SurfaceFace> slave;
  std::vector<mesh::SurfaceFace> master;
  std::string choice; ///< why the slave is the slave
};

/// Of different bodies, in the order of the bodies and of their parts; no two have the same name. A body is
/// called as the group that has its cells and no others, or "body" and its number.
std::vector<TouchingParts> touching_parts(const mesh::Mesh& mesh, const domain::Bulk& bulk,
                                          const SideMeasures& measures);

} // namespace rubato::model
