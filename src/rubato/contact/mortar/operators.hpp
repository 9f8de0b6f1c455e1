// SPDX-License-Identifier: LGPL-3.0-or-later
/// The operators of mortar contact: for every slave node its weight, its stencil on both surfaces, its frame.
///
///   D_jk = ∫Φ_j N_k,   M_jl = ∫Φ_j N_l,   w_j = ∫Φ_j ≥ 0        over the covered part of the slave
///   B_ji = D_jk on slave nodes, −M_jl on master nodes,           Σ_i B_ji = 0
///   G_j(x) = Σ_i B_ji x_i / w_j                                  mean of x_s − x_m [length]
///   g_j = n_j·G_j(x)                                             > 0 open
/// Φ: piecewise linear dual functions of sub-facets (dual.hpp), on segments of the deformed surfaces
/// (segments.hpp). Measures are the slave's undeformed ones.
#pragma once

#include "rubato/contact/mortar/frames.hpp"
#include "rubato/contact/mortar/segments.hpp"
#include "rubato/contact/mortar/slave_reference.hpp"
#include "rubato/contact/stencil.hpp"
#include "rubato/contact/surface.hpp"
#include "rubato/core/threads.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace rubato::contact::mortar {

/// Below this share of its full weight a node is dropped: its dual function is shared among its neighbours.
inline constexpr double least_kept_share = 0.05;

/// Who decides whether a node is kept.
enum class Keep : std::uint8_t {
  by_cover, ///< kept from 5 % of its full weight on, or from its own least share on
  always,   ///< kept if anything of it is covered
  never     ///< its dual function is shared among its neighbours: cross points of ties
};

/// Spans may be empty; else they have an entry for each slave node, `reaches` for each slave face.
struct Options {
  double reach =
      0; ///< largest gap or penetration of partners; 0: the longest slave face, no limit to obstacles
  std::span<const Reach> reaches = {};       ///< the same by slave face, in place of `reach`
  std::span<const HeldComponents> held = {}; ///< for normals on planes of symmetry
  std::span<const Keep> keep = {};
  std::span<const double> least_shares = {}; ///< in place of least_kept_share
  /// Whether a slave and a master face may meet; empty: all may. Self contact excludes neighbours by it.
  std::function<bool(int slave_face, int master_face)> may_pair = {};
  /// Of a surface that meets itself: directions of slave nodes are those of both sides
  /// (self_contact_normals.hpp).
  bool mean_normals = false;
  /// Whether all of the master within reach counts, not only what is nearest (nearest.hpp).
  bool all_layers = false;
  /// Integration includes gradients of the master's shape functions.
  bool gradients = false;
  /// That work on slave faces between two meshes; may_pair is asked by several at a time. Operators do not
  /// depend on their number.
  Threads threads = {};
};

enum class Cover : std::uint8_t {
  none,    ///< meets nothing: no unknown, no gap
  dropped, ///< covered, but its function is shared among receivers: its pressure is the mean of theirs
  kept
};

struct Node {
  Stencil stencil;        ///< nodes of the slave, then of the master, with B_ji/w_j; empty unless kept
  int slave_nodes = 0;    ///< how many of them are the slave's
  double weight = 0;      ///< w_j [area]; 0 unless kept
  double full_weight = 0; ///< ∫H_j over all faces [area]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< n_j (directions.hpp)
  Eigen::Matrix<double, 3, 2> tangents = Eigen::Matrix<double, 3, 2>::Zero();
  Frame slave_frame; ///< with the normal −m_j of the slave alone
  Cover cover = Cover::none;
  /// With an obstacle: the mean place it faces; G_j is counted from there. 0 with a master.
  Eigen::Vector3d anchor = Eigen::Vector3d::Zero();
  double gap = 0;  ///< g_j where it was integrated, with the lift; 0 unless kept
  double lift = 0; ///< how much of it is added to n_j·G_j (dual.hpp, LeastGaps) [length]
  /// ∂lift/∂gap where all gaps around change alike: 0 where nothing overlaps, at most 1.
  double lift_slope = 0;
  /// Of a gap that is lifted: δg_j = n_j·Σ_i gap_weights_i δx_i, nodes as in the stencil; else empty.
  Eigen::VectorXd gap_weights;
  /// ∫Φ_j ∇N_l / w_j along the master's surface, a row a node of the stencil, 0 on slave nodes; empty unless
  /// asked for [1/length].
  Eigen::Matrix<double, Eigen::Dynamic, 3> gradients;
  std::vector<int> receivers; ///< of a dropped node: positions of the kept nodes that have its function

  bool kept() const { return cover == Cover::kept; }
};

struct Operators {
  std::vector<Node> nodes; ///< by position in slave.nodes
  double covered_area = 0; ///< Σ w_j, all of the slave that is covered
  double lost_area = 0;    ///< covered, but every node around was told never to be kept [area]
  int kept_count = 0;
};

/// Storage that integrations of one pair of surfaces use again and again.
class Workspace {
public:
  Workspace();
  ~Workspace();
  Workspace(Workspace&&) noexcept;
  Workspace& operator=(Workspace&&) noexcept;
  struct Impl;
  Impl& impl() { return *impl_; }

private:
  std::unique_ptr<Impl> impl_;
};

/// The operators where nodes are at `slave_x` and `master_x`, by position in the surfaces' nodes.
/// A covered face none of whose nodes, nor of the faces around it, has 5 % of its weight keeps all its
/// covered nodes: a body smaller than a slave face is felt. Throws InputError where a position is not finite,
/// with the face.
void integrate(const Surface& slave, const SlaveReference& reference, const Surface& master,
               std::span<const Eigen::Vector3d> slave_x, std::span<const Eigen::Vector3d> master_x,
               const Options& options, Workspace& workspace, Operators& into);

/// The same in new storage.
Operators integrate(const Surface& slave, const SlaveReference& reference, const Surface& master,
                    std::span<const Eigen::Vector3d> slave_x, std::span<const Eigen::Vector3d> master_x,
                    const Options& options = {});

/// The directions p_k of the nodes of a surface that meets itself, by position, as integrate has them there
/// with `mean_normals`.
void mean_normals(const Surface& surface, const SlaveReference& reference, std::span<const Eigen::Vector3d> x,
                  const Options& options, Workspace& workspace, std::vector<Eigen::Vector3d>& normals);

/// G_j of values at the mesh's nodes: value(node). 0 of a node that is not kept.
template <class Value> Eigen::Vector3d gap_vector(const Node& node, const Value& value) {
  return node.kept() ? Eigen::Vector3d(node.stencil.sum(value) - node.anchor) : Eigen::Vector3d::Zero();
}

} // namespace rubato::contact::mortar
