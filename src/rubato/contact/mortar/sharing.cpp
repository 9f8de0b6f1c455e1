// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/core/index.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector4d;

constexpr std::array all_kept{true, true, true, true};

/// The sharing of one configuration; lives as long as share_functions.
class Sharing {
public:
  Sharing(const Surface& slave, const SlaveReference& reference, const Options& options,
          Workspace::Impl& workspace, Operators& into)
      : slave_(slave), reference_(reference), options_(options), work_(workspace), into_(into) {}

  void decide_kept() {
    measure_cover();
    work_.kept.assign(slave_.nodes.size(), 0);
    for (std::size_t j = 0; j < slave_.nodes.size(); ++j)
      work_.kept[j] = can_be_kept(j) && (keep_of(j) == Keep::always || has_enough(j)) ? 1 : 0;
    keep_lonely_faces();
  }

  void share() {
    work_.shares.clear();
    for (std::size_t p = 0; p < work_.parts.size(); ++p) {
      const auto& part = work_.parts[p];
      if (!share_in_facet(static_cast<int>(p)))
        share_equally(static_cast<int>(p));
      for (int i = 0; i < facet_of(part).node_count; ++i)
        name_heirs(node_of(part, i));
    }
  }

private:
  const Face& face_of(const Part& part) const { return slave_.faces[at(part.face)]; }
  const SubFacet& facet_of(const Part& part) const { return subfacets(face_of(part).type)[at(part.facet)]; }
  int node_of(const Part& part, int i) const { return face_of(part).positions[facet_of(part).nodes[at(i)]]; }
  Keep keep_of(std::size_t node) const {
    return options_.keep.empty() ? Keep::by_cover : options_.keep[node];
  }
  bool can_be_kept(std::size_t node) const {
    return work_.covered[node] > 0 && keep_of(node) != Keep::never && !work_.normals[node].isZero(0);
  }
  bool has_enough(std::size_t node) const {
    const double least = options_.least_shares.empty() ? least_kept_share : options_.least_shares[node];
    return work_.covered[node] >= least * reference_.full_weight[node];
  }
  bool is_kept(int node) const { return work_.kept[at(node)] != 0; }

  void measure_cover() {
    work_.covered.assign(slave_.nodes.size(), 0);
    for (const auto& part : work_.parts)
      for (int i = 0; i < facet_of(part).node_count; ++i)
        work_.covered[at(node_of(part, i))] += part.covered.first[i];
  }

  bool has_kept_node(const Face& face) const {
    return std::ranges::any_of(face.position_span(), [&](int node) { return is_kept(node); });
  }
  bool has_kept_node_around(const Face& face) const {
    return std::ranges::any_of(face.position_span(), [&](int node) {
      return std::ranges::any_of(slave_.faces_of_node[at(node)],
                                 [&](int other) { return has_kept_node(slave_.faces[at(other)]); });
    });
  }

  /// Faces that nobody around could take the functions of keep their nodes: else a body smaller than a slave
  /// face would not be felt.
  void keep_lonely_faces() {
    work_.takers.clear();
    for (const auto& part : work_.parts)
      if (!has_kept_node_around(face_of(part)))
        work_.takers.push_back(part.face);
    for (const int face : work_.takers)
      for (const int node : slave_.faces[at(face)].position_span())
        if (can_be_kept(at(node)))
          work_.kept[at(node)] = 1;
  }

  /// Kept nodes of the sub-facet share and make dual; false without any.
  bool share_in_facet(int index) {
    const auto& part = work_.parts[at(index)];
    const int count = facet_of(part).node_count;
    std::array<bool, 4> kept{};
    work_.takers.clear();
    for (int i = 0; i < count; ++i)
      if (is_kept(node_of(part, i))) {
        kept[at(i)] = true;
        work_.takers.push_back(node_of(part, i));
      }
    if (work_.takers.empty())
      return false;
    const bool all = static_cast<int>(work_.takers.size()) == count;
    const Eigen::Matrix4d rows =
        all ? part.dual : dual_coefficients(count, part.covered, full_area(reference_, part), kept);
    const auto areas = kept_areas(count, part.covered, kept);
    for (int i = 0; i < count; ++i)
      if (kept[at(i)])
        add(node_of(part, i), index, rows.row(i), areas[i], part.least_gaps[i]);
    return true;
  }

