// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/neighbours.hpp"

#include "rubato/contact/motion.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// Part of the longest master edge: a wider margin makes searches rarer and each step's lists longer.
constexpr double margin_in_edges = 0.75;

/// How far beyond the border a point that hops stays on a face, in its reference lengths.
constexpr double kept_overshoot = 0.25;

/// Faces that touch are not farther apart than the longest of them.
std::optional<SelfPairs> self_pairs_of(const Zone& zone) {
  if (!zone.meets_itself())
    return std::nullopt;
  return SelfPairs(zone.master, zone.undeformed_master, zone.master.longest_edge);
}

} // namespace

NeighbourList::NeighbourList(const Zone& zone)
    : zone_(&zone), margin_(margin_in_edges * zone.master.longest_edge), master_(zone.master.nodes.size()),
      slave_(zone.points.size()),
      pairs_(zone.points.size(), zone.obstacle ? Pair::before_obstacle() : Pair()),
      visits_(zone.points.size()), self_(self_pairs_of(zone)) {}

void NeighbourList::forget_visits() {
  std::ranges::fill(visits_, Visits());
}

bool NeighbourList::release_beyond_borders() {
  bool any = false;
  for (auto& visits : visits_) {
    if (visits.kept_face < 0 || visits.released || visits.beyond <= tolerances.released_overshoot)
      continue;
    visits = {.faces = {visits.kept_face, -1, -1, -1}, .released = true};
    any = true;
  }
  return any;
}

void NeighbourList::update(const Configuration& configuration) {
  if (zone_->obstacle)
    return;
  follow(configuration);
  for (std::size_t i = 0; i < slave_.size(); ++i)
    pair(i);
}

void NeighbourList::update(const Configuration& configuration, std::span<const std::size_t> points) {
  if (zone_->obstacle)
    return;
  follow(configuration);
  for (const auto i : points)
    pair(i);
}

void NeighbourList::follow(const Configuration& configuration) {
  locate(configuration);
  if (self_)
    follow_itself(configuration);
  if (searches_ == 0 || 2 * moved_since_search() > margin_)
    search();
}

void NeighbourList::pair(std::size_t point) {
  auto& visits = visits_[point];
  if (visits.kept_face >= 0 && stays_on(point, visits.kept_face))
    return;
  auto& pair = pairs_[point];
  if (self_)
    pair_with_itself(point);
  else
    pair = pair_around(*zone_, nearest_of(point), slave_[point], master_, pair.master_face);
  if (pair.master_face != visits.faces.front() || visits.kept_face >= 0)
    note_visit(point);
}

/// The point has come to another face than it was on, or has left the one that kept it.
void NeighbourList::note_visit(std::size_t point) {
  auto& visits = visits_[point];
  visits.kept_face = -1;
  const int before = visits.faces.front();
  const int now = pairs_[point].master_face;
  if (before < 0)
    visits.faces.front() = now;
  if (before < 0 || now < 0 || now == before)
    return;
  const bool back = std::ranges::find(visits.faces, now) != visits.faces.end();
  std::ranges::copy_backward(std::span(visits.faces).first(visits.faces.size() - 1), visits.faces.end());
  visits.faces.front() = now;
  if (back && stays_on(point, std::min(before, now)))
    visits.kept_face = std::min(before, now);
}

/// Puts the point on a face, inside or a little beyond its border, if that is where it is.
bool NeighbourList::stays_on(std::size_t point, int face) {
  auto pair = pair_on(*zone_, face, slave_[point], master_);
  if (!pair.projection.converged || !(pair.projection.overshoot <= kept_overshoot))
    return false;
  visits_[point].beyond = pair.projection.overshoot;
  pair.projection.clamped = pair.projection.xi;
  pair.projection.clamp_derivative.setIdentity();
  pair.projection.overshoot = 0;
  pairs_[point] = pair;
  return true;
}

void NeighbourList::locate(const Configuration& configuration) {
  for (std::size_t j = 0; j < master_.size(); ++j)
    master_[j] = configuration.position(zone_->master.nodes[j]);
  for (std::size_t i = 0; i < slave_.size(); ++i)
    slave_[i] = position(zone_->points[i], configuration);
}

/// How much nearer to each other a slave point and a master node can have come.
double NeighbourList::moved_since_search() const {
  const Vector3d common = mean_motion(master_at_search_, master_);
  return farthest_motion(master_at_search_, master_, common) +
         farthest_motion(slave_at_search_, slave_, common);
}

void NeighbourList::search() {
  ++searches_;
  master_at_search_ = master_;
  slave_at_search_ = slave_;
  const PointTree tree(master_);
  start_.assign(1, 0);
  near_nodes_.clear();
  for (const auto& x : slave_) {
    const double reach =
        (self_ ? self_->reach_at(master_) : std::sqrt(tree.nearest(x).squared_distance)) + margin_;
    tree.append_within(x, reach, near_nodes_);
    start_.push_back(near_nodes_.size());
  }
}

std::size_t NeighbourList::nearest_of(std::size_t point) const {
  std::size_t nearest = 0;
  double least = INFINITY;
  for (auto k = start_[point]; k < start_[point + 1]; ++k) {
    const double squared = (master_[near_nodes_[k]] - slave_[point]).squaredNorm();
    // Of equally near nodes the first in the surface: the order of the list depends on where it was searched.
    if (squared > least || (squared == least && near_nodes_[k] > nearest))
      continue;
    least = squared;
    nearest = near_nodes_[k];
  }
  return nearest;
}

/// The patches are those of the step's start: iterations do not change who is whose slave.
void NeighbourList::follow_itself(const Configuration& configuration) {
  Points start;
  for (const auto node : zone_->master.nodes)
    start.push_back(configuration.start_position(node));
  if (start != step_start_) {
    step_start_ = std::move(start);
    self_->update(step_start_);
  }
  normals_ = unit_normals(zone_->master, master_);
}

/// Whether a face is the master of one that the point stands on, and looks towards it; all that look towards
/// it may meet it. At an edge of the body others look elsewhere.
bool NeighbourList::may_face(std::size_t point, int face) const {
  const auto& places = zone_->points[point].stands_on;
  const auto looks = [&](const PointOnFace& place) {
    return self_->face_each_other(normals_, place.face, face);
  };
  const auto met = [&](const PointOnFace& place) {
    return !looks(place) || self_->may_meet(place.face, face);
  };
  const auto mastered = [&](const PointOnFace& place) {
    return looks(place) && self_->may_pair(place.face, face);
  };
  return std::ranges::all_of(places, met) && std::ranges::any_of(places, mastered);
}

/// Of all faces around the nodes that are near, as of those around the nearest node else.
void NeighbourList::pair_with_itself(std::size_t point) {
  std::vector<int> faces;
  for (auto k = start_[point]; k < start_[point + 1]; ++k)
    for (const int face : zone_->master.faces_of_node[near_nodes_[k]])
      if (may_face(point, face))
        faces.push_back(face);
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  pairs_[point] = pair_among(*zone_, faces, slave_[point], master_);
}

} // namespace rubato::contact
