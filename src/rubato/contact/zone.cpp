// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/averaged_normal.hpp"
#include "rubato/contact/integration.hpp"
#include "rubato/contact/law.hpp"
#include "rubato/contact/mortar/frames.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/sharp_edges.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace rubato::contact {
namespace {

using mesh::NodeIndex;

FaceCoordinates undeformed(const mesh::Mesh& mesh, const Face& face) {
  FaceCoordinates coordinates(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    set_column(i, mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])],
               coordinates);
  return coordinates;
}

/// Part of the largest area of a point that is rounding.
constexpr double no_area = 1e-12;
/// Part of a face on the axis of revolution that lies nearer to its node there than to the next one, h/2
/// away: (h/4)²/h².
constexpr double axis_share = 1.0 / 16;
/// Radius, in lengths of the surface's longest edge, that is rounding of 0.
constexpr double on_axis = 1e-9;
/// Gauss points that integrate a shape function over a ring exactly where its face is straight.
constexpr int ring_points = 3;

double area_factor(const mesh::Mesh& mesh, const Face& face, const Eigen::Vector2d& xi,
                   const ZoneGeometry& geometry) {
  const auto at = face_geometry(face.type, undeformed(mesh, face), xi);
  const double jacobian = length_of(cross(column_of(at.tangents, 0), column_of(at.tangents, 1)));
  const double ring = geometry.measure == Measure::ring ? 2 * std::numbers::pi * at.position.x() : 1.0;
  return jacobian * geometry.thickness * ring;
}

/// What the face adds to a point's area. Rules on nodes are exact for shape functions times a constant; the
/// radius is none, and 0 on the axis of revolution: the ring that a node has a share of (`share`) is the
/// integral of its shape function.
double area_of(const mesh::Mesh& mesh, const Face& face, const IntegrationPoint& point, bool share,
               const ZoneGeometry& geometry) {
  if (!share || point.node < 0)
    return point.weight * area_factor(mesh, face, point.xi, geometry);
  double sum = 0;
  for (const auto& at : gauss_rule(face.type, ring_points))
    sum += face_shape(face.type, at.xi).values[static_cast<std::size_t>(point.node)] * at.weight *
           area_factor(mesh, face, at.xi, geometry);
  return sum;
}

void exclude_without_area(std::vector<SlavePoint>& points) {
  double largest = 0;
  for (const auto& point : points)
    largest = std::max(largest, std::abs(point.area));
  for (auto& point : points)
    if (std::abs(point.area) <= no_area * largest)
      point.excluded = true;
}

double ring_area(const mesh::Mesh& mesh, const Face& face, const ZoneGeometry& geometry) {
  double sum = 0;
  for (const auto& at : gauss_rule(face.type, ring_points))
    sum += at.weight * area_factor(mesh, face, at.xi, geometry);
  return sum;
}

/// The other two points of a face, when all its nodes are points.
std::optional<AxisPressure> pressure_beside(const mesh::Mesh& mesh, const Face& face, NodeIndex node,
                                            const std::map<NodeIndex, std::size_t>& point_of_node) {
  AxisPressure beside;
  std::array<double, 2> squares{};
  std::size_t found = 0;
  for (const auto other : face.node_span()) {
    const auto point = point_of_node.find(other);
    if (other == node || point == point_of_node.end() || found == 2)
      continue;
    const double radius = mesh.points[static_cast<std::size_t>(other)].x();
    beside.points[found] = point->second;
    squares[found++] = radius * radius;
  }
  const double apart = squares[1] - squares[0];
  if (found < 2 || apart == 0)
    return std::nullopt;
  beside.weights = {squares[1] / apart, -squares[0] / apart};
  return beside;
}

