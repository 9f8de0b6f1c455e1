// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/self_pairs.hpp"

#include "rubato/contact/mortar/search.hpp"
#include "rubato/contact/motion.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/two_sides.hpp"
#include "rubato/core/index.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// Beyond this product of their normals two faces do not face each other (mortar/segments.hpp).
constexpr double facing = -0.1;
/// Sides are looked for that many reaches far: faces that meet later in the step have one.
constexpr double margin = 2;
/// Part of a face's size that is rounding of its place.
constexpr double same_place = 1e-9;
/// Beyond this product two faces back to back are the sides of a thin part, not of a corner.
constexpr double opposite = -0.7;
/// Faces that touch overlap by less than this part of the body's thickness behind them.
constexpr double through = 0.5;
/// By so much less is the product of the normals with the face beyond an edge that looks at another one more.
constexpr double more_opposite = 0.1;
/// Of faces as far apart those more directly before each other come first.
constexpr double sideways = 0.1;

/// From the corners alone; in 2D (t_y, −t_x). 0 of a face without area.
Vector3d unit_normal(CellType type, const FaceCoordinates& x) {
  const auto between = [&](int from, int to) { return difference_of(column_of(x, to), column_of(x, from)); };
  Vector3d normal;
  if (parametric_dimension(type) == 1) {
    const auto along = between(0, 1);
    normal = {along[1], -along[0], 0};
  } else if (cell::topology(type).corner_count == 4) {
    normal = cross(between(0, 2), between(1, 3));
  } else {
    normal = cross(between(0, 1), between(0, 2));
  }
  return normal.stableNormalized();
}

std::vector<FlatFace> flat_faces(const Surface& surface, std::span<const Vector3d> x) {
  std::vector<FlatFace> flat;
  for (const auto& face : surface.faces) {
    const auto nodes = values_of(face, x);
    Vector3d sum(0, 0, 0);
    for (int i = 0; i < face.node_count; ++i)
      add_scaled(1, column_of(nodes, i), sum);
    const Vector3d centre(sum[0] / face.node_count, sum[1] / face.node_count, sum[2] / face.node_count);
    double size = 0;
    for (int i = 0; i < face.node_count; ++i)
      size = std::max(size, length_of(difference_of(column_of(nodes, i), centre)));
    flat.push_back({centre, unit_normal(face.type, nodes), size});
  }
  return flat;
}

/// How soon two faces meet: the distance between them, more where they are beside each other, and much more
/// where they are askew: next to a fold the nearest faces that look at each other are neighbours of
/// neighbours.
double apart_of(const FlatFace& one, const FlatFace& other) {
  const auto way = difference_of(other.centre, one.centre);
  const auto across = unit_of(difference_of(one.normal, other.normal));
  const double ahead = dot(way, across);
  const double beside = std::sqrt(std::max(0.0, dot(way, way) - ahead * ahead));
  const double beyond = std::max(0.0, beside - one.size - other.size);
  return (std::hypot(ahead, beyond) + sideways * beside) / std::pow(-dot(one.normal, other.normal), 4);
}

/// From one corner to the other, grown by a distance to all sides.
mortar::Box box_around(const Vector3d& low, const Vector3d& high, double distance) {
  const Vector3d grown(distance, distance, distance);
  return {difference_of(low, grown), sum_of(high, grown)};
}

/// Pairs (low, high) of faces near each other, found by boxes around the flat ones grown by a distance.
std::vector<std::pair<int, int>> near_pairs(std::span<const FlatFace> faces, double distance) {
  std::vector<mortar::Box> boxes;
  for (const auto& face : faces)
    boxes.push_back(box_around(face.centre, face.centre, face.size));
  mortar::FaceSearch search;
  search.build(boxes);
  std::vector<std::pair<int, int>> pairs;
  std::vector<int> near;
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    search.find(box_around(boxes[a].min(), boxes[a].max(), distance), near);
    for (const int b : near)
      if (at(b) > a)
        pairs.emplace_back(static_cast<int>(a), b);
  }
  return pairs;
}

