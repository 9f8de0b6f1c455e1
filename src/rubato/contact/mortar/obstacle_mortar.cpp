// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/obstacle_mortar.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/core/index.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <map>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

/// Of H² times the measure and the obstacle's curvature, on linear and on quadratic faces.
constexpr int linear_degree = 6, quadratic_degree = 8;

/// Columns of SeenProducts.
constexpr Eigen::Index gap_column = 0, normal_column = 1, place_column = 4, tangent_column = 7;
using Seen = Eigen::Vector<double, 10>;

/// The rules of all sub-facets of a type of face.
std::span<const std::vector<cell::QuadraturePoint>> facet_rules(CellType type) {
  static const auto table = [] {
    std::map<CellType, std::vector<std::vector<cell::QuadraturePoint>>> rules;
    for (const auto face : {CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6, CellType::tria7,
                            CellType::quad4, CellType::quad8, CellType::quad9})
      for (const auto& facet : subfacets(face))
        rules[face].push_back(
            facet_rule(facet, cell::topology(face).order == 1 ? linear_degree : quadratic_degree));
    return rules;
  }();
  return table.at(type);
}

Seen seen_from(const Obstacle& obstacle, const Pose& pose, const Vector3d& x, const Vector3d& undeformed) {
  const auto place = place_on(obstacle, pose, x, undeformed);
  Seen seen;
  seen << place.gap, place.normal, x - place.gap * place.normal, place.tangent;
  return seen;
}

/// Whether the slave looks at the obstacle at ξ: its back does not touch.
bool faces(const SlaveFace& placed, const Eigen::Vector2d& xi, const Vector3d& normal) {
  const auto at = face_geometry(placed.type, placed.x, xi);
  return at.tangents.col(0).cross(at.tangents.col(1)).dot(normal) < 0;
}

/// Gaps at the corners of a sub-facet. Faces may hang over the obstacle's end: where all points of the rule
/// see it corners do.
void see_corners(const SlaveFace& placed, const SubFacet& facet, const Obstacle& obstacle, const Pose& pose,
                 std::vector<SeenGap>& seen) {
  for (std::size_t i = 0; i < at(facet.node_count); ++i) {
    const auto node = facet.nodes[i];
    const Vector3d x = placed.x.col(node), undeformed = placed.undeformed.col(node);
    const Eigen::Vector2d xi = cell::reference_cell(placed.type).nodes[node].head<2>();
    seen.push_back({Eigen::Vector4d::Unit(static_cast<Eigen::Index>(i)),
                    seen_from(obstacle, pose, x, undeformed)[gap_column], xi});
  }
}

/// One sub-facet before the obstacle.
void integrate_facet(const SlaveFace& placed, int face, int facet_index, const Obstacle& obstacle,
                     const Pose& pose, const SlaveReference& reference, double reach, Workspace::Impl& work) {
  const auto& measure = reference.measure;
  const auto& facet = subfacets(placed.type)[at(facet_index)];
  Part part;
  part.face = face;
  part.facet = facet_index;
  SeenProducts products = SeenProducts::Zero();
  work.seen_gaps.clear();
  for (const auto& [place, weight] : facet_rules(placed.type)[at(facet_index)]) {
    const Eigen::Vector2d xi = place.head<2>();
    const auto seen = seen_from(obstacle, pose, face_position(placed.type, placed.x, xi),
                                face_position(placed.type, placed.undeformed, xi));
    if (!(std::abs(seen[gap_column]) <= reach) || !faces(placed, xi, seen.segment<3>(normal_column)))
      continue;
    const double w = weight * undeformed_measure(placed.type, placed.undeformed, xi, measure);
    const Eigen::Vector4d values = facet_values(facet, xi);
    const auto shape = face_values(placed.type, xi);
    part.covered.add(w, values);
    for (Eigen::Index k = 0; k < placed.x.cols(); ++k)
      part.slave.col(k) += w * shape[static_cast<std::size_t>(k)] * values;
    products += w * values * seen.transpose();
    work.seen_gaps.push_back({values, seen[gap_column], xi});
  }
  if (!(part.covered.first.sum() > 0))
    return;
  see_corners(placed, facet, obstacle, pose, work.seen_gaps);
  part.gaps = products.col(gap_column);
  make_dual(placed, reference, work, part);
  part.first_overlap = work.seen.size();
  part.last_overlap = work.seen.size() + 1;
  work.parts.push_back(part);
  work.seen.push_back(products);
}

/// The frame, the gap and the place that a node's function sees on average.
void set_seen(const Seen& total, int dimension, Node& node) {
  const Seen mean = total / node.weight;
  const Vector3d normal = mean.segment<3>(normal_column);
  const double length = normal.norm();
  if (length > 0) { // all around a sphere normals cancel: the slave's own is left
    const auto frame = frame_of(-normal / length, mean.segment<3>(tangent_column), dimension);
    node.normal = frame.normal;
    node.tangents = frame.tangents;
  }
  node.gap = mean[gap_column] + node.lift;
  node.anchor = mean.segment<3>(place_column);
}

void average_seen(int dimension, const Workspace::Impl& work, Operators& into) {
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    Seen total = Seen::Zero();
    for (std::size_t s = work.first_share[j]; s < work.first_share[j + 1]; ++s) {
      const auto& share = work.shares[at(work.shares_by_node[s])];
      total += work.seen[work.parts[at(share.part)].first_overlap].transpose() * share.row;
    }
    if (into.nodes[j].kept())
      set_seen(total, dimension, into.nodes[j]);
  }
}

} // namespace

void integrate(const Surface& slave, const SlaveReference& reference, const Obstacle& obstacle,
               const Pose& pose, std::span<const Vector3d> slave_x, const Options& options,
               Workspace& workspace, Operators& into) {
  require_finite(slave, slave_x, "slave");
  auto& work = workspace.impl();
  const double reach = options.reach > 0 ? options.reach : std::numeric_limits<double>::infinity();
  set_normals(slave, reference, slave_x, options, work.normals);
  work.clear_parts();
  for (std::size_t f = 0; f < slave.faces.size(); ++f) {
    const auto placed = slave_face(slave.faces[f], reference, slave_x, work.normals);
    for (std::size_t facet = 0; facet < subfacets(placed.type).size(); ++facet)
      integrate_facet(placed, static_cast<int>(f), static_cast<int>(facet), obstacle, pose, reference, reach,
                      work);
  }
  share_functions(slave, reference, slave_x, options, work, into);
  fill_stencils(slave, nullptr, reference.dimension, work, into);
  average_seen(reference.dimension, work, into);
}

} // namespace rubato::contact::mortar
