// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/mortar/search.hpp"
#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Largest n_s·n_m of faces that may touch.
constexpr double facing = -0.1;
/// Overlaps below that share of the sub-facet are rounding.
constexpr double least_overlap = 1e-10;
/// Where the map from a face to the plane turns over by that much at a corner, or is that near to it at a
/// point, in parts of its mean, its inverse is not used.
constexpr double fold = 1e-2, no_fold = 1e-6;
/// A face whose area vector is shorter than that, in squared sizes, has no area.
constexpr double no_overlap_area = 1e-14;
/// Least cosine between a face's normal and the mean of its nodal normals for a plane across these.
constexpr double least_agreement = 0.5;

int order_of(CellType type) {
  return cell::topology(type).order;
}

/// Degree 6 is enough for linear faces on linear faces.
std::span<const cell::QuadraturePoint> triangle_rule(CellType slave, CellType master) {
  static const auto linear = cell::rule_of_degree(CellType::tria3, 6);
  static const auto quadratic = cell::rule_of_degree(CellType::tria3, 8);
  return order_of(slave) == 1 && order_of(master) == 1 ? linear : quadratic;
}

/// A node of a clipping facet; QUAD8 has a node 8 where its middle is.
Vector3d clipping_node(const FaceCoordinates& nodes, std::uint8_t node) {
  if (node < nodes.cols())
    return column_of(nodes, node);
  Vector3d middle;
  for (int i = 0; i < 3; ++i) {
    const double corners = nodes(i, 0) + nodes(i, 1) + nodes(i, 2) + nodes(i, 3);
    const double mids = nodes(i, 4) + nodes(i, 5) + nodes(i, 6) + nodes(i, 7);
    middle[i] = 0.5 * mids - 0.25 * corners;
  }
  return middle;
}

/// The polygon of a master sub-facet in the plane, the other way round: it faces the slave. Empty where it
/// does not.
Polygon facing_polygon(const FaceCoordinates& local, const SubFacet& facet) {
  std::array<Vector3d, 4> corners;
  corners.fill(Vector3d(0, 0, 0));
  const auto count = static_cast<std::size_t>(facet.node_count);
  for (std::size_t i = 0; i < count; ++i)
    corners[i] = clipping_node(local, facet.nodes[i]);
  const Vector3d one = difference_of(corners[2], corners[0]);
  const Vector3d other = difference_of(count == 4 ? corners[3] : corners[2], corners[1]);
  const Vector3d normal = cross(one, other);
  Polygon polygon;
  const double length = length_of(normal);
  if (!(length > no_overlap_area * dot(one, one)) || normal[2] >= facing * length)
    return polygon;
  for (std::size_t i = count; i-- > 0;)
    polygon.add({corners[i][0], corners[i][1]});
  return polygon;
}

Eigen::AlignedBox2d box_around(const Polygon& polygon) {
  Eigen::AlignedBox2d box;
  for (const auto& corner : polygon.corners())
    box.extend(corner);
  return box;
}

/// The box of a face in the plane, grown where it may bulge.
Eigen::AlignedBox2d box_around(CellType type, const FaceCoordinates& local) {
  const auto box = box_of(type, local);
  const Vector3d &low = box.min(), &high = box.max();
  return {Vector2d(low[0], low[1]), Vector2d(high[0], high[1])};
}

Vector2d middle_of(CellType type) {
  return cell::topology(type).corner_count == 3 ? Vector2d(1. / 3, 1. / 3) : Vector2d(0, 0);
}

} // namespace

