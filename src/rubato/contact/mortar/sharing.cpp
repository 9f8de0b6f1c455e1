// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/parts.hpp"
#include "rubato/contact/small_vectors.hpp"
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
    return work_.covered[node] > 0 && keep_of(node) != Keep::never && !is_zero(work_.normals[node]);
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
        add(node_of(part, i), index, {rows(i, 0), rows(i, 1), rows(i, 2), rows(i, 3)}, areas[i],
            part.bounds[at(i)]);
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
    std::sort(work_.takers.begin(), work_.takers.end());
    work_.takers.erase(std::unique(work_.takers.begin(), work_.takers.end()), work_.takers.end());
    const double area = total_of(part.covered.first);
    if (work_.takers.empty())
      into_.lost_area += area;
    const double share = 1. / static_cast<double>(std::max<std::size_t>(1, work_.takers.size()));
    for (const int node : work_.takers)
      add(node, index, Vector4d(share, share, share, share), share * area, {});
  }

  void collect_kept(const Face& face) {
    for (const int node : face.position_span())
      if (is_kept(node))
        work_.takers.push_back(node);
  }

  /// The lift is ∫ of what a node's function sees too little.
  void add(int node, int part, const Vector4d& row, double area, const LeastGaps::Bound& bound) {
    auto& share = work_.shares.emplace_back(Share{node, part, row, row});
    into_.nodes[at(node)].weight += area;
    const double lift = area > 0 ? area * bound.value - dot(row, work_.parts[at(part)].gaps) : 0;
    if (!(lift > 0))
      return;
    into_.nodes[at(node)].lift += lift;
    into_.nodes[at(node)].lift_slope += bound.by_least > 1 ? area : 0;
    for (int i = 0; i < 4; ++i)
      share.gap_row[i] = area * bound.row[i];
    share.by_least = area * bound.by_least;
  }

  void name_heirs(int node) {
    if (is_kept(node) || !(work_.covered[at(node)] > 0))
      return;
    auto& receivers = into_.nodes[at(node)].receivers;
    receivers.insert(receivers.end(), work_.takers.begin(), work_.takers.end());
    std::sort(receivers.begin(), receivers.end());
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
    node.slave_frame = node_frame(reference, slave_x, work.normals, j);
    node.normal = node.slave_frame.normal;
    node.tangents = node.slave_frame.tangents;
    node.weight = 0;
    node.full_weight = reference.full_weight[j];
    node.cover = work.kept[j] != 0 ? Cover::kept : work.covered[j] > 0 ? Cover::dropped : Cover::none;
    node.anchor.setZero();
    node.gap = node.lift = node.lift_slope = 0;
    node.receivers.clear();
    into.kept_count += node.kept() ? 1 : 0;
  }
}

/// Adds what a share has of products of a part.
void add_products(const Share& share, const Products& products, const Face& face, double sign,
                  NodeSums& sums) {
  for (int k = 0; k < face.node_count; ++k) {
    const Vector4d column(products(0, k), products(1, k), products(2, k), products(3, k));
    const double weight = sign * dot(share.row, column);
    sums.add(face.positions[at(k)], weight, share.is_lifted() ? sign * dot(share.gap_row, column) : weight);
  }
}

/// Adds what the gap of a share follows at one place of a face.
void add_place(double by, const Face& face, const Eigen::Vector2d& xi, NodeSums& sums) {
  const auto values = face_values(face.type, xi);
  for (int k = 0; k < face.node_count; ++k)
    sums.add(face.positions[at(k)], 0, by * values[at(k)]);
}

void add_least_gap(const Share& share, const SeenGap& least, const Face& slave, const Surface* master,
                   Workspace::Impl& work) {
  add_place(share.by_least, slave, least.xi, work.slave_sums);
  if (master != nullptr)
    add_place(-share.by_least, master->faces[at(least.master_face)], least.eta, work.master_sums);
}

/// Moves the sums of a node into its stencil and leaves zeros behind.
void take_sums(const Surface& surface, double scale, NodeSums& sums, Node& node, std::size_t first) {
  for (std::size_t i = 0; i < sums.touched.size(); ++i) {
    const auto position = at(sums.touched[i]);
    const auto entry = static_cast<Eigen::Index>(first + i);
    node.stencil.nodes[first + i] = surface.nodes[position];
    node.stencil.weights[entry] = scale * sums.weights[position];
    if (node.gap_weights.size() > 0)
      node.gap_weights[entry] = scale * sums.gap_weights[position];
    sums.weights[position] = sums.gap_weights[position] = 0;
    sums.is_touched[position] = 0;
  }
  sums.touched.clear();
}

