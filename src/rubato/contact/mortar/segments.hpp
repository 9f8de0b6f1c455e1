// SPDX-License-Identifier: LGPL-3.0-or-later
/// Integration points of the overlap of a slave face and a master face, on the deformed surfaces, with
/// weights in the slave's undeformed measure.
///
/// 2D: the ends of the master face are projected along the slave's continuous field of nodal normals (B.
/// Yang, T. Laursen, X. Meng, Int. J. Numer. Methods Eng. 62 (2005) 1183–1225). 3D: both are projected on a
/// plane for each slave sub-facet, clipped, and cut in triangles; their points are projected back on both
/// curved faces (M. Puso, T. Laursen, Comput. Methods Appl. Mech. Eng. 193 (2004) 601–629; quadratic faces:
/// with J. Solberg, 197 (2008) 555–566).
#pragma once

#include "rubato/cell/quadrature.hpp"
#include "rubato/contact/mortar/subfacets.hpp"
#include "rubato/contact/projection.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact::mortar {

/// What weights are multiplied with beside the undeformed area or length.
struct Measure {
  double thickness = 1;
  bool ring = false; ///< 2πR, R the undeformed x
};

/// ∫1 of the slave face's undeformed measure at ξ: |X,₁ × X,₂| or |X,ξ|, × thickness × 2πR.
double undeformed_measure(CellType type, const FaceCoordinates& undeformed, const Eigen::Vector2d& xi,
                          const Measure& measure);

struct Point {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< on the slave face
  Eigen::Vector2d eta = Eigen::Vector2d::Zero(); ///< on the master face
  double weight = 0;                             ///< [area]; negative in triangles that a fan takes back
  double distance = 0; ///< of the master from the slave along the direction of projection [length]
};

/// A face of the slave as its overlaps are looked for.
struct SlaveFace {
  CellType type = CellType::quad4;
  FaceCoordinates x;          ///< deformed
  FaceCoordinates undeformed; ///< X
  FaceCoordinates normals;    ///< outward nodal normals; used in 2D only
};

struct MasterFace {
  CellType type = CellType::quad4;
  FaceCoordinates x; ///< deformed
};

/// Appends the points of a slave sub-facet before a master face; nothing where they do not overlap, do not
/// face each other (n_s·n_m ≥ −0.1, 2D: ≥ 0), have no area, or are farther apart than `reach` at every point.
/// Overlaps below 1e-10 of the sub-facet are left out.
void append_overlap(const SlaveFace& slave, const SubFacet& facet, const MasterFace& master,
                    const Measure& measure, double reach, std::vector<Point>& points);

} // namespace rubato::contact::mortar
