// SPDX-License-Identifier: LGPL-3.0-or-later
/// Normals that are averaged at the nodes of a surface and interpolated over its faces (Code_Aster R5.03.52,
/// LISSAGE):
///
///   n(ξ) = Σ N_i(ξ) n_i,   n_i = unit of the sum over the faces at node i of their unit normals there
///
/// Faces beyond a sharp edge (sharp_edges.hpp) do not count: the surface has its smooth parts by face.
#pragma once

#include "rubato/contact/surface.hpp"
#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact {

/// Σ weights_i n_i over the nodes of a face. It is no unit vector.
Eigen::Vector3d averaged_normal(const Surface& surface, int face, std::span<const double> weights,
                                const Configuration& configuration);

/// Adds factor Σ weights_i δn_i: three columns (in the plane two) a node of `nodes`, which has those of all
/// faces around the face.
void vary_averaged_normal(const Surface& surface, int face, std::span<const double> weights, double factor,
                          const Configuration& configuration, std::span<const mesh::NodeIndex> nodes,
                          Eigen::Ref<Eigen::Matrix<double, 3, Eigen::Dynamic>> into);

/// Appends the nodes of the faces around a face that `nodes` does not have from position `from` on.
void append_ring(const Surface& surface, int face, std::size_t from, std::vector<mesh::NodeIndex>& nodes);

} // namespace rubato::contact