bool look_at_each_other(const FlatFace& one, const FlatFace& other) {
  return dot(one.normal, other.normal) < facing;
}

/// How far each is behind the other; negative where one is in front.
double overlap_of(const FlatFace& one, const FlatFace& other) {
  const auto apart = difference_of(other.centre, one.centre);
  return std::min(-dot(apart, one.normal), dot(apart, other.normal));
}

std::vector<std::pair<int, int>> neighbours_of(const Surface& surface) {
  std::set<std::pair<int, int>> pairs;
  for (const auto& faces : surface.faces_of_node)
    for (std::size_t i = 0; i < faces.size(); ++i)
      for (std::size_t j = i + 1; j < faces.size(); ++j)
        pairs.insert(std::minmax(faces[i], faces[j]));
  return {pairs.begin(), pairs.end()};
}

/// Of each face those that share a node of the mesh with it, but none of the surface.
std::vector<std::vector<int>> across_edges(const Surface& surface) {
  std::map<mesh::NodeIndex, std::vector<int>> faces_of_node;
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (const auto node : surface.faces[f].node_span())
      faces_of_node[node].push_back(static_cast<int>(f));
  const auto are_joined = [&](const Face& one, const Face& other) {
    const auto positions = other.position_span();
    return std::ranges::any_of(one.position_span(), [&](int position) {
      return std::ranges::find(positions, position) != positions.end();
    });
  };
  std::vector<std::vector<int>> across(surface.faces.size());
  for (const auto& [node, faces] : faces_of_node)
    for (const int one : faces)
      for (const int other : faces)
        if (!are_joined(surface.faces[at(one)], surface.faces[at(other)]))
          across[at(one)].push_back(other);
  return across;
}

} // namespace

std::vector<Vector3d> unit_normals(const Surface& surface, std::span<const Vector3d> x) {
  std::vector<Vector3d> normals;
  for (const auto& face : surface.faces)
    normals.push_back(unit_normal(face.type, values_of(face, x)));
  return normals;
}

SelfPairs::SelfPairs(const Surface& surface, std::span<const Vector3d> undeformed, double reach)
    : surface_(&surface), reach_(reach), undeformed_(flat_faces(surface, undeformed)), now_(undeformed_),
      start_(undeformed.begin(), undeformed.end()), thickness_(surface.faces.size(), INFINITY),
      neighbours_(neighbours_of(surface)), across_edge_(across_edges(surface)),
      role_(surface.faces.size(), Role::none) {
  measure_thickness();
}

/// Of the sides of a thin part those count that are behind each other, not beside.
void SelfPairs::measure_thickness() {
  for (const auto& [low, high] : near_pairs(undeformed_, margin * reach_)) {
    const auto &one = undeformed_[at(low)], &other = undeformed_[at(high)];
    if (!back_to_back(at(low), at(high)))
      continue;
    const double thickness = overlap_of(one, other);
    const auto apart = difference_of(other.centre, one.centre);
    const double beside = std::sqrt(std::max(0.0, dot(apart, apart) - thickness * thickness));
    if (beside > one.size + other.size || dot(one.normal, other.normal) > opposite)
      continue;
    for (const auto face : {at(low), at(high)})
      thickness_[face] = std::min(thickness_[face], thickness);
  }
}

bool SelfPairs::face_each_other(std::span<const Vector3d> normals, int one, int other) const {
  return dot(normals[at(one)], normals[at(other)]) < facing;
}

bool SelfPairs::share_a_node(const Face& one, const Face& other) const {
  return std::ranges::any_of(one.node_span(), [&](auto node) {
    return std::ranges::find(other.node_span(), node) != other.node_span().end();
  });
}

/// Undeformed each behind the other, and near enough to meet through the body.
bool SelfPairs::back_to_back(std::size_t one, std::size_t other) const {
  const auto &a = undeformed_[one], &b = undeformed_[other];
  return look_at_each_other(a, b) && overlap_of(a, b) > 0 &&
         length_of(difference_of(b.centre, a.centre)) < margin * reach_ + a.size + b.size;
}

