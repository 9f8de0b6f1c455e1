// SPDX-License-Identifier: LGPL-3.0-or-later
/// The faces that a contact surface has.
#pragma once

#include "rubato/contact/surface.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/mesh/skin.hpp"
#include "rubato/model/build.hpp"

#include <optional>
#include <span>
#include <vector>

namespace rubato::model {

/// Sides of cells with their outward normals, and sheets, for those who take them.
struct NamedFaces {
  std::vector<mesh::SurfaceFace> sides;
  mesh::Sheets sheets;
};

/// The faces of a group of cells; nothing and a fault when they make no surface.
std::optional<NamedFaces> faces_named(const mesh::Mesh& mesh, const Mention& name, bool takes_sheets,
                                      std::vector<Fault>& faults);

/// Sides of cells as a contact surface; those that are cells of the mesh keep their numbering.
contact::Surface surface_of(const mesh::Mesh& mesh, std::span<const mesh::SurfaceFace> sides);

} // namespace rubato::model
