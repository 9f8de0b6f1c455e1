// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the folder only: nodal normals that belong to both of two faces that meet.
///
/// With the slave's normals alone a problem that mirrors slave and master onto each other has an answer that
/// does not: places of the master are found along normals of one side. Here the direction of a slave node is
///
///   p_k = (m_k − m(y)) / |…|,    y: where the line through x_k along p_k meets the master
///
/// m(y) = ΣN_l m_l of the master's nodal normals. It is found by fixed-point iteration from p_k = m_k. Where
/// slave and master are mirrored p is the normal of the mirror, whatever the gap and the slope, and D and M
/// of matching meshes are the same matrix.
#pragma once

#include "rubato/contact/mortar/parts.hpp"

namespace rubato::contact::mortar {

/// Replaces `work.normals` of a surface that meets itself, m_k by position, by p_k. A node keeps m_k where
/// none of its faces meets one within `reach` before, behind or beside it. Needs `work.masters` and
/// `work.search` at the same positions.
void take_mean_normals(const Surface& surface, std::span<const Eigen::Vector3d> x, const Options& options,
                       double reach, Workspace::Impl& work);

} // namespace rubato::contact::mortar