  /// Equal constant shares to the kept nodes of the face, else of the faces around it.
  void share_equally(int index) {
    const auto& part = work_.parts[at(index)];
    collect_kept(face_of(part));
    if (work_.takers.empty())
      for (const int node : face_of(part).position_span())
        for (const int other : slave_.faces_of_node[at(node)])
          collect_kept(slave_.faces[at(other)]);
    std::ranges::sort(work_.takers);
    work_.takers.erase(std::unique(work_.takers.begin(), work_.takers.end()), work_.takers.end());
    const double area = part.covered.first.sum();
    if (work_.takers.empty())
      into_.lost_area += area;
    const double share = 1. / static_cast<double>(std::max<std::size_t>(1, work_.takers.size()));
    for (const int node : work_.takers)
      add(node, index, Vector4d::Constant(share), share * area, -INFINITY);
  }

  void collect_kept(const Face& face) {
    for (const int node : face.position_span())
      if (is_kept(node))
        work_.takers.push_back(node);
  }

  /// The lift is ∫ of what a node's function sees too little.
  void add(int node, int part, const Vector4d& row, double area, double least_gap) {
    work_.shares.push_back({node, part, row});
    into_.nodes[at(node)].weight += area;
    const double lift = area > 0 ? area * least_gap - row.dot(work_.parts[at(part)].gaps) : 0;
    if (!(lift > 0))
      return;
    into_.nodes[at(node)].lift += lift;
    into_.nodes[at(node)].lift_slope += work_.parts[at(part)].overlaps ? area : 0;
  }

  void name_heirs(int node) {
    if (is_kept(node) || !(work_.covered[at(node)] > 0))
      return;
    auto& receivers = into_.nodes[at(node)].receivers;
    receivers.insert(receivers.end(), work_.takers.begin(), work_.takers.end());
    std::ranges::sort(receivers);
    receivers.erase(std::unique(receivers.begin(), receivers.end()), receivers.end());
  }

  const Surface& slave_;
  const SlaveReference& reference_;
  const Options& options_;
  Workspace::Impl& work_;
  Operators& into_;
};

void start_nodes(const Surface& slave, const SlaveReference& reference,
                 std::span<const Eigen::Vector3d> slave_x, const Workspace::Impl& work, Operators& into) {
  into.nodes.resize(slave.nodes.size());
  into.lost_area = 0;
  into.kept_count = 0;
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    auto& node = into.nodes[j];
    const auto frame = node_frame(reference, slave_x, work.normals, j);
    node.normal = frame.normal;
    node.tangents = frame.tangents;
    node.weight = 0;
    node.full_weight = reference.full_weight[j];
    node.cover = work.kept[j] != 0 ? Cover::kept : work.covered[j] > 0 ? Cover::dropped : Cover::none;
    node.anchor.setZero();
    node.gap = node.lift = node.lift_slope = 0;
    node.receivers.clear();
    into.kept_count += node.kept() ? 1 : 0;
  }
}

/// Σ of a share's row times products of a part.
void add_products(const Vector4d& row, const Products& products, const Face& face,
                  std::vector<double>& values, std::vector<int>& touched) {
  for (int k = 0; k < face.node_count; ++k) {
    const double product = row.dot(products.col(k));
    if (product == 0)
      continue;
    const int node = face.positions[at(k)];
    if (values[at(node)] == 0)
      touched.push_back(node);
    values[at(node)] += product;
  }
}

/// Moves the values of a node into its stencil and leaves zeros behind.
void take_values(const Surface& surface, double scale, std::vector<double>& values, std::vector<int>& touched,
                 Stencil& stencil, std::size_t first) {
  for (std::size_t i = 0; i < touched.size(); ++i) {
    stencil.nodes[first + i] = surface.nodes[at(touched[i])];
    stencil.weights[static_cast<Eigen::Index>(first + i)] = scale * values[at(touched[i])];
    values[at(touched[i])] = 0;
  }
  touched.clear();
}

