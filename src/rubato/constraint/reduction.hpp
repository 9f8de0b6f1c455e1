// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which displacements are unknown: u = T q + g(t).
#pragma once

#include "rubato/constraint/rotation.hpp"
#include "rubato/core/field_function.hpp"
#include "rubato/core/function.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace rubato::constraint {

using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// A field at an undeformed place, a function of time.
struct FieldAtPlace {
  std::shared_ptr<const FieldFunction> field; ///< [length], there is one
  std::array<double, 3> place{};
};

/// What a rotation displaces an undeformed place by along an axis, a function of time.
struct RotatedPlace {
  std::shared_ptr<const Rotation> by; ///< there is one
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  int axis = 0; ///< 0 to 2
};

/// A value times function (1 when there is none), or a field; and what a rotation adds.
struct ImposedValue {
  double value = 0; ///< of a dof [length], of an equation what its left side has
  std::optional<Function> function;
  std::shared_ptr<const FieldAtPlace> field = {};    ///< instead of value and function; few have one
  std::shared_ptr<const RotatedPlace> rotation = {}; ///< beside them [length]; few have one

  bool varies_in_time() const { return function.has_value() || field != nullptr || rotation != nullptr; }
};

/// Whether they are the same value of time.
bool operator==(const ImposedValue& a, const ImposedValue& b);

/// What it is at instant t. Throws InputError when a field is no finite number there.
double value_at(const ImposedValue& imposed, double t);

/// Its rate of order 1 or 2 where it is given by a velocity or an acceleration, else 0.
double rate_at(const ImposedValue& imposed, double t, int order);

/// A displacement that is prescribed.
struct PrescribedDof {
  int dof = 0;
  ImposedValue imposed;
  bool operator==(const PrescribedDof&) const = default;
};

/// What it is at instant t [length].
double displacement_of(const PrescribedDof& prescribed, double t);

/// coefficient · u_dof
struct Term {
  int dof = 0;
  double coefficient = 0;
  bool operator==(const Term&) const = default;
};

/// A dof that relations give: Σ of.coefficient u_of.dof + g(t), the g of the Reduction it belongs to.
struct DependentDof {
  int dof = 0;
  std::vector<Term> of;         ///< free dofs, ascending; none where nothing unknown moves it
  std::vector<Term> prescribed; ///< part of g: prescribed dofs
  std::vector<Term> given;      ///< part of g: right sides of equations, their numbers in place of dofs
};

/// The displacements u of all dofs as functions of the unknowns q and of time, u = T q + g(t). Forces on
/// the unknowns are Tᵀ f, matrices Tᵀ A T.
///
/// Each unknown is the displacement of a free dof. Supports prescribe dofs, relations (constraint/
/// elimination.hpp) make dofs depend on free and prescribed ones: T has a row of one 1 for a free dof, none
/// for a prescribed one, the coefficients of the relation for a dependent one.
///
/// A base that moves by s(t) carries all of it along: what supports and relations say then holds of u − s.
class Reduction {
public:
  /// No dofs.
  Reduction() = default;
  /// Supports only. `prescribed`: ascending by dof, one each at most, below `dof_count`; throws
  /// std::invalid_argument otherwise.
  Reduction(int dof_count, std::vector<PrescribedDof> prescribed);
  /// With relations. `dependents`: ascending by dof, none of them prescribed; `right_sides`: those that they
  /// count. Throws std::invalid_argument where a dependent dof depends on one that is not free.
  Reduction(int dof_count, std::vector<PrescribedDof> prescribed, std::vector<DependentDof> dependents,
            std::vector<ImposedValue> right_sides);

  Eigen::Index dof_count() const { return static_cast<Eigen::Index>(unknown_of_.size()); }
  Eigen::Index unknown_count() const { return static_cast<Eigen::Index>(free_dofs_.size()); }

