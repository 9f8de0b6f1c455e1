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

/// Gaps up to this part of the zone's edge are rounding of coordinates that were computed.
constexpr double no_gap = 1e-9;

NodePlace places_at(const Configuration& rest) {
  return [&rest](mesh::NodeIndex node) { return rest.position(node); };
}

/// Adds the gap of a point for some components of its constraint, unless the surfaces touch there.
void add_gap(const Zone& zone, const Configuration& rest, std::span<const SurfaceGradient> gradients,
             const Vector3d& gap, const std::array<bool, 3>& rows, const Kinematics& k,
             std::vector<TieGap>& gaps) {
  if (!(length_of(gap) > no_gap * zone.edge()))
    return;
  auto made = make_tie_gap(k.stencil, gradients, gap, k.normal, places_at(rest));
  made.rows = rows;
  if (!made.places.empty())
    gaps.push_back(std::move(made));
}

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

/// Of a point on a node, which faces one place of the master.
void add_gap_of_node(const Zone& zone, std::size_t position, const Pair& pair, const Configuration& rest,
                     Kinematics& k, std::vector<TieGap>& gaps) {
  const auto& face = zone.master.faces[static_cast<std::size_t>(pair.master_face)];
  const auto of_face = surface_gradients(face.type, deformed(face, rest), pair.projection.clamped);
  std::vector<SurfaceGradient> gradients;
  const auto slave_nodes = k.stencil.nodes.size() - static_cast<std::size_t>(face.node_count);
  for (std::size_t l = 0; l < static_cast<std::size_t>(face.node_count); ++l)
    gradients.push_back({slave_nodes + l, of_face[l]});
  std::array<bool, 3> rows{};
  for (int c = 0; c < k.stencil.components; ++c)
    rows[static_cast<std::size_t>(c)] = !zone.is_held(position, c);
  const Vector3d gap = k.stencil.sum(places_at(rest));
  add_gap(zone, rest, gradients, gap, rows, k, gaps);
}

Ties tied_nodes(const Zone& zone, const Configuration& rest) {
  Ties ties;
  auto& points = ties.points;
  NeighbourList neighbours(zone);
  measure(neighbours, VectorXd::Zero(zone.multiplier_count()), rest, points);
  ties.gaps.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    auto& kinematics = points[i].kinematics;
    if (!kinematics)
      continue;
    if (zone.points[i].excluded || !stands_before(zone, *kinematics, rest)) {
      points[i].pair = {};
      kinematics.reset();
      continue;
    }
    const auto position = static_cast<std::size_t>(zone.points[i].node_position);
    add_gap_of_node(zone, position, points[i].pair, rest, *kinematics, ties.gaps[i]);
    release_held(zone, position, kinematics->stencil);
    turn(ties.gaps[i], places_at(rest), kinematics->stencil);
    hold_components(rest, *kinematics);
  }
  return ties;
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

/// Those of each component, the index of the first component that has the same ones.
struct OperatorsByComponent {
  std::vector<mortar::Operators> operators;
  std::vector<std::size_t> first;
};

OperatorsByComponent operators_of(const Zone& zone, const Configuration& rest) {
  const auto slave = positions_of(zone.slave, rest);
  const auto master = positions_of(zone.master, rest);
  std::map<std::vector<mortar::Keep>, std::size_t> known;
  OperatorsByComponent all;
  for (int c = 0; c < zone.space_dimension; ++c) {
    const auto keep = keep_of(zone, c);
    const auto first = known.emplace(keep, all.operators.size()).first->second;
    if (first < all.operators.size())
      all.operators.push_back(all.operators[first]);
    else {
      const mortar::Options options{.held = zone.held, .keep = keep, .all_layers = true, .gradients = true};
      all.operators.push_back(
          mortar::integrate(zone.slave, *zone.mortar, zone.master, slave, master, options));
    }
    all.first.push_back(first);
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

/// The gaps of a node whose stencils are joined, one for the components that have the same operators.
/// `weight`: that of the point.
void add_gaps_by_mortar(const Zone& zone, const OperatorsByComponent& by, std::size_t node, double weight,
                        const Configuration& rest, const Kinematics& k, std::vector<TieGap>& gaps) {
  for (std::size_t c = 0; c < by.operators.size(); ++c) {
    const auto& of = by.operators[c].nodes[node];
    if (by.first[c] != c || !of.kept())
      continue;
    std::vector<SurfaceGradient> gradients;
    for (std::size_t i = 0; i < of.stencil.nodes.size(); ++i) {
      const auto place = std::ranges::find(k.stencil.nodes, of.stencil.nodes[i]) - k.stencil.nodes.begin();
      const auto row = static_cast<Index>(i);
      gradients.push_back({static_cast<std::size_t>(place),
                           {of.gradients(row, 0), of.gradients(row, 1), of.gradients(row, 2)}});
    }
    std::array<bool, 3> rows{};
    for (std::size_t other = c; other < by.operators.size(); ++other)
      rows[other] = by.first[other] == c;
    const auto gap = scaled(of.weight / weight, of.stencil.sum(places_at(rest)));
    add_gap(zone, rest, gradients, gap, rows, k, gaps);
  }
}

Ties tied_by_mortar(const Zone& zone, const Configuration& rest) {
  const auto by = operators_of(zone, rest);
  const auto& operators = by.operators;
  Ties ties;
  auto& points = ties.points;
  points.resize(zone.points.size());
  ties.gaps.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto kept = std::find_if(operators.begin(), operators.end(),
                                   [&](const mortar::Operators& of) { return of.nodes[i].kept(); });
    if (kept == operators.end() || zone.points[i].excluded)
      continue;
    const auto& node = kept->nodes[i];
    auto& k = points[i].kinematics.emplace();
    points[i].pair = Pair::before_obstacle();
    points[i].cover = node.weight / zone.points[i].area;
    k.stencil = joined(operators, i, node.weight);
    k.parametric_dimension = zone.space_dimension - 1;
    k.normal = node.normal;
    add_gaps_by_mortar(zone, by, i, node.weight, rest, k, ties.gaps[i]);
    turn(ties.gaps[i], places_at(rest), k.stencil);
    hold_components(rest, k);
  }
  return ties;
}

} // namespace

Ties make_ties(const Zone& zone, const Configuration& rest) {
  return zone.mortar ? tied_by_mortar(zone, rest) : tied_nodes(zone, rest);
}

std::vector<PointEvaluation> tied_points(const Zone& zone, const Configuration& rest) {
  return make_ties(zone, rest).points;
}

void follow_turning(std::span<const TieGap> gaps, const Configuration& configuration, Kinematics& k) {
  if (gaps.empty())
    return;
  k.stencil.turning.clear();
  const Vector3d apart = k.stencil.sum(places_at(configuration));
  const auto turned = turn(gaps, places_at(configuration), k.stencil);
  k.facing = turned.facing;
  const auto misfit = difference_of(apart, turned.gap);
  k.gap_origin = dot(k.normal, k.stencil.sum(places_at(configuration))) - dot(k.normal, misfit);
  const Vector3d moved = k.stencil.sum([&](auto node) { return configuration.increment(node); });
  for (int a = 0; a < 2; ++a)
    k.slip_origin[a] = dot(column_of(k.tangents, a), moved) - dot(column_of(k.tangents, a), misfit);
  k = with_frozen_frame(std::move(k));
}

} // namespace rubato::contact