/// Whether one stands behind the other where the step begins, by more than faces that touch overlap: a body
/// is between them.
bool SelfPairs::is_behind(std::size_t one, std::size_t other) const {
  const auto &a = now_[one], &b = now_[other];
  const auto apart = difference_of(b.centre, a.centre);
  const double behind = std::max(-dot(apart, a.normal), dot(apart, b.normal));
  return behind > std::min(through * std::min(thickness_[one], thickness_[other]), a.size + b.size);
}

/// Whether a face beyond a sharp edge of the one looks at the other more: at the edge it is that which meets
/// it.
bool SelfPairs::is_passed_over(std::size_t one, std::size_t other) const {
  const auto product = [&](std::size_t face) { return dot(now_[face].normal, now_[other].normal); };
  const double own = product(one) - more_opposite;
  return std::ranges::any_of(across_edge_[one], [&](int face) { return product(at(face)) < own; });
}

bool SelfPairs::may_meet(int one, int other) const {
  return one != other && !share_a_node(surface_->faces[at(one)], surface_->faces[at(other)]) &&
         !back_to_back(at(one), at(other)) && !is_behind(at(one), at(other)) &&
         !is_passed_over(at(one), at(other)) && !is_passed_over(at(other), at(one));
}

std::vector<SelfPairs::Meeting> SelfPairs::meetings() const {
  std::vector<Meeting> found;
  for (const auto& [one, other] : near_pairs(now_, margin * reach_))
    if (look_at_each_other(now_[at(one)], now_[at(other)]) && may_meet(one, other))
      found.push_back({one, other, apart_of(now_[at(one)], now_[at(other)])});
  return found;
}

double SelfPairs::reach_at(std::span<const Vector3d> x) const {
  return reach_ + 2 * farthest_motion(start_, x, mean_motion(start_, x));
}

void SelfPairs::update(std::span<const Vector3d> x) {
  start_.assign(x.begin(), x.end());
  now_ = flat_faces(*surface_, x);
  give_roles(meetings());
}

void SelfPairs::give_roles(std::span<const Meeting> meetings) {
  std::vector<double> soonest(now_.size(), INFINITY);
  std::vector<Joint> joints;
  for (const auto& meeting : meetings) {
    joints.push_back({meeting.apart, true, meeting.one, meeting.other});
    for (const auto face : {at(meeting.one), at(meeting.other)})
      soonest[face] = std::min(soonest[face], meeting.apart);
  }
  for (const auto& [one, other] : neighbours_)
    if (const double apart = std::max(soonest[at(one)], soonest[at(other)]); std::isfinite(apart))
      joints.push_back({apart, false, one, other});
  const auto sides = two_sides(now_.size(), std::move(joints));
  const auto upper = farther_sides(sides, undeformed_);
  for (std::size_t f = 0; f < role_.size(); ++f) {
    const bool meets = std::isfinite(soonest[f]);
    role_[f] = !meets ? Role::none : upper[f] != 0 ? Role::slave : Role::master;
  }
}

/// Of faces without an order of their sides, by their undeformed places: the farther one along the axis on
/// which they are farthest apart.
bool SelfPairs::is_before(int one, int other) const {
  const auto &a = undeformed_[at(one)], &b = undeformed_[at(other)];
  const auto apart = difference_of(a.centre, b.centre);
  const int axis = strongest_axis(apart);
  return std::abs(apart[axis]) > same_place * (a.size + b.size) ? apart[axis] > 0 : one > other;
}

bool SelfPairs::may_pair(int slave_face, int master_face) const {
  if (!may_meet(slave_face, master_face))
    return false;
  const auto slave = role_[at(slave_face)], master = role_[at(master_face)];
  if (slave == master)
    return is_before(slave_face, master_face);
  return slave == Role::slave || (slave == Role::none && master == Role::master);
}

} // namespace rubato::contact
