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
#include "rubato/contact/mortar/clipping.hpp"
#include "rubato/contact/mortar/plane_map.hpp"
#include "rubato/contact/mortar/slave_reference.hpp"
#include "rubato/contact/mortar/subfacets.hpp"
#include "rubato/contact/projection.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace rubato::contact::mortar {

/// The undeformed measure of a slave face at ξ: |X,₁ × X,₂| or |X,ξ|, × thickness × 2πR.
double undeformed_measure(CellType type, const FaceCoordinates& undeformed, const Eigen::Vector2d& xi,
                          const Measure& measure);

/// A point on both faces, with the shape functions of both there; entries past the faces' nodes are not set.
struct Point {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< on the slave face
  Eigen::Vector2d eta = Eigen::Vector2d::Zero(); ///< on the master face
  std::array<double, 9> slave_values;            ///< N_k(ξ)
  std::array<double, 9> master_values;           ///< N_l(η)
  double weight = 0;                             ///< [area]; negative in triangles that a fan takes back
  double distance = 0; ///< of the master from the slave along the direction of projection [length]
};

/// An end or a corner of an overlap: nothing is integrated there, but no place of the overlap is nearer than
/// the nearest of its corners where both faces are flat.
struct Corner {
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();  ///< on the slave face
  Eigen::Vector2d eta = Eigen::Vector2d::Zero(); ///< on the master face
  double distance = 0;                           ///< as of a point [length]
};

/// What overlaps of a slave sub-facet with master faces add to.
struct OverlapPoints {
  std::vector<Point> points;
  std::vector<Corner> corners;

  void clear() {
    points.clear();
    corners.clear();
  }
};

/// How far a slave face looks for the master [length].
struct Reach {
  double ahead = 0;  ///< largest gap
  double behind = 0; ///< deepest penetration

  bool contains(double distance) const { return -behind <= distance && distance <= ahead; }
  double most() const { return std::max(ahead, behind); }
};

/// A slave face as its overlaps are looked for.
struct SlaveFace {
  CellType type = CellType::quad4;
  FaceCoordinates x;          ///< deformed
  FaceCoordinates undeformed; ///< X
  FaceCoordinates normals;    ///< outward nodal normals
  /// In 3D: whether the auxiliary plane is across their mean, not across the face.
  bool along_normals = false;
};

struct MasterFace {
  CellType type = CellType::quad4;
  FaceCoordinates x; ///< deformed
};

/// In 2D: appends the points of a slave sub-facet before a master face. Nothing where the two do not overlap,
/// do not face each other (n_s·n_m ≥ 0), have no length, or where no point is within reach.
/// Overlaps below 1e-10 of the slave's reference length are left out.
void append_line_overlap(const SlaveFace& slave, const SubFacet& facet, const Measure& measure,
                         const MasterFace& master, const Reach& reach, OverlapPoints& into);

/// In 2D: how far the master is from the slave at ξ along the slave's normal; nothing where it is not there.
std::optional<double> distance_along_normal(const SlaveFace& slave, const MasterFace& master,
                                            const Eigen::Vector2d& xi);

/// In 3D: a slave sub-facet and its auxiliary plane. The slave face and its sub-facet must outlive it.
class PlaneOverlaps {
public:
  PlaneOverlaps(const SlaveFace& slave, const SubFacet& facet, const Measure& measure, const Reach& reach);

  /// Appends the points before a master face. Sub-facets of the master count nothing where n_s·n_m ≥ −0.1,
  /// where they overlap less than 1e-10 of the slave's, or where no point is within reach.
  void append(const MasterFace& master, OverlapPoints& into) const;

  /// How far a master face is from the slave at ξ; nothing where it is not there.
  std::optional<double> distance_before(const MasterFace& master, const Eigen::Vector2d& xi) const;

private:
  void append_part(const MasterFace& master, const PlaneMap& map, const Polygon& part,
                   OverlapPoints& into) const;
  /// Whether one of its points is within reach.
  bool append_triangle(const MasterFace& master, const PlaneMap& map, const Triangle& triangle,
                       const std::array<Eigen::Vector2d, 3>& slave_corners,
                       const std::array<Eigen::Vector2d, 3>& master_corners,
                       std::vector<Point>& points) const;
  /// In the axes of the plane, from its centre.
  Eigen::Vector3d in_plane(const Eigen::Vector3d& x) const;
  FaceCoordinates in_plane(const FaceCoordinates& x) const;
  bool is_folded() const;
  PlanePlace flat_place(const Eigen::Vector2d& p) const;
  void find_on_slave(PlanePlaces& places) const;
  void find_on_master(const MasterFace& master, const PlaneMap& map, const PlanePlaces& on_slave,
                      PlanePlaces& places) const;

  const SlaveFace& slave_;
  const SubFacet& facet_;
  Measure measure_;
  Reach reach_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero(); ///< of the auxiliary plane
  /// e₁, e₂, n of the plane; 0 without area
  std::array<Eigen::Vector3d, 3> axes_{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                       Eigen::Vector3d::Zero()};
  FacePolynomial undeformed_;   ///< X(ξ)
  Eigen::AlignedBox2d box_;     ///< of the polygon
  PlaneMap map_;                ///< of the slave face
  Polygon polygon_;             ///< the sub-facet in the plane
  double area_ = 0;             ///< of the polygon
  double flat_determinant_ = 0; ///< of ∂p/∂ξ if the sub-facet were flat and affine
  bool folded_ = false;
};

} // namespace rubato::contact::mortar
