// SPDX-License-Identifier: LGPL-3.0-or-later
/// A contact zone: two surfaces, the points of the slave one where contact is enforced, and how. The master
/// may be an obstacle.
#pragma once

#include "rubato/contact/gap_offset.hpp"
#include "rubato/contact/mortar/slave_reference.hpp"
#include "rubato/contact/obstacle.hpp"
#include "rubato/contact/surface.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/study/contact_methods.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::contact {

/// A point of a slave face, with its reference coordinates there.
struct PointOnFace {
  int face = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
};

/// Where the pressure of a node on the axis of revolution is taken from: the other nodes of its face, by a
/// parabola without slope on the axis, p = Σ weight · p(node).
struct AxisPressure {
  std::array<std::size_t, 2> points{}; ///< indices in the zone's points
  std::array<double, 2> weights{};
};

/// A point of a zone and its part of the area of a node that several zones share.
struct PointShare {
  std::size_t zone = 0; ///< of the model
  std::size_t point = 0;
  double area = 0; ///< of the point's own faces [area]
};

/// Where contact is enforced. A slave node shared by several faces carries one point whose weight is the sum
/// of theirs: its displacement, multiplier and master face are the same seen from each of them.
struct SlavePoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero(); ///< where it is undeformed
  std::vector<mesh::NodeIndex> nodes; ///< those that move it and, when the normal is the slave's, turn it
  std::vector<double> shape;    ///< value of each node's shape function at the point; 0 for turning nodes
  std::vector<int> multipliers; ///< positions in the slave surface's nodes, of the nodes with shape ≠ 0
  std::vector<double> multiplier_shape;
  std::vector<PointOnFace> stands_on; ///< every slave face it belongs to
  double area = 0;                    ///< quadrature weight × undeformed Jacobian [area]
  double weight = 0; ///< what tractions are multiplied with: the area, or 1 for nodal methods
  bool excluded = false;
  /// Of a node that several zones share before the same master: the points that this one represents, itself
  /// included, whose areas its own area sums (shared_nodes.hpp). Empty of all others.
  std::vector<PointShare> shares;
  int node_position = -1; ///< position in the slave surface's nodes when the point stands on a node, else −1
  /// Of a node on the axis of revolution whose shape function has no integral there.
  std::optional<AxisPressure> axis_pressure;
};

struct Zone {
  study::ContactZone settings; ///< with master and slave, whoever chose them
  std::string choice; ///< why the slave is the slave, where the deck leaves it to the model; or empty
  Surface master;     ///< empty with an obstacle
  std::optional<Obstacle> obstacle; ///< instead of a master
  Surface slave;
  std::vector<SlavePoint> points;
  GapOffset offset; ///< added to the gaps between the surfaces
  /// What the zone's coefficient of friction is multiplied with at each point; empty: 1.
  std::vector<double> friction_shares;
  int space_dimension = 3;
  /// Of a surface that touches itself: its undeformed places, by position in the surface's nodes.
  std::vector<Eigen::Vector3d> undeformed_master;
  /// Whether every point stands on a node and has its multipliers for itself. Otherwise gaps close on average
  /// over the faces only.
  bool points_own_multipliers = false;
  /// Whether points count as one each, without regard to areas: what is a pressure elsewhere is a force.
  bool unit_weights = false;
  /// Of mortar: what the slave is undeformed. Points are the slave's nodes then, in their order.
  std::optional<mortar::SlaveReference> mortar;
  /// Components of the slave's nodes that supports hold, of mortar and ties: one a node, or none.
  std::vector<mortar::HeldComponents> held;

  /// Of a tie: whether the gap turns by finite rotations, as bodies of finite strain do.
  bool finite_rotations = false;

  double begin = 0; ///< the first instant of the run

  /// What a coefficient of friction of the zone is at one of its points.
  double friction_at(std::size_t point, double of_zone) const {
    return friction_shares.empty() ? of_zone : of_zone * friction_shares[point];
  }

  /// Whether master and slave are one surface. Which of two of its parts is the slave is told by
  /// self_pairs.hpp.
  bool meets_itself() const { return !settings.self.empty(); }

  /// Whether a support holds that component of a slave node, by its position.
  bool is_held(std::size_t node_position, int component) const {
    return node_position < held.size() &&
           ((static_cast<unsigned>(held[node_position]) >> static_cast<unsigned>(component)) & 1U) != 0;
  }

