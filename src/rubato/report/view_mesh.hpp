// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the view of a report draws of a mesh: the skin of bodies in space, the cells themselves in a plane.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <vector>

namespace rubato::report {

struct ViewMesh {
  int dimension = 3;                  ///< of space
  std::vector<mesh::NodeIndex> nodes; ///< those that are drawn, ascending
  std::vector<std::uint32_t> corners; ///< of triangles: three indices into `nodes` each, as the faces turn
  std::vector<std::uint32_t> ends;    ///< of the edges of faces, in pieces between nodes: two indices each
  std::vector<std::uint16_t> bodies;  ///< of each of `nodes` the body, from 0, by their lowest nodes
  int body_count = 0;
  std::size_t face_count = 0;
};

/// Quadratic faces are cut into triangles at all of their nodes, in space with the outside in front. Bodies
/// are what cells with common nodes hold together. A mesh without cells of two or three dimensions has no
/// faces.
ViewMesh view_mesh(const mesh::Mesh& mesh);

} // namespace rubato::report