/// Of a surface that touches itself: a node may be in the stencil on both sides, and for several sides of an
/// edge. It stands there once, with the sum of its weights.
int merge_repeats(std::size_t slave_nodes, Node& node) {
  auto& stencil = node.stencil;
  const bool lifted = node.gap_weights.size() > 0;
  std::size_t count = 0, of_slave = 0;
  for (std::size_t i = 0; i < stencil.nodes.size(); ++i) {
    const auto end = stencil.nodes.begin() + static_cast<std::ptrdiff_t>(count);
    const auto found = std::find(stencil.nodes.begin(), end, stencil.nodes[i]);
    const auto from = static_cast<Eigen::Index>(i);
    if (found != end) {
      stencil.weights[found - stencil.nodes.begin()] += stencil.weights[from];
      if (lifted)
        node.gap_weights[found - stencil.nodes.begin()] += node.gap_weights[from];
      continue;
    }
    const auto to = static_cast<Eigen::Index>(count);
    stencil.nodes[count++] = stencil.nodes[i];
    stencil.weights[to] = stencil.weights[from];
    if (lifted)
      node.gap_weights[to] = node.gap_weights[from];
    of_slave += i < slave_nodes ? 1U : 0U;
  }
  stencil.nodes.resize(count);
  stencil.weights.conservativeResize(static_cast<Eigen::Index>(count));
  if (lifted)
    node.gap_weights.conservativeResize(static_cast<Eigen::Index>(count));
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

void Covering::append(const Covering& next) {
  const auto first = overlaps.size();
  overlaps.insert(overlaps.end(), next.overlaps.begin(), next.overlaps.end());
  gradients.insert(gradients.end(), next.gradients.begin(), next.gradients.end());
  for (auto part : next.parts) {
    part.first_overlap += first;
    part.last_overlap += first;
    parts.push_back(part);
  }
}

void make_dual(const SlaveFace& placed, const SlaveReference& reference, const Covering& work, Part& part) {
  const auto& facet = subfacets(placed.type)[at(part.facet)];
  part.dual = dual_coefficients(facet.node_count, part.covered, full_area(reference, part), all_kept);
  LeastGaps least(facet.node_count, part.covered, part.dual, part.gaps);
  for (const auto& seen : work.seen_gaps)
    least.see(seen.values, seen.gap);
  const double size = size_of(placed, facet);
  for (int i = 0; i < facet.node_count; ++i)
    part.bounds[at(i)] = least.bound(i, size);
  part.least = work.seen_gaps[least.least_seen()];
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

void NodeSums::start(std::size_t count) {
  weights.assign(count, 0);
  gap_weights.assign(count, 0);
  is_touched.assign(count, 0);
  touched.clear();
}

void NodeSums::add(int node, double weight, double gap_weight) {
  if (weight == 0 && gap_weight == 0)
    return;
  if (is_touched[at(node)] == 0)
    touched.push_back(node);
  is_touched[at(node)] = 1;
  weights[at(node)] += weight;
  gap_weights[at(node)] += gap_weight;
}

namespace {

/// Sums up the shares of one node; whether its gap is lifted.
bool sum_up(std::span<const int> shares, const Surface& slave, const Surface* master, Workspace::Impl& work) {
  bool lifted = false;
  for (const int s : shares) {
    const auto& share = work.shares[at(s)];
    const auto& part = work.parts[at(share.part)];
    const auto& face = slave.faces[at(part.face)];
    add_products(share, part.slave, face, 1, work.slave_sums);
    for (std::size_t o = part.first_overlap; master != nullptr && o < part.last_overlap; ++o) {
      const auto& overlap = work.overlaps[o];
      add_products(share, overlap.master, master->faces[at(overlap.master_face)], -1, work.master_sums);
    }
    if (share.is_lifted())
      add_least_gap(share, part.least, face, master, work);
    lifted = lifted || share.is_lifted();
  }
  return lifted;
}

} // namespace

void fill_stencils(const Surface& slave, const Surface* master, int components, Workspace::Impl& work,
                   Operators& into) {
  sort_shares(slave.nodes.size(), work);
  work.slave_sums.start(slave.nodes.size());
  work.master_sums.start(master != nullptr ? master->nodes.size() : 0);
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    const auto first = work.first_share[j];
    const bool lifted = sum_up(std::span(work.shares_by_node).subspan(first, work.first_share[j + 1] - first),
                               slave, master, work);
    auto& node = into.nodes[j];
    const auto of_slave = work.slave_sums.touched.size();
    const auto count = of_slave + work.master_sums.touched.size();
    node.stencil.components = components;
    node.stencil.nodes.resize(count);
    node.stencil.weights.resize(static_cast<Eigen::Index>(count));
    node.gap_weights.resize(lifted ? static_cast<Eigen::Index>(count) : 0);
    node.slave_nodes = static_cast<int>(of_slave);
    const double scale = node.weight > 0 ? 1 / node.weight : 0;
    take_sums(slave, scale, work.slave_sums, node, 0);
    if (master != nullptr)
      take_sums(*master, scale, work.master_sums, node, of_slave);
    if (master == &slave)
      node.slave_nodes = merge_repeats(of_slave, node);
  }
}

void fill_gradients(const Surface& master, Workspace::Impl& work, Operators& into) {
  for (std::size_t j = 0; j < into.nodes.size(); ++j) {
    auto& node = into.nodes[j];
    const auto first = node.stencil.nodes.begin() + node.slave_nodes;
    node.gradients.setZero(static_cast<Eigen::Index>(node.stencil.nodes.size()), 3);
    for (auto s = work.first_share[j]; s < work.first_share[j + 1] && node.weight > 0; ++s) {
      const auto& share = work.shares[at(work.shares_by_node[s])];
      const auto& part = work.parts[at(share.part)];
      for (std::size_t o = part.first_overlap; o < part.last_overlap; ++o) {
        const auto& face = master.faces[at(work.overlaps[o].master_face)];
        for (int l = 0; l < face.node_count; ++l) {
          const auto found = std::find(first, node.stencil.nodes.end(), face.nodes[at(l)]);
          for (int c = 0; c < 3 && found != node.stencil.nodes.end(); ++c)
            for (int i = 0; i < 4; ++i)
              node.gradients(found - node.stencil.nodes.begin(), c) +=
                  share.row[i] * work.gradients[o][at(c)](i, l) / node.weight;
        }
      }
    }
  }
}

} // namespace rubato::contact::mortar
