// SPDX-License-Identifier: LGPL-3.0-or-later
/// Normals of a contact surface as its faces have them, and averaged at its nodes.
#pragma once

#include "rubato/contact/surface.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::model {

/// A face's corner: its share of the face and the normal there, the face's middle nodes left out.
struct FaceCorner {
  int face = 0;
  int position = 0; ///< in the surface's nodes
  double area = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< of length 1, out of the body
  double weight = 0;                                ///< of that normal in the corner's average
};

/// Face by face.
std::vector<FaceCorner> face_corners(const mesh::Mesh& mesh, const contact::Surface& surface);

/// By position, of corners: averages of length 1 with the weights of N. Max, Weights for computing vertex
/// normals from facet normals, J. Graphics Tools 4 (1999), exact on circles and spheres however nodes are
/// spaced.
std::vector<Eigen::Vector3d> averaged_normals(const contact::Surface& surface,
                                              std::span<const FaceCorner> corners);

/// By position, of corners: whether the surface ends there, where normals are averaged on one side only.
std::vector<char> rim_of(const contact::Surface& surface);

} // namespace rubato::model