double undeformed_measure(CellType type, const FaceCoordinates& undeformed, const Vector2d& xi,
                          const Measure& measure) {
  const auto& cell = cell::reference_cell(type);
  std::array<double, 18> gradients;
  const auto count = static_cast<std::size_t>(cell.node_count),
             dimension = static_cast<std::size_t>(cell.dimension);
  const Vector3d at(xi[0], xi[1], 0);
  cell.gradients(at, std::span(gradients).first(count * dimension));
  std::array<Vector3d, 2> tangents{Vector3d(0, 0, 0), Vector3d(0, 0, 0)};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t a = 0; a < dimension; ++a)
      add_scaled(gradients[i * dimension + a], column_of(undeformed, static_cast<Eigen::Index>(i)),
                 tangents[a]);
  double scale = measure.thickness;
  if (measure.ring)
    scale *= 2 * std::numbers::pi * face_position(type, undeformed, xi)[0];
  return scale * length_of(dimension == 1 ? tangents[0] : cross(tangents[0], tangents[1]));
}

namespace {

/// The normal of the auxiliary plane of a sub-facet; `face_normal` where the nodal normals look elsewhere.
Vector3d plane_normal(const SlaveFace& slave, const SubFacet& facet, const Vector3d& face_normal) {
  if (!slave.along_normals)
    return face_normal;
  const auto values = face_values(slave.type, facet.middle);
  Vector3d mean(0, 0, 0);
  for (Eigen::Index k = 0; k < slave.normals.cols(); ++k)
    add_scaled(values[static_cast<std::size_t>(k)], column_of(slave.normals, k), mean);
  mean = unit_of(mean);
  return dot(mean, face_normal) >= least_agreement ? mean : face_normal;
}

} // namespace

PlaneOverlaps::PlaneOverlaps(const SlaveFace& slave, const SubFacet& facet, const Measure& measure,
                             const Reach& reach)
    : slave_(slave), facet_(facet), measure_(measure), reach_(reach) {
  const auto middle = face_geometry(slave.type, slave.x, facet.middle);
  const Vector3d along = column_of(middle.tangents, 0), aside = column_of(middle.tangents, 1);
  const Vector3d normal = cross(along, aside);
  const double length = length_of(normal);
  if (!(length > no_overlap_area * (dot(along, along) + dot(aside, aside))))
    return;
  for (int i = 0; i < facet.node_count; ++i)
    add_scaled(1. / facet.node_count, column_of(slave.x, facet.nodes[static_cast<std::size_t>(i)]), centre_);
  axes_[2] = plane_normal(slave, facet, unit_of(normal));
  axes_[0] = unit_of(part_across(axes_[2], along));
  axes_[1] = cross(axes_[2], axes_[0]);
  map_ = PlaneMap(slave.type, in_plane(slave.x));
  for (int i = 0; i < facet.node_count; ++i) {
    const auto corner = column_of(map_.local(), facet.nodes[static_cast<std::size_t>(i)]);
    polygon_.add({corner[0], corner[1]});
  }
  area_ = signed_area(polygon_);
  box_ = box_around(polygon_);
  undeformed_ = FacePolynomial(slave.type, slave.undeformed);
  const double reference_area = (facet.node_count == 4 ? 4 : 0.5) * facet.stretch();
  flat_determinant_ = area_ / reference_area;
  folded_ = is_folded();
}

Vector3d PlaneOverlaps::in_plane(const Vector3d& x) const {
  const Vector3d apart = difference_of(x, centre_);
  return {dot(axes_[0], apart), dot(axes_[1], apart), dot(axes_[2], apart)};
}

FaceCoordinates PlaneOverlaps::in_plane(const FaceCoordinates& x) const {
  FaceCoordinates local(3, x.cols());
  for (Eigen::Index node = 0; node < x.cols(); ++node) {
    const double first = x(0, node) - centre_[0], second = x(1, node) - centre_[1],
                 third = x(2, node) - centre_[2];
    for (std::size_t i = 0; i < 3; ++i)
      local(static_cast<Eigen::Index>(i), node) =
          axes_[i][0] * first + axes_[i][1] * second + axes_[i][2] * third;
  }
  return local;
}

