// SPDX-License-Identifier: LGPL-3.0-or-later
/// Surfaces that are tied to one another: points of the slave keep their place before the master in every
/// direction. A gap between the undeformed surfaces keeps its size and turns with the master (tie_gap.hpp).
///
/// The frame of such a point stands along the axes. By mortar each component has a stencil of its own: a
/// slave node that a support holds along an axis has no relation there, and its function goes to the nodes
/// around it (B. Wohlmuth, Acta Numerica 20, 2011, on cross points). A point on a node has none there either.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/contact/tie_gap.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::contact {

/// Tied points, and of each the gaps that turn with the master: none where the surfaces touch.
struct Ties {
  std::vector<PointEvaluation> points;
  std::vector<std::vector<TieGap>> gaps;
};

/// The points of a zone with `tie`, of nodes or of mortar, in frames that are held, with derivatives; those
/// that face nothing have no kinematics. A point on a node faces a master within the longest slave face of
/// it, when its projection is not clamped. `rest`: nothing is displaced. Stencils turn gaps by linearised
/// rotations.
Ties make_ties(const Zone& zone, const Configuration& rest);
std::vector<PointEvaluation> tied_points(const Zone& zone, const Configuration& rest);

/// Takes gap, slip, their derivatives and the normal of a tied point to a configuration by the finite
/// rotation of its gaps. No effect without gaps.
void follow_turning(std::span<const TieGap> gaps, const Configuration& configuration, Kinematics& k);

/// Calls take(point, component) for each relation between displacements that tied points have, in the order
/// of the points: Σ weight(node, component, of) u(node, of) = 0 over the point's stencil and all `of`.
template <class Take> void for_each_relation(std::span<const PointEvaluation> points, const Take& take) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].kinematics)
      continue;
    const auto& stencil = points[i].kinematics->stencil;
    for (int c = 0; c < stencil.components; ++c) {
      bool related = false;
      for (std::size_t j = 0; j < stencil.nodes.size() && !related; ++j)
        related = stencil.weight(static_cast<Eigen::Index>(j), c) != 0;
      if (related)
        take(i, c);
    }
  }
}

} // namespace rubato::contact
