// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/obstacle_mortar.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/index.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

/// Of H² times the measure and the obstacle's curvature, on linear and on quadratic faces.
constexpr int linear_degree = 6, quadratic_degree = 8;

/// Columns of SeenProducts.
constexpr int gap_column = 0, normal_column = 1, place_column = 4, tangent_column = 7, column_count = 10;
using Seen = std::array<double, column_count>;

Vector3d part_of(const Seen& seen, int column) {
  return {seen[at(column)], seen[at(column + 1)], seen[at(column + 2)]};
}

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
  seen[gap_column] = place.gap;
  for (int i = 0; i < 3; ++i) {
    seen[at(normal_column + i)] = place.normal[i];
    seen[at(place_column + i)] = x[i] - place.gap * place.normal[i];
    seen[at(tangent_column + i)] = place.tangent[i];
  }
  return seen;
}

/// Whether the slave looks at the obstacle at ξ: its back does not touch.
bool faces(const SlaveFace& placed, const Eigen::Vector2d& xi, const Vector3d& normal) {
  const auto at = face_geometry(placed.type, placed.x, xi);
  return dot(cross(column_of(at.tangents, 0), column_of(at.tangents, 1)), normal) < 0;
}

/// Gaps at the corners of a sub-facet. Faces may hang over the obstacle's end: where all points of the rule
/// see it corners do.
void see_corners(const SlaveFace& placed, const SubFacet& facet, const Obstacle& obstacle, const Pose& pose,
                 std::vector<SeenGap>& seen) {
  for (std::size_t i = 0; i < at(facet.node_count); ++i) {
    const auto node = facet.nodes[i];
    const Vector3d x = column_of(placed.x, node), undeformed = column_of(placed.undeformed, node);
    const auto& place = cell::reference_cell(placed.type).nodes[node];
    const Eigen::Vector2d xi(place[0], place[1]);
    seen.push_back({Eigen::Vector4d(i == 0, i == 1, i == 2, i == 3),
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
    const Eigen::Vector2d xi(place[0], place[1]);
    const auto seen = seen_from(obstacle, pose, face_position(placed.type, placed.x, xi),
                                face_position(placed.type, placed.undeformed, xi));
    if (!(std::abs(seen[gap_column]) <= reach) || !faces(placed, xi, part_of(seen, normal_column)))
      continue;
    const double w = weight * undeformed_measure(placed.type, placed.undeformed, xi, measure);
    const auto values = facet_values(facet, xi);
    const auto shape = face_values(placed.type, xi);
    part.covered.add(w, values);
    for (int k = 0; k < placed.x.cols(); ++k)
      for (int i = 0; i < 4; ++i)
        part.slave(i, k) += w * shape[at(k)] * values[i];
    for (int column = 0; column < column_count; ++column)
      for (int i = 0; i < 4; ++i)
        products(i, column) += w * values[i] * seen[at(column)];
    work.seen_gaps.push_back({values, seen[gap_column], xi});
  }
  if (!(total_of(part.covered.first) > 0))
    return;
  see_corners(placed, facet, obstacle, pose, work.seen_gaps);
  for (int i = 0; i < 4; ++i)
    part.gaps[i] = products(i, gap_column);
  make_dual(placed, reference, work, part);
  part.first_overlap = work.seen.size();
  part.last_overlap = work.seen.size() + 1;
  work.parts.push_back(part);
  work.seen.push_back(products);
}

/// The frame, the gap and the place that a node's function sees on average.
void set_seen(const Seen& total, int dimension, Node& node) {
  Seen mean = total;
  for (auto& number : mean)
    number /= node.weight;
  const auto normal = part_of(mean, normal_column);
  const double length = length_of(normal);
  if (length > 0) { // all around a sphere normals cancel: the slave's own is left
    const auto frame = frame_of(scaled(-1, unit_of(normal)), part_of(mean, tangent_column), dimension);
    node.normal = frame.normal;
    node.tangents = frame.tangents;
  }
  node.gap = mean[gap_column] + node.lift;
  node.anchor = part_of(mean, place_column);
}

void average_seen(int dimension, const Workspace::Impl& work, Operators& into) {
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    Seen total{};
    for (std::size_t s = work.first_share[j]; s < work.first_share[j + 1]; ++s) {
      const auto& share = work.shares[at(work.shares_by_node[s])];
      const auto& seen = work.seen[work.parts[at(share.part)].first_overlap];
      for (int column = 0; column < column_count; ++column)
        for (int i = 0; i < 4; ++i)
          total[at(column)] += seen(i, column) * share.row[i];
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