  /// The dof of each unknown, ascending.
  const std::vector<int>& free_dofs() const { return free_dofs_; }
  /// The unknown that a dof is; below 0 when it is prescribed or dependent.
  int unknown_of(int dof) const { return unknown_of_[static_cast<std::size_t>(dof)]; }
  /// Whether nothing unknown moves it.
  bool is_prescribed(int dof) const { return unknown_of(dof) == prescribed_mark; }
  /// Ascending by dof: those of supports.
  std::span<const PrescribedDof> prescribed() const { return prescribed_; }
  /// Ascending by dof.
  std::span<const DependentDof> dependents() const { return dependents_; }
  /// s(t): of each axis, nothing where the base is at rest [length]. Dofs of a node follow one another.
  using Base = std::array<std::optional<FieldFunction>, 3>;
  /// Lets a base carry it, of nodes that have so many components.
  void carry(Base base, int components);
  bool is_carried() const { return components_ > 0; }
  /// One of prescribed() at instant t, carried [length].
  double displacement(const PrescribedDof& prescribed, double t) const;
  /// Whether that may change with time.
  bool moves(const PrescribedDof& prescribed) const;
  /// Whether the given part of a dependent dof, one of dependents(), may change with time.
  bool moves(const DependentDof& dependent) const;
  /// Of one of dependents(): what no unknown gives of it, g(t) [length].
  double given_part(const DependentDof& dependent, double t) const;
  /// Calls take(unknown, coefficient) for every entry of a dof's row of T.
  template <class Take> void for_each_unknown(int dof, const Take& take) const {
    const int unknown = unknown_of(dof);
    if (unknown >= 0)
      take(unknown, 1.0);
    else if (unknown < prescribed_mark)
      for (const auto& term : dependents_[static_cast<std::size_t>(first_dependent_mark - unknown)].of)
        take(unknown_of(term.dof), term.coefficient);
  }

  /// Tᵀ f: `full` has an entry a dof, the answer one an unknown.
  Eigen::VectorXd gather(const Eigen::VectorXd& full) const;
  /// The same with the magnitudes of the coefficients: a bound of rounding.
  Eigen::VectorXd gather_magnitudes(const Eigen::VectorXd& full) const;
  /// T q: `unknowns` has an entry an unknown, the answer one a dof, 0 on prescribed ones.
  Eigen::VectorXd scatter(const Eigen::VectorXd& unknowns) const;
  /// Tᵀ A T of a square matrix with a row a dof.
  SparseMatrix reduced(const SparseMatrix& matrix) const;

  /// g(t), an entry a dof [length].
  Eigen::VectorXd imposed(double t) const;
  /// Puts the displacements of instant t that are not free into u, an entry a dof [length].
  void impose(double t, Eigen::VectorXd& u) const;
  /// The same of rates of displacements, whose g is 0: of dependent dofs only.
  void relate(Eigen::VectorXd& rates) const;
  /// Puts the velocities (order 1) or accelerations (2) into `rates`, an entry a dof, that supports,
  /// relations and a base have which are given by their velocity or acceleration. All other dofs keep what
  /// they have.
  void impose_rates(int order, double t, Eigen::VectorXd& rates) const;
  /// d with which u + d has the displacements of instant t that are not free, and u's own elsewhere [length].
  Eigen::VectorXd correction(double t, const Eigen::VectorXd& u) const;

  /// Where supports and relations act: prescribed dofs, dependent ones and what these depend on, ascending.
  const std::vector<int>& reacting_dofs() const { return reacting_; }
  /// What holds and ties the dofs where `residual`, an entry a dof, is left of all other forces: its entries
  /// on reacting_dofs(), 0 on the others [force].
  Eigen::VectorXd reaction(const Eigen::VectorXd& residual) const;
  /// λ of the equations E u = r that `given` has the numbers of: the reaction, an entry a dof, is Eᵀ λ. It is
  /// the work of the reaction by a change of the right side, λ_i = Σ reaction_d ∂g_d/∂r_i; 0 of equations
  /// that are redundant [force · length over the unit of r].
  Eigen::VectorXd multipliers(const Eigen::VectorXd& reaction) const;

private:
  static constexpr int prescribed_mark = -1;
  static constexpr int first_dependent_mark = -2; ///< dependents count down from here

  void mark_prescribed();
  void mark_dependents();
  void number_free();
  void collect_reacting();
  const PrescribedDof& support_of(int dof) const;
  double base_at(int dof, double t, int order = 0) const;
  double carried_part(const DependentDof& dependent, double t, int order) const;
  void check_dependents() const;
  SparseMatrix selected(const SparseMatrix& matrix) const;
  SparseMatrix t() const;

  std::vector<PrescribedDof> prescribed_;
  std::vector<DependentDof> dependents_;
  std::vector<ImposedValue> right_sides_;
  std::vector<int> free_dofs_;
  std::vector<int> unknown_of_; ///< by dof
  std::vector<int> reacting_;
  Base base_;
  int components_ = 0; ///< of a node, where a base carries it
};

} // namespace rubato::constraint
