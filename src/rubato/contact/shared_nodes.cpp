// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/shared_nodes.hpp"

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/contact/zone_state.hpp"
#include "rubato/study/contact_methods.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::contact {
namespace {

/// The sine of 10 degrees.
constexpr double same_surface = 0.17;

bool shares_nodes(const Zone& zone) {
  return zone.points_own_multipliers && !zone.settings.tie;
}

/// The settings that two zones must have in common: only then their points on one node are one constraint.
study::ContactZone common_settings(study::ContactZone settings) {
  settings.name.clear();
  settings.slave.clear();
  settings.friction = 0;
  settings.friction_in_place.reset();
  settings.exclude_nodes.clear();
  return settings;
}

bool can_be_joined(const Zone& zone) {
  return shares_nodes(zone) && !zone.mortar && !zone.meets_itself() &&
         study::entry_of(zone.settings.method).exact && zone.settings.normal == study::ContactNormal::master;
}

bool are_one_constraint(const Zone& a, const Zone& b) {
  return a.master.nodes == b.master.nodes && a.master.faces.size() == b.master.faces.size() &&
         common_settings(a.settings) == common_settings(b.settings);
}

using PointsOfNodes = std::map<mesh::NodeIndex, std::vector<PointOfZone>>;

template <class Wanted> PointsOfNodes points_of_nodes(std::span<const Zone> zones, const Wanted& is_wanted) {
  PointsOfNodes of_node;
  for (std::size_t z = 0; z < zones.size(); ++z)
    for (std::size_t i = 0; is_wanted(zones[z]) && i < zones[z].points.size(); ++i)
      if (const auto& point = zones[z].points[i]; !point.excluded && point.node_position >= 0)
        of_node[zones[z].slave.nodes[static_cast<std::size_t>(point.node_position)]].push_back({z, i});
  return of_node;
}

/// Joins points that are one constraint. The areas that weigh friction are those of the points' own faces.
void join(std::span<Zone> zones, std::span<const PointOfZone> points) {
  const auto point_of = [&](const PointOfZone& at) -> SlavePoint& { return zones[at.zone].points[at.point]; };
  const auto rubs = [&](const PointOfZone& at) { return zones[at.zone].settings.friction > 0; };
  auto first = std::ranges::find_if(points, rubs);
  if (first == points.end())
    first = points.begin();
  auto& zone = zones[first->zone];
  double area = 0, friction = 0;
  std::vector<PointShare> shares;
  for (const auto& at : points) {
    const double own = point_of(at).area;
    shares.push_back({at.zone, at.point, own});
    area += own;
    friction += own * zones[at.zone].friction_at(at.point, zones[at.zone].settings.friction);
    point_of(at).excluded = true;
  }
  auto& representing = point_of(*first);
  representing.excluded = false;
  representing.shares = std::move(shares);
  representing.area = area;
  representing.weight = zone.unit_weights ? 1 : area;
  if (!rubs(*first))
    return;
  if (zone.friction_shares.empty())
    zone.friction_shares.assign(zone.points.size(), 1.0);
  zone.friction_shares[first->point] = friction / area / zone.settings.friction;
}

PointOutcome part_of(const PointOutcome& whole, double part) {
  auto outcome = whole;
  outcome.normal = scaled(part, whole.normal);
  outcome.tangential = scaled(part, whole.tangential);
  outcome.area = part * whole.area;
  return outcome;
}

/// Multipliers are pressures, of nodal methods forces.
void copy_multipliers(const Zone& from, const SlavePoint& of, const Eigen::VectorXd& values, const Zone& to,
                      const SlavePoint& into, double part, Eigen::VectorXd& copied) {
  const int count = std::min(from.multipliers_per_node(), to.multipliers_per_node());
  for (int m = 0; m < count; ++m)
    copied[into.node_position * to.multipliers_per_node() + m] =
        values[of.node_position * from.multipliers_per_node() + m] * (from.unit_weights && m == 0 ? part : 1);
}

} // namespace

void join_shared_points(std::span<Zone> zones) {
  for (auto& [node, all] : points_of_nodes(zones, can_be_joined)) {
    std::span<PointOfZone> left(all);
    while (left.size() > 1) {
      const auto first = left.front();
      const auto others = std::ranges::stable_partition(
          left, [&](const PointOfZone& at) { return are_one_constraint(zones[at.zone], zones[first.zone]); });
      const auto alike = left.first(left.size() - others.size());
      const bool several = std::ranges::any_of(alike, [&](const auto& at) { return at.zone != first.zone; });
      const bool on_axis = std::ranges::any_of(
          alike, [&](const auto& at) { return zones[at.zone].points[at.point].axis_pressure.has_value(); });
      if (several && !on_axis)
        join(zones, alike);
      left = left.last(others.size());
    }
  }
}

void distribute_shared_points(std::span<const Zone> zones, std::span<ZoneState> states) {
  if (zones.size() < 2)
    return;
  for (std::size_t z = 0; z < zones.size(); ++z)
    for (std::size_t i = 0; i < zones[z].points.size(); ++i) {
      const auto& point = zones[z].points[i];
      if (point.shares.empty())
        continue;
      const auto whole = states[z].outcomes[i];
      for (const auto& share : point.shares) {
        const double part = share.area / point.area;
        auto& state = states[share.zone];
        state.outcomes[share.point] = part_of(whole, part);
        state.status[share.point] = states[z].status[i];
        if (share.zone != z || share.point != i)
          copy_multipliers(zones[z], point, states[z].multipliers, zones[share.zone],
                           zones[share.zone].points[share.point], part, state.multipliers);
      }
    }
}

PointOutcome whole_outcome(const Zone& zone, std::size_t point, const PointOutcome& outcome) {
  return outcome.area > 0 ? part_of(outcome, zone.points[point].area / outcome.area) : outcome;
}

std::vector<std::vector<PointOfZone>> points_of_shared_nodes(std::span<const Zone> zones) {
  std::vector<std::vector<PointOfZone>> groups;
  for (auto& [node, points] : points_of_nodes(zones, shares_nodes))
    if (points.size() > 1 &&
        std::ranges::any_of(points, [&](const auto& p) { return zones[p.zone].settings.friction > 0; }))
      groups.push_back(std::move(points));
  return groups;
}

FrictionDirections common_directions(const Kinematics& of, std::span<const Eigen::Vector3d> normals) {
  const bool in_plane = of.stencil.components == 2;
  FrictionDirections left;
  for (const auto& normal : normals) {
    const Eigen::Vector2d across(dot(column_of(of.tangents, 0), normal),
                                 dot(column_of(of.tangents, 1), normal));
    const double size = in_plane ? std::abs(across[0]) : length_of(across);
    if (size <= same_surface)
      continue;
    if (in_plane || (left.count == 1 && std::abs(dot(across, left.only)) > same_surface))
      return {.count = 0};
    left = {.count = 1, .only = {-across[1] / size, across[0] / size}};
  }
  return left;
}

} // namespace rubato::contact