  /// Whether its geometry is that of the undeformed bodies.
  bool holds_geometry() const { return settings.freeze || settings.tie; }

  /// What gaps and slips are small against: the shortest edge of the master, of the slave before an obstacle.
  double edge() const { return obstacle ? slave.shortest_edge : master.shortest_edge; }

  /// Which of λ, Λ₁, Λ₂ (0, 1, 2) are unknowns of a slave node, in their order there. Of a tie these are the
  /// tractions along x, y, z.
  std::span<const int> multiplier_variables() const;
  int multipliers_per_node() const { return static_cast<int>(multiplier_variables().size()); }
  /// Whether there are multipliers, each with one point.
  bool owns_multipliers() const { return points_own_multipliers && multipliers_per_node() > 0; }
  /// Whether there are multipliers that several points interpolate.
  bool shares_multipliers() const { return !points_own_multipliers && multipliers_per_node() > 0; }
  int multiplier_count() const { return static_cast<int>(slave.nodes.size()) * multipliers_per_node(); }
};

inline std::span<const int> Zone::multiplier_variables() const {
  static constexpr std::array variables{0, 1, 2};
  const bool tangential =
      settings.tie || (settings.friction > 0 && study::entry_of(settings.friction_method).exact);
  const std::size_t first = study::entry_of(settings.method).exact ? 0 : 1;
  const std::size_t last = tangential ? static_cast<std::size_t>(space_dimension) : 1;
  return std::span(variables).subspan(first, last - first);
}

/// What the weight of a contact point is multiplied with: the thickness, or 2πr of the undeformed point.
enum class Measure { unit, ring };

struct ZoneGeometry {
  int space_dimension = 3;
  double thickness = 1;
  Measure measure = Measure::unit;
};

/// `excluded_nodes` are mesh nodes (ascending), those that don't lie on the slave surface don't matter.
Zone make_zone(const mesh::Mesh& mesh, const study::ContactZone& settings, Surface master, Surface slave,
               std::span<const mesh::NodeIndex> excluded_nodes, const ZoneGeometry& geometry);

/// The same before an obstacle.
Zone make_zone(const mesh::Mesh& mesh, const study::ContactZone& settings, Obstacle obstacle, Surface slave,
               std::span<const mesh::NodeIndex> excluded_nodes, const ZoneGeometry& geometry);

/// Two faces of the slave of a tie by mortar that make an edge too sharp for a mean normal of both: their
/// cells, if any. Where surfaces may part, a node at such an edge is a point on each side of it.
std::optional<std::array<mesh::CellIndex, 2>> sharp_slave_edge(const Zone& zone);

/// Where the nodes are: undeformed coordinates plus u; `start` is u at the beginning of the step. Obstacles
/// are where the instants say.
struct Configuration {
  const mesh::Mesh* mesh;
  const domain::DofMap* dofs;
  const Eigen::VectorXd* displacement;
  const Eigen::VectorXd* start;
  double t = 0;       ///< of `displacement`
  double start_t = 0; ///< of `start`

  Eigen::Vector3d position(mesh::NodeIndex node) const { return moved_by(*displacement, node); }
  /// Where the node was when the step began: the same to the last bit in all iterations of the step, as the
  /// position minus the increment is not.
  Eigen::Vector3d start_position(mesh::NodeIndex node) const { return moved_by(*start, node); }
  /// Displacement since the start of the step.
  Eigen::Vector3d increment(mesh::NodeIndex node) const;

private:
  Eigen::Vector3d moved_by(const Eigen::VectorXd& u, mesh::NodeIndex node) const;
};

inline Eigen::Vector3d Configuration::moved_by(const Eigen::VectorXd& u, mesh::NodeIndex node) const {
  Eigen::Vector3d x = mesh->points[static_cast<std::size_t>(node)];
  const auto first = dofs->first_dof[static_cast<std::size_t>(node)];
  for (int i = 0; i < dofs->components; ++i)
    x[i] += u[first + i];
  return x;
}

inline Eigen::Vector3d Configuration::increment(mesh::NodeIndex node) const {
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  const auto first = dofs->first_dof[static_cast<std::size_t>(node)];
  for (int i = 0; i < dofs->components; ++i)
    moved[i] = (*displacement)[first + i] - (*start)[first + i];
  return moved;
}

} // namespace rubato::contact
