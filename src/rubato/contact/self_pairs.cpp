// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/self_pairs.hpp"

#include "rubato/contact/mortar/search.hpp"
#include "rubato/contact/projection.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// Beyond this product of their normals two faces do not face each other (mortar/segments.hpp).
constexpr double facing = -0.1;
/// FacePatches are looked for that many reaches far: those that meet later in the step are in them.
constexpr double margin = 2;
/// An axis must be that much stronger than one before it: patches at an angle to the axes keep theirs.
constexpr double clearly = 1.5;
/// Part of a face's size that is rounding of its place.
constexpr double same_place = 1e-9;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

FaceCoordinates gathered(const Face& face, std::span<const Vector3d> x) {
  FaceCoordinates coordinates(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    coordinates.col(i) = x[at(face.positions[at(i)])];
  return coordinates;
}

Vector3d centre_of(const FaceCoordinates& x) {
  return x.rowwise().mean();
}

/// From the corners alone; in 2D (t_y, −t_x). 0 of a face without area.
Vector3d unit_normal(CellType type, const FaceCoordinates& x) {
  Vector3d normal;
  if (parametric_dimension(type) == 1) {
    const Vector3d along = x.col(1) - x.col(0);
    normal = {along.y(), -along.x(), 0};
  } else if (cell::topology(type).corner_count == 4) {
    normal = (x.col(2) - x.col(0)).cross(Vector3d(x.col(3) - x.col(1)));
  } else {
    normal = (x.col(1) - x.col(0)).cross(Vector3d(x.col(2) - x.col(0)));
  }
  return normal.stableNormalized();
}

/// The first axis that no later one is clearly stronger than.
int strongest(const Vector3d& strength) {
  int axis = 0;
  for (int c = 1; c < 3; ++c)
    if (strength[c] > clearly * strength[axis])
      axis = c;
  return axis;
}

/// Sets of faces, each with one of them that stands for it.
class FacePatches {
public:
  explicit FacePatches(std::size_t faces) : parent_(faces) { std::iota(parent_.begin(), parent_.end(), 0); }

  int root(int face) {
    while (parent_[at(face)] != face) {
      parent_[at(face)] = parent_[at(parent_[at(face)])];
      face = parent_[at(face)];
    }
    return face;
  }
  void join(int one, int other) { parent_[at(root(one))] = root(other); }

private:
  std::vector<int> parent_;
};

/// Joins faces around a node, of those that meet others.
void join_around_nodes(const Surface& surface, const std::vector<char>& meets, FacePatches& patches) {
  for (const auto& faces : surface.faces_of_node) {
    int first = -1;
    for (const int face : faces) {
      if (meets[at(face)] == 0)
        continue;
      if (first >= 0)
        patches.join(face, first);
      first = face;
    }
  }
}

} // namespace

std::vector<Vector3d> unit_normals(const Surface& surface, std::span<const Vector3d> x) {
  std::vector<Vector3d> normals;
  for (const auto& face : surface.faces)
    normals.push_back(unit_normal(face.type, gathered(face, x)));
  return normals;
}

SelfPairs::SelfPairs(const Surface& surface, std::span<const Vector3d> undeformed, double reach)
    : surface_(&surface), reach_(reach), axis_of_face_(surface.faces.size(), -1) {
  for (const auto& face : surface.faces) {
    const auto x = gathered(face, undeformed);
    centres_.push_back(centre_of(x));
    normals_.push_back(unit_normal(face.type, x));
    sizes_.push_back(std::sqrt((x.colwise() - centres_.back()).colwise().squaredNorm().maxCoeff()));
  }
}

bool SelfPairs::face_each_other(std::span<const Vector3d> normals, int one, int other) const {
  return normals[at(one)].dot(normals[at(other)]) < facing;
}

bool SelfPairs::share_a_node(const Face& one, const Face& other) const {
  return std::ranges::any_of(one.node_span(), [&](auto node) {
    return std::ranges::find(other.node_span(), node) != other.node_span().end();
  });
}

/// Each behind the other, and near enough to meet through the body.
bool SelfPairs::back_to_back(std::size_t one, std::size_t other) const {
  const Vector3d apart = centres_[other] - centres_[one];
  return normals_[one].dot(normals_[other]) < facing && apart.dot(normals_[one]) < 0 &&
         apart.dot(normals_[other]) > 0 && apart.norm() < margin * reach_ + sizes_[one] + sizes_[other];
}

bool SelfPairs::may_meet(int one, int other) const {
  return one != other && !share_a_node(surface_->faces[at(one)], surface_->faces[at(other)]) &&
         !back_to_back(at(one), at(other));
}

std::vector<SelfPairs::Meeting> SelfPairs::meetings(std::span<const Vector3d> x) const {
  std::vector<mortar::Box> boxes;
  for (const auto& face : surface_->faces)
    boxes.push_back(mortar::box_of(face.type, gathered(face, x)));
  const auto normals = unit_normals(*surface_, x);
  mortar::FaceSearch search;
  search.build(boxes);
  std::vector<Meeting> found;
  std::vector<int> near;
  const Vector3d grown = Vector3d::Constant(margin * reach_);
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    search.find(mortar::Box(boxes[a].min() - grown, boxes[a].max() + grown), near);
    for (const int b : near)
      if (at(b) > a && face_each_other(normals, static_cast<int>(a), b) && may_meet(static_cast<int>(a), b))
        found.emplace_back(static_cast<int>(a), b);
  }
  return found;
}

void SelfPairs::update(std::span<const Vector3d> x) {
  const auto pairs = meetings(x);
  std::vector<char> meets(surface_->faces.size(), 0);
  FacePatches patches(surface_->faces.size());
  for (const auto& [one, other] : pairs) {
    meets[at(one)] = meets[at(other)] = 1;
    patches.join(one, other);
  }
  join_around_nodes(*surface_, meets, patches);
  std::vector<Vector3d> strength(surface_->faces.size(), Vector3d::Zero());
  for (const auto& [one, other] : pairs)
    strength[at(patches.root(one))] += (centres_[at(one)] - centres_[at(other)]).cwiseAbs();
  for (std::size_t f = 0; f < meets.size(); ++f)
    axis_of_face_[f] = meets[f] != 0 ? strongest(strength[at(patches.root(static_cast<int>(f)))]) : -1;
}

/// The same of (a, b) and (b, a).
int SelfPairs::axis_of(std::size_t one, std::size_t other) const {
  const auto [low, high] = std::minmax(axis_of_face_[one], axis_of_face_[other]);
  if (low >= 0)
    return low;
  return high >= 0 ? high : strongest((centres_[one] - centres_[other]).cwiseAbs());
}

bool SelfPairs::may_pair(int slave_face, int master_face) const {
  if (!may_meet(slave_face, master_face))
    return false;
  const auto slave = at(slave_face), master = at(master_face);
  const Vector3d apart = centres_[slave] - centres_[master];
  const double least = same_place * (sizes_[slave] + sizes_[master]);
  const int first = axis_of(slave, master);
  for (int c = 0; c < 3; ++c) {
    const double along = apart[(first + c) % 3];
    if (std::abs(along) > least)
      return along > 0;
  }
  return slave > master;
}

} // namespace rubato::contact
