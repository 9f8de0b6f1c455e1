// SPDX-License-Identifier: LGPL-3.0-or-later
/// Dual functions on the covered part of one sub-facet (B. Wohlmuth, SIAM J. Numer. Anal. 38 (2000) 989–1012;
/// on partly covered faces: T. Cichosz, M. Bischoff, Comput. Methods Appl. Mech. Eng. 200 (2011) 1317–1332):
///   De_j = ∫H_j,   Me_ij = ∫H_i H_j,   A = diag(De) Me⁻¹,   Φ = A H   with   ∫Φ_i H_j = δ_ij De_j,  ΣΦ = 1
#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstddef>

namespace rubato::contact::mortar {

/// Below this share of its full area a sub-facet has A = 1: Me is close to singular there.
inline constexpr double least_dual_cover = 0.01;

/// Integrals over the covered part of a sub-facet, by its nodes; 0 past node_count.
struct FacetMoments {
  Eigen::Vector4d first = Eigen::Vector4d::Zero();  ///< ∫H_j [area]
  Eigen::Matrix4d second = Eigen::Matrix4d::Zero(); ///< ∫H_i H_j [area]

  void add(double weight, const Eigen::Vector4d& values) {
    Eigen::Vector4d weighted;
    for (int i = 0; i < 4; ++i) {
      weighted[i] = weight * values[i];
      first[i] += weighted[i];
    }
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i)
        second(i, j) += weighted[i] * values[j];
  }
};

/// C of Φ = C H. Nodes that are not kept have a row of zeros; their functions are shared among the kept ones
/// first, H_k → H_k + (1/|K|) Σ_dropped H, so that ΣΦ = 1 all the same. Without kept nodes all of it is zero.
/// `full_area`: ∫1 over the whole sub-facet.
Eigen::Matrix4d dual_coefficients(int node_count, const FacetMoments& covered, double full_area,
                                  const std::array<bool, 4>& kept);

/// The least gaps that functions of nodes may see, by node of the sub-facet [length].
///
/// Dual functions are negative on a part of the sub-facet: of gaps that are not linear there they make a mean
/// below every one of them (2 − 3s of s², 0 ≤ s ≤ 1: −1/12 where all is open). What they do see, ∫Φ_i g /
/// De_i, are the nodal values ĝ_i of the linear field nearest to g. It may fall below the least gap of the
/// covered part by as much as that part truly overlaps, and from there to a node that is not covered by a
/// tenth of the sub-facet's size: `bound` is that. Of a linear gap that is not steep ĝ_i is never below.
class LeastGaps {
public:
  /// Of one node, and its change: δ value = by_least δg + row · ∫H δg, with δg of the least gap that was
  /// seen.
  struct Bound {
    double value = -INFINITY;
    double by_least = 0;
    Eigen::Vector4d row = Eigen::Vector4d::Zero(); ///< [1/area]
  };

  /// `dual`: C with all nodes kept. `first_gap`: ∫H_j g [area · length].
  LeastGaps(int node_count, const FacetMoments& covered, const Eigen::Matrix4d& dual,
            const Eigen::Vector4d& first_gap);
  /// A gap of the covered part, where functions are `values`.
  void see(const Eigen::Vector4d& values, double gap);
  Bound bound(int node, double size) const;
  /// Which of the gaps that were seen is the least, in their order.
  std::size_t least_seen() const { return least_seen_; }

private:
  Eigen::Matrix4d fit_ = Eigen::Matrix4d::Zero();    ///< ĝ = fit · ∫H g
  Eigen::Vector4d fitted_ = Eigen::Vector4d::Zero(); ///< ĝ
  Eigen::Vector4d values_at_least_fitted_ = Eigen::Vector4d::Zero();
  double least_fitted_ = INFINITY, least_ = INFINITY;
  std::size_t seen_ = 0, least_seen_ = 0;
};

/// ∫Φ_j of those functions, by the sum of what each kept node has: ≥ 0.
Eigen::Vector4d kept_areas(int node_count, const FacetMoments& covered, const std::array<bool, 4>& kept);

} // namespace rubato::contact::mortar
