// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/tie.hpp"

#include "rubato/contact/frozen_frame.hpp"
#include "rubato/contact/mortar/operators.hpp"
#include "rubato/contact/motion.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Distance along the master, in its shortest edges, beyond which a clamped projection is beside it.
constexpr double beside = 0.05;

/// Turns the frame to the axes and counts gap and slip from where nothing is displaced.
void hold_components(const Configuration& rest, Kinematics& k) {
  k.facing = k.normal;
  k.normal = {1, 0, 0};
  k.tangents.setZero();
  k.tangents(1, 0) = k.tangents(2, 1) = 1;
  k.closest_point.setZero();
  k.obstacle_displacement.setZero();
  k.gap_origin = dot(k.normal, k.stencil.sum([&](auto node) { return rest.position(node); }));
  k.slip_origin.setZero();
  k.gap = 0;
  k.slip.setZero();
  k = with_frozen_frame(std::move(k));
}

// ---- points on nodes

/// Whether the point stands before the master, not beside it or far from it.
bool stands_before(const Zone& zone, const Kinematics& k, const Configuration& rest) {
  const Vector3d apart = k.stencil.sum([&](auto node) { return rest.position(node); });
  const double along = length_of(part_across(k.normal, apart));
  return along <= beside * zone.master.shortest_edge &&
         std::abs(dot(apart, k.normal)) <= zone.slave.longest_edge;
}

void release_held(const Zone& zone, std::size_t position, Stencil& stencil) {
  stencil.by_component.resize(stencil.weights.size(), 3);
  for (int c = 0; c < 3; ++c) {
    const bool held = c < stencil.components && zone.is_held(position, c);
    for (Index i = 0; i < stencil.weights.size(); ++i)
      stencil.by_component(i, c) = held ? 0 : stencil.weights[i];
  }
}

std::vector<PointEvaluation> tied_nodes(const Zone& zone, const Configuration& rest) {
  std::vector<PointEvaluation> points;
  NeighbourList neighbours(zone);
  measure(neighbours, VectorXd::Zero(zone.multiplier_count()), rest, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& kinematics = points[i].kinematics;
    if (!kinematics)
      continue;
    if (zone.points[i].excluded || !stands_before(zone, *kinematics, rest)) {
      points[i].pair = {};
      kinematics.reset();
      continue;
    }
    release_held(zone, static_cast<std::size_t>(zone.points[i].node_position), kinematics->stencil);
    hold_components(rest, *kinematics);
  }
  return points;
}

// ---- mortar

/// Who has a function for that component.
std::vector<mortar::Keep> keep_of(const Zone& zone, int component) {
  std::vector<mortar::Keep> keep(zone.points.size(), mortar::Keep::by_cover);
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (zone.points[i].excluded)
      keep[i] = mortar::Keep::always;
    else if (zone.is_held(i, component))
      keep[i] = mortar::Keep::never;
  return keep;
}

/// One for each component.
std::vector<mortar::Operators> operators_of(const Zone& zone, const Configuration& rest) {
  const auto slave = positions_of(zone.slave, rest);
  const auto master = positions_of(zone.master, rest);
  std::map<std::vector<mortar::Keep>, mortar::Operators> known;
  std::vector<mortar::Operators> all;
  for (int c = 0; c < zone.space_dimension; ++c) {
    const auto keep = keep_of(zone, c);
    auto at = known.find(keep);
    if (at == known.end()) {
      const mortar::Options options{.held = zone.held, .keep = keep, .all_layers = true};
      at =
          known
              .emplace(keep, mortar::integrate(zone.slave, *zone.mortar, zone.master, slave, master, options))
              .first;
    }
    all.push_back(at->second);
  }
  return all;
}

/// The stencils of all components as one: weights are counted in those of the first one that there is.
Stencil joined(std::span<const mortar::Operators> operators, std::size_t node, double weight) {
  Stencil stencil;
  stencil.components = static_cast<int>(operators.size());
  std::map<mesh::NodeIndex, std::array<double, 3>> rows;
  for (std::size_t c = 0; c < operators.size(); ++c) {
    const auto& of_component = operators[c].nodes[node];
    for (std::size_t i = 0; of_component.kept() && i < of_component.stencil.nodes.size(); ++i)
      rows[of_component.stencil.nodes[i]][c] +=
          of_component.weight / weight * of_component.stencil.weights[static_cast<Index>(i)];
  }
  stencil.by_component.resize(static_cast<Index>(rows.size()), 3);
  stencil.weights.resize(static_cast<Index>(rows.size()));
  for (const auto& [at, row] : rows) {
    const auto i = static_cast<Index>(stencil.nodes.size());
    stencil.weights[i] = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      stencil.by_component(i, static_cast<Index>(c)) = row[c];
      stencil.weights[i] = std::max(stencil.weights[i], std::abs(row[c]));
    }
    stencil.nodes.push_back(at);
  }
  return stencil;
}

std::vector<PointEvaluation> tied_by_mortar(const Zone& zone, const Configuration& rest) {
  const auto operators = operators_of(zone, rest);
  std::vector<PointEvaluation> points(zone.points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto kept = std::find_if(operators.begin(), operators.end(),
                                   [&](const mortar::Operators& by) { return by.nodes[i].kept(); });
    if (kept == operators.end() || zone.points[i].excluded)
      continue;
    const auto& node = kept->nodes[i];
    auto& k = points[i].kinematics.emplace();
    points[i].pair = Pair::before_obstacle();
    points[i].cover = node.weight / zone.points[i].area;
    k.stencil = joined(operators, i, node.weight);
    k.parametric_dimension = zone.space_dimension - 1;
    k.normal = node.normal;
    hold_components(rest, k);
  }
  return points;
}

} // namespace

std::vector<PointEvaluation> tied_points(const Zone& zone, const Configuration& rest) {
  return zone.mortar ? tied_by_mortar(zone, rest) : tied_nodes(zone, rest);
}

} // namespace rubato::contact