/// The shape function of the node of a quadratic face on the axis has no integral over the ring: a uniform
/// pressure puts no force there, and rounding or a bent face makes it anything. Such a node still touches: it
/// gets the area around it. Where gaps close exactly its force doesn't depend on that; its pressure is taken
/// from its neighbours.
void give_axis_nodes_area(const mesh::Mesh& mesh, const Surface& slave,
                          const std::map<NodeIndex, std::size_t>& point_of_node, const ZoneGeometry& geometry,
                          std::vector<SlavePoint>& points) {
  for (const auto& [node, index] : point_of_node) {
    auto& point = points[index];
    if (mesh.points[static_cast<std::size_t>(node)].x() > on_axis * slave.longest_edge)
      continue;
    const auto& face = slave.faces[static_cast<std::size_t>(point.stands_on.front().face)];
    const double around = axis_share * ring_area(mesh, face, geometry);
    if (point.area >= around)
      continue;
    point.area = around;
    point.axis_pressure = pressure_beside(mesh, face, node, point_of_node);
  }
}

bool is_excluded(std::span<const NodeIndex> excluded, NodeIndex node) {
  return std::binary_search(excluded.begin(), excluded.end(), node);
}

/// Nodes that turn the slave's normal are taken along with shape value 0.
void add_turning_nodes(const Surface& slave, bool averaged, SlavePoint& point) {
  for (const auto& place : point.stands_on) {
    if (averaged)
      append_ring(slave, place.face, 0, point.nodes);
    for (const auto node : slave.faces[static_cast<std::size_t>(place.face)].node_span())
      if (std::find(point.nodes.begin(), point.nodes.end(), node) == point.nodes.end())
        point.nodes.push_back(node);
  }
  point.shape.resize(point.nodes.size(), 0.0);
}

SlavePoint point_on_node(int position, NodeIndex node) {
  SlavePoint point;
  point.nodes = {node};
  point.shape = {1.0};
  point.node_position = position;
  point.multipliers = {point.node_position};
  point.multiplier_shape = {1.0};
  return point;
}

/// A point between the nodes. Excluded nodes move it but bear no pressure, unless the point stands for one
/// node.
SlavePoint point_inside(const Surface& slave, const Face& face, const IntegrationPoint& at,
                        std::span<const NodeIndex> excluded) {
  SlavePoint point;
  std::array<double, 9> values{};
  cell::reference_cell(face.type).values({at.xi[0], at.xi[1], 0},
                                         std::span(values).first(static_cast<std::size_t>(face.node_count)));
  for (std::size_t i = 0; i < static_cast<std::size_t>(face.node_count); ++i) {
    point.nodes.push_back(face.nodes[i]);
    point.shape.push_back(values[i]);
    if (at.stands_for < 0 && is_excluded(excluded, face.nodes[i]))
      continue;
    point.multipliers.push_back(slave.position_of(face.nodes[i]));
    point.multiplier_shape.push_back(values[i]);
  }
  return point;
}

std::vector<SlavePoint> make_points(const mesh::Mesh& mesh, const Integration& rule, int order,
                                    const Surface& slave, std::span<const NodeIndex> excluded,
                                    const ZoneGeometry& geometry) {
  const bool shares_of_rings = rule.shares_of_nodes && geometry.measure == Measure::ring;
  std::vector<SlavePoint> points;
  std::map<NodeIndex, std::size_t> point_of_node;
  for (std::size_t f = 0; f < slave.faces.size(); ++f) {
    const auto& face = slave.faces[f];
    for (const auto& at : rule.points(face.type, order)) {
      std::size_t index = points.size();
      if (at.node >= 0) {
        const auto node = face.nodes[static_cast<std::size_t>(at.node)];
        index = point_of_node.emplace(node, index).first->second;
        if (index == points.size())
          points.push_back(point_on_node(slave.position_of(node), node));
      } else {
        points.push_back(point_inside(slave, face, at, excluded));
      }
      auto& point = points[index];
      point.area += area_of(mesh, face, at, shares_of_rings, geometry);
      point.stands_on.push_back({static_cast<int>(f), at.xi});
      if (at.stands_for >= 0 && is_excluded(excluded, face.nodes[static_cast<std::size_t>(at.stands_for)]))
        point.excluded = true;
    }
  }
  if (shares_of_rings)
    give_axis_nodes_area(mesh, slave, point_of_node, geometry, points);
  exclude_without_area(points);
  return points;
}

