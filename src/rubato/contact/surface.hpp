// SPDX-License-Identifier: LGPL-3.0-or-later
/// The side of a body that may touch another: faces whose normals point out of the body.
#pragma once

#include "rubato/contact/projection.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rubato::contact {

/// A face of a contact surface (a segment in 2D). Its nodes are ordered so that x,₁ × x,₂ (2D: x,₁ × e_z)
/// leaves the body.
struct Face {
  CellType type = CellType::seg2;
  int node_count = 0;
  std::array<mesh::NodeIndex, 9> nodes{};
  std::array<int, 9> positions{}; ///< of these nodes in their surface's, once it is made
  mesh::CellIndex cell = 0;       ///< the face's own cell in the mesh
  std::array<double, 9> kinks{};  ///< at its nodes (kinks.hpp)

  std::span<const mesh::NodeIndex> node_span() const {
    return std::span(nodes).first(static_cast<std::size_t>(node_count));
  }
  std::span<const int> position_span() const {
    return std::span(positions).first(static_cast<std::size_t>(node_count));
  }
};

struct Surface {
  std::vector<Face> faces;
  std::vector<mesh::NodeIndex> nodes;          ///< ascending, without repeats
  std::vector<std::vector<int>> faces_of_node; ///< by position in `nodes`
  std::vector<std::uint8_t> at_edge;           ///< by position: whether the surface ends there (kinks.hpp)
  /// The smooth part of each face (sharp_edges.hpp) where normals are averaged. Else empty.
  std::vector<std::size_t> smooth_part;
  double shortest_edge = 0; ///< between corners, undeformed [length]
  double longest_edge = 0;

  /// Position of a mesh node in `nodes`, or −1.
  int position_of(mesh::NodeIndex node) const;
};

/// Collects the nodes and neighbours of `faces`, which must be oriented already.
Surface make_surface(const mesh::Mesh& mesh, std::vector<Face> faces);

/// What a face has of values that are given by position in its surface's nodes, one column a node of the
/// face.
inline FaceCoordinates values_of(const Face& face, std::span<const Eigen::Vector3d> values) {
  FaceCoordinates of_face(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    for (int c = 0; c < 3; ++c)
      of_face(c, i) = values[static_cast<std::size_t>(face.positions[static_cast<std::size_t>(i)])][c];
  return of_face;
}

/// Where the nodes of a surface are undeformed, by position.
std::vector<Eigen::Vector3d> undeformed_places(const mesh::Mesh& mesh, const Surface& surface);

/// Reference dimension of a contact face: 1 for segments, 2 for triangles and quadrangles.
int parametric_dimension(CellType type);

} // namespace rubato::contact