void PlaneOverlaps::append(const MasterFace& master, OverlapPoints& into) const {
  if (!(area_ > 0))
    return;
  const auto local = in_plane(master.x);
  if (!box_.intersects(box_around(master.type, local)))
    return;
  const PlaneMap map(master.type, local);
  for (const auto& facet : clipping_facets(master.type)) {
    const auto clipper = facing_polygon(local, facet);
    if (clipper.size() == 0 || !box_.intersects(box_around(clipper)))
      continue;
    const auto part = clip(polygon_, clipper);
    if (signed_area(part) >= least_overlap * area_)
      append_part(master, map, part, into);
  }
}

namespace {

using Corners = std::array<Vector2d, 3>;

Vector2d between(const Corners& corners, const Vector3d& r) {
  Vector2d place;
  for (int i = 0; i < 2; ++i)
    place[i] =
        corners[0][i] + r[0] * (corners[1][i] - corners[0][i]) + r[1] * (corners[2][i] - corners[0][i]);
  return place;
}

/// Reference coordinates at the corners of a polygon and at their mean: between those of a triangle Newton's
/// method starts.
class CornerPlaces {
public:
  CornerPlaces(const PlaneMap& map, const Polygon& polygon, const Vector2d& start)
      : places_(polygon.size() + 1) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
      places_.start(i, polygon[i], start);
    places_.start(polygon.size(), mean_corner(polygon), start);
    map.find(places_);
    for (std::size_t i = 0; i < places_.count; ++i)
      at_[i] = places_.found[i] != 0 ? places_.xi_at(i) : start;
  }
  Corners of(const std::array<std::size_t, 3>& corners) const {
    return {at_[corners[0]], at_[corners[1]], at_[corners[2]]};
  }
  std::size_t corner_count() const { return places_.count - 1; }
  bool found(std::size_t i) const { return places_.found[i] != 0; }
  const Vector2d& xi(std::size_t i) const { return at_[i]; }
  double height(std::size_t i) const { return places_.height[i]; }

private:
  PlanePlaces places_;
  std::array<Vector2d, PlanePlaces::capacity> at_;
};

void append_corners(const CornerPlaces& on_slave, const CornerPlaces& on_master,
                    std::vector<Corner>& corners) {
  for (std::size_t i = 0; i < on_slave.corner_count(); ++i)
    if (on_slave.found(i) && on_master.found(i))
      corners.push_back({on_slave.xi(i), on_master.xi(i), on_master.height(i) - on_slave.height(i)});
}

} // namespace

void PlaneOverlaps::append_part(const MasterFace& master, const PlaneMap& map, const Polygon& part,
                                OverlapPoints& into) const {
  std::array<Triangle, Polygon::capacity> triangles;
  const auto count = fan(part, triangles);
  const auto first = into.points.size();
  const CornerPlaces slave_corners(map_, part, facet_.middle);
  const CornerPlaces master_corners(map, part, middle_of(master.type));
  bool within_reach = false;
  for (const auto& triangle : std::span(triangles).first(count))
    within_reach |= append_triangle(master, map, triangle, slave_corners.of(triangle.indices),
                                    master_corners.of(triangle.indices), into.points);
  if (within_reach)
    append_corners(slave_corners, master_corners, into.corners);
  else
    into.points.resize(first);
}

bool PlaneOverlaps::append_triangle(const MasterFace& master, const PlaneMap& map, const Triangle& triangle,
                                    const Corners& slave_corners, const Corners& master_corners,
                                    std::vector<Point>& points) const {
  const auto rule = triangle_rule(slave_.type, master.type);
  PlanePlaces on_slave(rule.size()), on_master(rule.size());
  for (std::size_t i = 0; i < rule.size(); ++i) {
    const Vector2d p = between(triangle.corners, rule[i].xi);
    on_slave.start(i, p, between(slave_corners, rule[i].xi));
    on_master.start(i, p, between(master_corners, rule[i].xi));
  }
  find_on_slave(on_slave);
  find_on_master(master, map, on_slave, on_master);
  bool within_reach = false;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    auto& point = points.emplace_back();
    point.xi = on_slave.xi_at(i);
    point.eta = on_master.xi_at(i);
    map_.set_values(point.xi, point.slave_values);
    map.set_values(point.eta, point.master_values);
    const auto undeformed = undeformed_.at(point.xi);
    const double stretch = measure_.thickness * length_of(cross(undeformed.by_first, undeformed.by_second)) /
                           on_slave.determinant[i];
    point.weight = 2 * triangle.area * rule[i].weight * stretch;
    point.distance = on_master.height[i] - on_slave.height[i];
    within_reach = within_reach || reach_.contains(point.distance);
  }
  return within_reach;
}

