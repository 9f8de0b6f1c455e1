// SPDX-License-Identifier: LGPL-3.0-or-later
/// Frames of slave nodes: averaged normals, and tangents that turn with the material.
#pragma once

#include "rubato/contact/mortar/slave_reference.hpp"
#include "rubato/contact/sharp_edges.hpp"
#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::contact::mortar {

/// n leaves the master; τ₂ = n × τ₁. In 2D τ₁ = (−n_y, n_x, 0), τ₂ = e_z.
struct Frame {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< 0 where all faces at the node have no area
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
};

/// Largest turn of a normal that takes a held component out of it; beyond, the normal stays as it is.
inline constexpr double largest_symmetry_turn = 30; // degrees

/// m_j, the unit of the sum of the outward unit normals that the faces at node j have there, unweighted;
/// faces without area there count nothing. 0 where nothing is left. `x` by position in surface.nodes. `held`
/// is empty or by position too: a held component is removed where that turns m_j by less than 30°.
void nodal_normals(const Surface& surface, std::span<const Eigen::Vector3d> x,
                   std::span<const HeldComponents> held, std::vector<Eigen::Vector3d>& normals);

/// Takes the held components out of a unit normal where that turns it by less than 30°.
void remove_held(HeldComponents held, Eigen::Vector3d& normal);

/// For each node the position of the neighbour that τ₁ points at: of a corner the next node on an edge (the
/// mid node where there is one), of a mid node a corner of its edge, of a centre node a mid node.
std::vector<int> tangent_neighbours(const Surface& surface);

/// The frame with n = −m. `along` = x_k − x_j: τ₁ is its part across n. A vector along n is replaced by any
/// across it. `dimension` of space: 2 or 3.
Frame frame_of(const Eigen::Vector3d& outward, const Eigen::Vector3d& along, int dimension);

/// Tangents turned by what turns one frame to another: the same in the body that both frames are of.
Eigen::Matrix<double, 3, 2> turned(const Eigen::Matrix<double, 3, 2>& tangents, const Frame& from,
                                   const Frame& to);

/// The first two faces with a common edge (2D: node) whose normals there are more than that many degrees
/// apart: the averaged normal says nothing about either.
std::optional<std::pair<int, int>>
first_sharp_edge(const Surface& surface, std::span<const Eigen::Vector3d> x, double degrees = sharp_edge);

/// All pairs (low, high) of faces with a common edge whose normals there are at most that many degrees apart.
std::vector<std::pair<int, int>> smooth_neighbours(const Surface& surface, std::span<const Eigen::Vector3d> x,
                                                   double degrees = sharp_edge);

} // namespace rubato::contact::mortar
