// SPDX-License-Identifier: LGPL-3.0-or-later
/// Multipliers that several contact points share, as unknowns of the interface's linear system.
///
/// Points between the nodes of a slave face interpolate them, m_p = Σ ψ_pn m_n, and the equations of a node
/// sum those of its points: with δe_p = E_q δq + E_m δm_p (contact/point_tangent.hpp)
///   Σ_p ψ_pn (E_q δq_p + E_m Σ_k ψ_pk δm_k) = −Σ_p ψ_pn e_p.
/// Open points have E_q = 0: multipliers of nodes all of whose points are open see displacements through
/// those of their neighbours only, and are eliminated.
#pragma once

#include "rubato/contact/point_tangent.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::step {

/// What a contact point takes of the multipliers of one slave node.
struct MultiplierShare {
  int first = 0; ///< of the node's multipliers among those of all zones
  double shape = 0;
};

class SharedMultipliers {
public:
  /// Begins another iteration with no points.
  void clear();
  /// Factors of the multipliers eliminated too.
  void forget();

  /// A point in contact; its E_q is told by `see`, once all points are added and numbered.
  void add_pressed(std::span<const MultiplierShare> shares, const contact::PointEquations& equations);
  /// A point apart.
  void add_open(std::span<const MultiplierShare> shares, const contact::PointEquations& equations);

  /// Numbers the multipliers of pressed points and eliminates the others. False when that cannot be done.
  bool number();
  /// How many are unknowns.
  Eigen::Index size() const { return static_cast<Eigen::Index>(unknowns_.size()); }
  /// Which, among those of all zones, ascending.
  const std::vector<int>& unknowns() const { return unknowns_; }
  int unknown_of(int multiplier) const { return numbers_[static_cast<std::size_t>(multiplier)]; }

  /// Takes an entry of E_q: how a displacement, by its place on the surface, enters an unknown's equation.
  void see(int unknown, int place, double value) { seen_.emplace_back(unknown, place, value); }
  /// Once all entries are told. An equation that neither a displacement nor a multiplier enters, as between
  /// parts that are held, becomes dm = 0.
  void assemble(Eigen::Index places);

  /// Adds factor · E_q `moved`, one an unknown, to `sum`. `moved`: one a place.
  void add_seen(double factor, const double* moved, double* sum) const;
  const Eigen::MatrixXd& by_unknown() const { return by_unknown_; }
  /// −Σ ψ e, what was eliminated taken into account.
  const Eigen::VectorXd& right() const { return right_; }

  /// Calls `take(multiplier, change)` for every multiplier that points have, given the change of the
  /// unknowns.
  template <class Take> void for_each_change(const Eigen::VectorXd& change, Take take) const {
    for (Eigen::Index i = 0; i < size(); ++i)
      take(unknowns_[static_cast<std::size_t>(i)], change[i]);
    const Eigen::VectorXd others = change_of_others(change);
    for (std::size_t i = 0; i < others_.size(); ++i)
      take(others_[i], others[static_cast<Eigen::Index>(i)]);
  }

private:
  using Entry = Eigen::Triplet<double, int>; ///< by the multipliers' indices among those of all zones
  struct Entries {
    std::vector<Entry> matrix;
    std::vector<std::pair<int, double>> right;
  };
  /// The equations of the multipliers that are not unknowns, solved for them: others = free − by_unknown ·
  /// unknowns(neighbours).
  struct Eliminated {
    std::vector<Entry> entries; ///< what it was computed from
    std::vector<int> unknowns;
    linalg::SparseMatrix to_unknowns; ///< entries of the unknowns' equations
    std::optional<linalg::LuFactor> factor;
    std::vector<int> neighbours; ///< unknowns that enter
    Eigen::MatrixXd by_neighbour;
  };

  static void add(std::span<const MultiplierShare> shares, const contact::PointEquations& equations,
                  Entries& entries);
  void mark(const Entries& entries, int as);
  bool eliminate();
  void fix_unconstrained();
  Eigen::VectorXd change_of_others(const Eigen::VectorXd& change) const;
  bool is_eliminated(int multiplier) const { return unknown_of(multiplier) < 0; }
  int other_of(int multiplier) const { return first_other - unknown_of(multiplier); }

  static constexpr int first_other = -3;

  Entries pressed_, open_;
  /// By multiplier: the number of its unknown; of those eliminated `first_other` minus theirs; −1 where no
  /// point has it.
  std::vector<int> numbers_;
  std::vector<int> unknowns_, others_;
  Eliminated eliminated_;
  Eigen::VectorXd free_; ///< change of the others when the unknowns don't change
  std::vector<Entry> seen_;
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> by_place_;
  Eigen::MatrixXd by_unknown_;
  Eigen::VectorXd right_;
};

} // namespace rubato::step