std::optional<double> PlaneOverlaps::distance_before(const MasterFace& master, const Vector2d& xi) const {
  const Vector3d x = in_plane(face_position(slave_.type, slave_.x, xi));
  const PlaneMap map(master.type, in_plane(master.x));
  PlanePlaces places(1);
  places.start(0, {x[0], x[1]}, middle_of(master.type));
  map.find(places);
  Projection place;
  place.xi = places.xi_at(0);
  if (places.found[0] == 0)
    return std::nullopt;
  clamp_to_face(master.type, place);
  if (!place.inside())
    return std::nullopt;
  return places.height[0] - x[2];
}

/// Whether the map of the face turns over at a corner of the sub-facet: then it has no inverse.
bool PlaneOverlaps::is_folded() const {
  return std::ranges::any_of(std::span(facet_.nodes).first(polygon_.size()), [&](std::uint8_t node) {
    const auto& xi = cell::reference_cell(slave_.type).nodes[node];
    return map_.place_at({xi[0], xi[1]}).determinant < -fold * flat_determinant_;
  });
}

void PlaneOverlaps::find_on_slave(PlanePlaces& places) const {
  if (!folded_)
    map_.find(places);
  for (std::size_t i = 0; i < places.count; ++i)
    if (folded_ || places.found[i] == 0 || !(places.determinant[i] > no_fold * flat_determinant_))
      places.set(i, flat_place(places.point_at(i)));
}

/// As if the sub-facet were flat and affine, and never beyond it: shares of nodes stay positive.
PlanePlace PlaneOverlaps::flat_place(const Vector2d& p) const {
  const bool quadrangle = polygon_.size() == 4;
  const Vector2d origin = quadrangle ? mean_corner(polygon_) : polygon_[0];
  const double scale = quadrangle ? 0.5 : 1;
  const auto &from = polygon_[0], &first = polygon_[1], &last = polygon_[quadrangle ? 3 : 2];
  const Vector2d along(scale * (first[0] - from[0]), scale * (first[1] - from[1]));
  const Vector2d aside(scale * (last[0] - from[0]), scale * (last[1] - from[1]));
  const double determinant = along[0] * aside[1] - along[1] * aside[0];
  const double squares =
      along[0] * along[0] + along[1] * along[1] + aside[0] * aside[0] + aside[1] * aside[1];
  Projection local;
  local.xi = quadrangle ? Vector2d(0, 0) : Vector2d(1. / 3, 1. / 3);
  if (determinant > no_overlap_area * squares) {
    const double x = p[0] - origin[0], y = p[1] - origin[1], inverse = 1 / determinant;
    local.xi = {inverse * (aside[1] * x - aside[0] * y), inverse * (along[0] * y - along[1] * x)};
  }
  clamp_to_face(facet_.type(), local);
  auto place = map_.place_at(facet_.to_face(local.clamped));
  place.determinant = flat_determinant_;
  return place;
}

/// Where Newton's method fails the closest point of the face is taken.
void PlaneOverlaps::find_on_master(const MasterFace& master, const PlaneMap& map, const PlanePlaces& on_slave,
                                   PlanePlaces& places) const {
  map.find(places);
  for (std::size_t i = 0; i < places.count; ++i)
    if (places.found[i] == 0) {
      const Vector3d x(places.p[0][i], places.p[1][i], on_slave.height[i]);
      places.set(i, map.place_at(project(master.type, map.local(), x).clamped));
    }
}

} // namespace rubato::contact::mortar
