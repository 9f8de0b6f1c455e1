// SPDX-License-Identifier: LGPL-3.0-or-later
/// Sub-facets of a face: the parts on which multipliers are linear (segments, triangles) or bilinear
/// (quadrangles), one multiplier a node of the face.
///
/// Every sub-facet is a segment, a triangle or a parallelogram in the reference plane of its face, so that an
/// affine map leads from there to its own reference cell: r = to_local (ξ − origin).
#pragma once

#include "rubato/cell/quadrature.hpp"
#include "rubato/core/cell_type.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rubato::contact::mortar {

struct SubFacet {
  int node_count = 0;                  ///< 2, 3 or 4
  std::array<std::uint8_t, 4> nodes{}; ///< local numbers in the face, counter-clockwise
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  Eigen::Matrix2d to_local = Eigen::Matrix2d::Identity();
  Eigen::Matrix2d from_local = Eigen::Matrix2d::Identity();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero(); ///< ξ of the mean of its nodes

  /// ξ of the face at a place of the facet's own reference cell.
  Eigen::Vector2d to_face(const Eigen::Vector2d& local) const {
    return {origin[0] + (from_local(0, 0) * local[0] + from_local(0, 1) * local[1]),
            origin[1] + (from_local(1, 0) * local[0] + from_local(1, 1) * local[1])};
  }
  /// The determinant of that map.
  double stretch() const { return from_local(0, 0) * from_local(1, 1) - from_local(1, 0) * from_local(0, 1); }

  /// SEG2, TRIA3 or QUAD4.
  CellType type() const;
};

/// The sub-facets of a slave face: SEG2, TRIA3, QUAD4 one; SEG3 two; TRIA6, QUAD9 four; QUAD8 five (four
/// triangles and a square); TRIA7 six. Throws std::invalid_argument for other cells.
std::span<const SubFacet> subfacets(CellType face);

/// The parts that a master face is clipped by: those of subfacets, but TRIA7 as TRIA6, and QUAD8 as QUAD9
/// with a node 8 in its middle, at x(0, 0).
std::span<const SubFacet> clipping_facets(CellType face);

/// H_i(ξ), 0 past node_count; ΣH = 1 everywhere. ξ are reference coordinates of the face.
Eigen::Vector4d facet_values(const SubFacet& facet, const Eigen::Vector2d& xi);

/// A rule on the sub-facet, exact for polynomials in ξ of that degree: ξ of the face, and weights that add up
/// to the sub-facet's area in the reference plane.
std::vector<cell::QuadraturePoint> facet_rule(const SubFacet& facet, int degree);

} // namespace rubato::contact::mortar
