// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/directions.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/index.hpp"

#include <algorithm>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

/// A node that is farther from what the master covers, in faces, hangs over an edge of the master.
constexpr double edge_width = 0.05;
/// Kinks of a master count from about here on: of 0.16 degrees.
constexpr double least_kink = 1e-6;
/// A mean of unit normals below that has no direction.
constexpr double no_mean = 1e-3;

/// Integrals over the parts around one slave node, of the master before it.
struct Faced {
  Vector3d normals = Vector3d::Zero(); ///< ∫Φ_j n_m
  double kinks = 0;                    ///< ∫H_j ΣN_l κ_l
  double edges = 0;                    ///< the same of nodes at edges
  double area = 0;                     ///< ∫H_j
  double overhang = 1;
  double border = 0; ///< 1 where the master ends before a face of the node
};

void add_normals(const Workspace::Impl& work, std::vector<Faced>& faced) {
  for (const auto& share : work.shares) {
    const auto& normals = work.parts[at(share.part)].faced.normals;
    for (int i = 0; i < 4; ++i)
      for (int c = 0; c < 3; ++c)
        faced[at(share.node)].normals[c] += share.row[i] * normals(i, c);
  }
}

void add_kinks(const Surface& slave, const Part& part, std::vector<Faced>& faced) {
  const auto& face = slave.faces[at(part.face)];
  const auto& facet = subfacets(face.type)[at(part.facet)];
  for (int i = 0; i < facet.node_count; ++i) {
    auto& of = faced[at(face.positions[facet.nodes[at(i)]])];
    of.kinks += part.faced.kinks[i];
    of.edges += part.faced.edges[i];
    of.area += part.covered.first[i];
    of.overhang = std::min(of.overhang, part.faced.overhang[at(i)]);
    of.border = std::max(of.border, part.faced.border);
  }
}

/// α
double share_of_slave(const Faced& of, double slave_kink, bool at_edge) {
  const double beyond = std::min(1., of.overhang / edge_width);
  const double slave = slave_kink + (at_edge ? 1 - beyond : 0);
  const double ends = slave_kink > 0 ? std::max(0., 1 - (1 - of.border) / edge_width) : 1;
  const double master = beyond + (of.kinks + (at_edge ? 0 : ends * of.edges)) / of.area;
  return master / (slave + master + least_kink);
}

} // namespace

void set_directions(const Surface& slave, const SlaveReference& reference, std::span<const Vector3d> slave_x,
                    const Options& options, const Workspace::Impl& work, Operators& into) {
  std::vector<Faced> faced(slave.nodes.size());
  add_normals(work, faced);
  for (const auto& part : work.parts)
    add_kinks(slave, part, faced);
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    auto& node = into.nodes[j];
    const auto& of = faced[j];
    const double size = length_of(of.normals);
    if (!node.kept() || !(size > no_mean * node.weight) || !(of.area > 0))
      continue;
    const double share = share_of_slave(of, reference.kinks[j], slave.at_edge[j] != 0);
    Vector3d direction =
        difference_of(scaled(share, work.normals[j]), scaled((1 - share) / size, of.normals));
    if (!(length_of(direction) > no_mean))
      continue;
    direction = unit_of(direction);
    if (!options.held.empty())
      remove_held(options.held[j], direction);
    if (reference.on_axis[j] != 0)
      remove_held(radial, direction);
    const auto neighbour = at(reference.tangent_neighbour[j]);
    const auto frame =
        frame_of(direction, difference_of(slave_x[neighbour], slave_x[j]), reference.dimension);
    node.normal = frame.normal;
    node.tangents = frame.tangents;
  }
}

} // namespace rubato::contact::mortar
