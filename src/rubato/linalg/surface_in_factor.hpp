// SPDX-License-Identifier: LGPL-3.0-or-later
/// Surface unknowns of a factor whose order of elimination suits the whole matrix.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace rubato::linalg {

class CholmodEngine;

/// With A = L Lᵀ and B picking the surface unknowns, S = B A⁻¹ Bᵀ = (L⁻¹ Bᵀ)ᵀ (L⁻¹ Bᵀ). A column of L⁻¹ Bᵀ
/// has entries only in the supernodes on the way from its unknown to the root of the elimination tree: its
/// path. Positions (surface unknowns in the order of elimination) of one supernode have the same path. Up to
/// `largest_block` of them make a block; two blocks share the end of their paths, whose product is S between
/// them. Each is computed by the same operations whatever was asked for before.
class SurfaceInFactor {
public:
  static constexpr Eigen::Index largest_block = 48;
  /// Positions that S is formed of at once where it is not formed whole: of more points S is used by its
  /// products only (step/interface/interface_newton_system.hpp).
  static constexpr Eigen::Index most_formed = 10'000;

  /// The surface are the engine's unknowns from `first_surface` on. The engine has been analysed with
  /// supernodes, and must outlive this; values are asked for once it has factored, and are those of its last
  /// factor. S of more than `largest_whole` positions is not meant to be formed whole.
  SurfaceInFactor(const CholmodEngine& engine, Eigen::Index first_surface, Eigen::Index largest_whole);

  Eigen::Index size() const { return static_cast<Eigen::Index>(places_.size()); }
  /// Whether S is meant to be used as one matrix, else block by block: where it may be, and one half of it is
  /// sooner read than a partial solve reads the factor (`moved_by`), once down and once up.
  bool is_formed_whole() const { return is_formed_whole_; }
  /// Where every position stands in the order of elimination, ascending.
  const std::vector<Eigen::Index>& places() const { return places_; }
  /// Positions at which blocks begin, and their number at the end.
  const std::vector<Eigen::Index>& block_starts() const { return block_starts_; }

  /// y += L⁻¹ Bᵀ force: `force` one a position, `half_way` in the order of elimination.
  void load(const Eigen::VectorXd& force, Eigen::Ref<Eigen::VectorXd> half_way) const;
  /// B L⁻ᵀ y, one a position.
  Eigen::VectorXd values(const Eigen::Ref<const Eigen::VectorXd>& half_way) const;
  /// S force, one a position each.
  Eigen::VectorXd moved_by(const Eigen::VectorXd& force) const;
  /// The columns of L⁻¹ Bᵀ of a block, on its path: rows × positions.
  Eigen::MatrixXd half_way_of(std::size_t block) const;
  /// S between two blocks (positions of the first × positions of the second) from what half_way_of has told
  /// of them.
  Eigen::MatrixXd compliance(std::size_t first, const Eigen::MatrixXd& half_way_of_first, std::size_t second,
                             const Eigen::MatrixXd& half_way_of_second) const;
  /// Fᵀ S F, one row and one column a column of `forces`, whose rows from `first` on are the positions: by
  /// L⁻¹ Bᵀ F, each column of it on the paths of its own entries only.
  Eigen::MatrixXd between(const SparseMatrix& forces, Eigen::Index first) const;
  /// S.
  Eigen::MatrixXd whole() const;
  /// Memory [bytes] of S where it is formed whole; else of half_way_of all blocks and of S between all of
  /// them, each pair once, of the first `most_formed` positions where there are more.
  std::size_t bytes_of_compliance() const;

private:
  /// Of a supernode: the columns of F whose paths it is on, and its rows of L⁻¹ Bᵀ F in these.
  struct Part {
    std::vector<int> columns;
    Eigen::MatrixXd rows;
  };
  /// Of a supernode: its rows of L⁻¹ Bᵀ, in the positions from `first` to the end of its own. Empty until
  /// used.
  struct Strip {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    Eigen::MatrixXd rows;
  };
  bool is_sooner_read_than_solved() const;
  std::vector<Strip> empty_strips() const;
  void put_units(std::size_t node, Strip& strip) const;
  void carry_up(std::size_t node, std::vector<Strip>& strips) const;
  template <class Take> void each_above(std::size_t node, const Take& take) const;
  std::vector<Part> parts_of(const SparseMatrix& forces, Eigen::Index first) const;
  void carry_up(std::size_t node, std::vector<Part>& parts) const;
  Eigen::Index path_end_shared_by(std::size_t first, std::size_t second) const;

  const CholmodEngine& engine_;
  bool is_formed_whole_ = false;
  std::vector<Eigen::Index> places_;
  std::vector<Eigen::Index> block_starts_;
  std::vector<Eigen::Index> node_of_block_;
  std::vector<Eigen::Index> node_of_; ///< the supernode of every place
  std::vector<Eigen::Index> parent_;  ///< of every supernode; −1 of roots
  std::vector<Eigen::Index> path_;    ///< columns from the first of every supernode to the end of its path
  std::vector<Eigen::Index> above_;   ///< supernodes on any path, ascending
};

} // namespace rubato::linalg