/// One a slave node. Areas are the integrals of the multipliers' functions.
std::vector<SlavePoint> make_mortar_points(const mortar::SlaveReference& reference, const Surface& slave,
                                           std::span<const NodeIndex> excluded) {
  std::vector<SlavePoint> points;
  for (std::size_t i = 0; i < slave.nodes.size(); ++i) {
    auto point = point_on_node(static_cast<int>(i), slave.nodes[i]);
    point.area = reference.full_weight[i];
    point.excluded = is_excluded(excluded, slave.nodes[i]);
    points.push_back(std::move(point));
  }
  exclude_without_area(points);
  return points;
}

Eigen::Vector3d undeformed_place(const mesh::Mesh& mesh, const SlavePoint& point) {
  Eigen::Vector3d x(0, 0, 0);
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
    add_scaled(point.shape[i], mesh.points[static_cast<std::size_t>(point.nodes[i])], x);
  return x;
}

mortar::SlaveReference mortar_reference(const mesh::Mesh& mesh, const Surface& slave,
                                        const ZoneGeometry& geometry) {
  return mortar::make_slave_reference(slave, undeformed_places(mesh, slave),
                                      {geometry.thickness, geometry.measure == Measure::ring});
}

} // namespace

Zone make_zone(const mesh::Mesh& mesh, const study::ContactZone& settings, Surface master, Surface slave,
               std::span<const NodeIndex> excluded_nodes, const ZoneGeometry& geometry) {
  Zone zone;
  zone.settings = settings;
  zone.space_dimension = geometry.space_dimension;
  const auto rule = integration_of(settings);
  zone.unit_weights = rule.unit_weights;
  if (rule.points == nullptr) {
    if (!settings.tie)
      slave = with_split_edges(slave, undeformed_places(mesh, slave));
    if (zone.meets_itself())
      master = slave;
    zone.mortar = mortar_reference(mesh, slave, geometry);
    zone.points = make_mortar_points(*zone.mortar, slave, excluded_nodes);
  } else {
    zone.points = make_points(mesh, rule, settings.integration.order, slave, excluded_nodes, geometry);
  }
  zone.points_own_multipliers =
      std::ranges::all_of(zone.points, [](const auto& point) { return point.node_position >= 0; });
  if (zone.meets_itself())
    zone.undeformed_master = undeformed_places(mesh, master);
  zone.master = std::move(master);
  zone.slave = std::move(slave);
  for (auto& point : zone.points) {
    point.weight = rule.unit_weights ? 1.0 : point.area;
    point.place = undeformed_place(mesh, point);
  }
  if (settings.smoothing) {
    zone.master.smooth_part = smooth_parts(zone.master, undeformed_places(mesh, zone.master));
    zone.slave.smooth_part = smooth_parts(zone.slave, undeformed_places(mesh, zone.slave));
  }
  if (settings.normal != study::ContactNormal::master)
    for (auto& point : zone.points)
      add_turning_nodes(zone.slave, settings.smoothing, point);
  return zone;
}

Zone make_zone(const mesh::Mesh& mesh, const study::ContactZone& settings, Obstacle obstacle, Surface slave,
               std::span<const NodeIndex> excluded_nodes, const ZoneGeometry& geometry) {
  auto zone = make_zone(mesh, settings, Surface(), std::move(slave), excluded_nodes, geometry);
  zone.obstacle = std::move(obstacle);
  return zone;
}

std::optional<std::array<mesh::CellIndex, 2>> sharp_slave_edge(const Zone& zone) {
  if (!zone.mortar || !zone.settings.tie)
    return std::nullopt;
  const auto faces = mortar::first_sharp_edge(zone.slave, zone.mortar->undeformed);
  if (!faces)
    return std::nullopt;
  const auto cell_of = [&](int face) { return zone.slave.faces[static_cast<std::size_t>(face)].cell; };
  return std::array{cell_of(faces->first), cell_of(faces->second)};
}

} // namespace rubato::contact
