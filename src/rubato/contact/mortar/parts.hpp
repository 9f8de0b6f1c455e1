// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the folder only: covered parts of slave sub-facets with their integrals, who has their functions,
/// and how the operators of nodes are put together from them.
///
/// Every integral with a multiplier's function is linear in H: what is integrated over a part is H times the
/// shape functions, ∫H_i N_k and ∫H_i N_l; functions are shared and made dual afterwards by a matrix C, Φ = C
/// H.
#pragma once

#include "rubato/contact/mortar/dual.hpp"
#include "rubato/contact/mortar/nearest.hpp"
#include "rubato/contact/mortar/operators.hpp"
#include "rubato/contact/mortar/search.hpp"

#include <array>
#include <vector>

namespace rubato::contact::mortar {

/// ∫H_i N_k: a row a node of the sub-facet, a column a node of the face.
using Products = Eigen::Matrix<double, 4, 9>;

/// What points of a sub-facet see of an obstacle, each times H_i: gap, normal, place, tangent.
using SeenProducts = Eigen::Matrix<double, 4, 10>;

/// A gap somewhere on a sub-facet, its functions there, and the place on both faces.
struct SeenGap {
  Eigen::Vector4d values = Eigen::Vector4d::Zero();
  double gap = 0;
  Eigen::Vector2d xi = Eigen::Vector2d::Zero();
  Eigen::Vector2d eta = Eigen::Vector2d::Zero();
  int master_face = -1; ///< none before an obstacle
};

/// Integrals of a sub-facet over the master before it, by its nodes, for directions.hpp.
struct FacedMaster {
  Eigen::Matrix<double, 4, 3> normals = Eigen::Matrix<double, 4, 3>::Zero(); ///< ∫H_i n_m [area]
  Eigen::Vector4d kinks = Eigen::Vector4d::Zero();                           ///< ∫H_i ΣN_l κ_l [area]
  Eigen::Vector4d edges = Eigen::Vector4d::Zero(); ///< ∫H_i ΣN_l over nodes at edges [area]
  std::array<double, 4> overhang{1, 1, 1, 1};      ///< way from the node to what is covered, in faces
  double border = 0; ///< largest ΣN_l over nodes at edges: 1 where the master ends before the sub-facet
};

struct Part {
  int face = 0;
  int facet = 0; ///< in the face
  FacetMoments covered;
  Products slave = Products::Zero();
  Eigen::Vector4d gaps = Eigen::Vector4d::Zero(); ///< ∫H_i g [area · length]
  Eigen::Matrix4d dual = Eigen::Matrix4d::Zero(); ///< C where all nodes are kept
  std::array<LeastGaps::Bound, 4> bounds;         ///< of what nodes see, by node (dual.hpp)
  SeenGap least;                                  ///< the least gap that is seen
  FacedMaster faced;
  std::size_t first_overlap = 0, last_overlap = 0; ///< in Parts::overlaps; of an obstacle: in Parts::seen
};

struct Overlap {
  int master_face = 0;
  Products master = Products::Zero();
};

/// Row j of C on one part: Φ_j = row · H. Its part of w_j g_j changes by gap_row · ∫H δg + by_least δg, with
/// the last δg that of the part's least gap: where the gap is not lifted, gap_row = row and by_least = 0.
struct Share {
  int node = 0;
  int part = 0;
  Eigen::Vector4d row = Eigen::Vector4d::Zero();
  Eigen::Vector4d gap_row = Eigen::Vector4d::Zero();
  double by_least = 0; ///< [area]

  bool is_lifted() const { return by_least != 0; }
};

/// What the functions of one node sum up at the nodes of one surface; zeros between nodes.
struct NodeSums {
  std::vector<double> weights, gap_weights; ///< by position
  std::vector<char> is_touched;
  std::vector<int> touched;

  void start(std::size_t count);
  void add(int node, double weight, double gap_weight);
};

/// Covered parts of some of the slave faces, and storage of one sub-facet after the other.
struct Covering {
  std::vector<int> candidates;
  OverlapPoints overlap;                 ///< of one sub-facet
  std::vector<PointRange> ranges;        ///< of its points
  std::vector<Eigen::Vector4d> weighted; ///< weights times H at the points
  std::vector<SeenGap> seen_gaps;        ///< of one sub-facet

  std::vector<Part> parts; ///< those that are covered, face by face
  std::vector<Overlap> overlaps;
  std::vector<std::array<Products, 3>> gradients; ///< ∫H_i ∇N_l of each overlap, or none
  std::vector<SeenProducts> seen;

  void clear_parts() {
    parts.clear();
    overlaps.clear();
    gradients.clear();
    seen.clear();
  }
  /// Takes over the parts of faces that follow, seen before no obstacle.
  void append(const Covering& next);
};

/// The covering is that of all slave faces.
struct Workspace::Impl : Covering {
  std::vector<Eigen::Vector3d> normals; ///< m_j
  std::vector<MasterFace> masters;
  FaceSearch search;
  std::vector<Covering> others; ///< of the faces of other threads than the first

  std::vector<double> covered; ///< w_j⁰
  std::vector<std::uint8_t> kept;
  std::vector<Share> shares;
  std::vector<std::size_t> first_share; ///< of each node in shares_by_node
  std::vector<int> shares_by_node;
  std::vector<int> takers;

  NodeSums slave_sums, master_sums;
};

/// ∫1 over the whole sub-facet of a part.
double full_area(const SlaveReference& reference, const Part& part);

/// Sets the dual functions of a part whose integrals are there, and its least gaps from those seen.
void make_dual(const SlaveFace& placed, const SlaveReference& reference, const Covering& work, Part& part);

/// Which face a complaint is about.
void require_finite(const Surface& surface, std::span<const Eigen::Vector3d> x, const char* which);

/// A slave face at these positions.
SlaveFace slave_face(const Face& face, const SlaveReference& reference, std::span<const Eigen::Vector3d> x,
                     std::span<const Eigen::Vector3d> normals);

/// The nodal normals, without r on the axis of revolution.
void set_normals(const Surface& slave, const SlaveReference& reference, std::span<const Eigen::Vector3d> x,
                 const Options& options, std::vector<Eigen::Vector3d>& normals);

/// The frame of a slave node at those positions and normals: τ₁ looks towards its tangent neighbour.
Frame node_frame(const SlaveReference& reference, std::span<const Eigen::Vector3d> x,
                 std::span<const Eigen::Vector3d> normals, std::size_t node);

/// Decides who is kept, shares all functions, and starts each node with cover, weight, frame and receivers.
void share_functions(const Surface& slave, const SlaveReference& reference,
                     std::span<const Eigen::Vector3d> slave_x, const Options& options,
                     Workspace::Impl& workspace, Operators& into);

/// Fills the stencils from the shares. `master` may be null: there is an obstacle.
void fill_stencils(const Surface& slave, const Surface* master, int components, Workspace::Impl& workspace,
                   Operators& into);

/// Fills the gradients of nodes whose stencils are there, from the shares.
void fill_gradients(const Surface& master, Workspace::Impl& workspace, Operators& into);

double reach_of(const Options& options, const SlaveReference& reference);

} // namespace rubato::contact::mortar