/// Of a surface that touches itself: a node may be in the stencil on both sides, and for several sides of an
/// edge. It stands there once, with the sum of its weights.
int merge_repeats(std::size_t slave_nodes, Stencil& stencil) {
  std::size_t count = 0, of_slave = 0;
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
    const auto end = stencil.nodes.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::find(stencil.nodes.begin(), end, stencil.nodes[i]);
    const double weight = stencil.weights[static_cast<Eigen::Index>(i)];
    if (found != end) {
      stencil.weights[found - stencil.nodes.begin()] += weight;
      continue;
    }
    stencil.nodes[count] = stencil.nodes[i];
    stencil.weights[static_cast<Eigen::Index>(count++)] = weight;
    of_slave += i < slave_nodes ? 1U : 0U;
  }
  stencil.nodes.resize(count);
  stencil.weights.conservativeResize(static_cast<Eigen::Index>(count));
  return static_cast<int>(of_slave);
}

void sort_shares(std::size_t node_count, Workspace::Impl& work) {
  work.first_share.assign(node_count + 1, 0);
  for (const auto& share : work.shares)
    ++work.first_share[at(share.node) + 1];
  for (std::size_t j = 0; j < node_count; ++j)
    work.first_share[j + 1] += work.first_share[j];
  work.shares_by_node.resize(work.shares.size());
  auto next = std::vector<std::size_t>(work.first_share.begin(), work.first_share.end() - 1);
  for (std::size_t s = 0; s < work.shares.size(); ++s)
    work.shares_by_node[next[at(work.shares[s].node)]++] = static_cast<int>(s);
}

} // namespace

double full_area(const SlaveReference& reference, const Part& part) {
  return reference.facet_area[reference.first_facet[at(part.face)] + at(part.facet)];
}

void make_dual(const SlaveFace& placed, const SlaveReference& reference, const Workspace::Impl& work,
               Part& part) {
  const auto& facet = subfacets(placed.type)[at(part.facet)];
  part.dual = dual_coefficients(facet.node_count, part.covered, full_area(reference, part), all_kept);
  LeastGaps least(facet.node_count, part.covered, part.dual, part.gaps);
  for (const auto& seen : work.seen_gaps)
    least.see(seen.values, seen.gap);
  part.least_gaps = least.bounds(size_of(placed, facet));
  part.overlaps = least.overlaps();
}

void share_functions(const Surface& slave, const SlaveReference& reference,
                     std::span<const Eigen::Vector3d> slave_x, const Options& options,
                     Workspace::Impl& workspace, Operators& into) {
  Sharing sharing(slave, reference, options, workspace, into);
  sharing.decide_kept();
  start_nodes(slave, reference, slave_x, workspace, into);
  sharing.share();
  into.covered_area = 0;
  for (auto& node : into.nodes) {
    into.covered_area += node.weight;
    if (node.weight > 0) {
      node.lift /= node.weight;
      node.lift_slope /= node.weight;
    }
  }
}

void fill_stencils(const Surface& slave, const Surface* master, int components, Workspace::Impl& work,
                   Operators& into) {
  sort_shares(slave.nodes.size(), work);
  work.slave_values.assign(slave.nodes.size(), 0);
  work.master_values.assign(master != nullptr ? master->nodes.size() : 0, 0);
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    for (std::size_t s = work.first_share[j]; s < work.first_share[j + 1]; ++s) {
      const auto& share = work.shares[at(work.shares_by_node[s])];
      const auto& part = work.parts[at(share.part)];
      add_products(share.row, part.slave, slave.faces[at(part.face)], work.slave_values, work.slave_touched);
      if (master == nullptr)
        continue;
      for (std::size_t o = part.first_overlap; o < part.last_overlap; ++o) {
        const auto& overlap = work.overlaps[o];
        add_products(share.row, overlap.master, master->faces[at(overlap.master_face)], work.master_values,
                     work.master_touched);
      }
    }
    auto& node = into.nodes[j];
    auto& stencil = node.stencil;
    const auto count = work.slave_touched.size() + work.master_touched.size();
    stencil.components = components;
    stencil.nodes.resize(count);
    stencil.weights.resize(static_cast<Eigen::Index>(count));
    node.slave_nodes = static_cast<int>(work.slave_touched.size());
    const double scale = node.weight > 0 ? 1 / node.weight : 0;
    take_values(slave, scale, work.slave_values, work.slave_touched, stencil, 0);
    if (master != nullptr)
      take_values(*master, -scale, work.master_values, work.master_touched, stencil, at(node.slave_nodes));
    if (master == &slave)
      node.slave_nodes = merge_repeats(at(node.slave_nodes), stencil);
  }
}

} // namespace rubato::contact::mortar
