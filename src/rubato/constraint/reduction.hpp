// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which displacements are unknown: u = T q + g(t).
#pragma once

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

/// A displacement that is prescribed: value times function (1 when there is none), or a field.
struct PrescribedDof {
  int dof = 0;
  double value = 0; ///< [length]
  std::optional<Function> function;
  std::shared_ptr<const FieldAtPlace> field = {}; ///< instead of value and function; few have one
};

/// Whether they prescribe the same of the same dof.
bool operator==(const PrescribedDof& a, const PrescribedDof& b);

/// What it is at instant t [length]. Throws InputError when a field is no finite number there.
double displacement_of(const PrescribedDof& prescribed, double t);

/// The displacements u of all dofs as functions of the unknowns q and of time, u = T q + g(t). Forces on
/// the unknowns are Tᵀ f, matrices Tᵀ A T.
///
/// There are supports only: an unknown is a free dof, T selects them and g is what supports prescribe, 0 on
/// free dofs. Everything works by index, T is never stored. free_dofs(), unknown_of() and is_prescribed()
/// rest on that; the rest is meant for any T.
class Reduction {
public:
  /// No dofs.
  Reduction() = default;
  /// `prescribed`: ascending by dof, one each at most, below `dof_count`; throws std::invalid_argument
  /// otherwise.
  Reduction(int dof_count, std::vector<PrescribedDof> prescribed);

  Eigen::Index dof_count() const { return static_cast<Eigen::Index>(unknown_of_.size()); }
  Eigen::Index unknown_count() const { return static_cast<Eigen::Index>(free_dofs_.size()); }

  /// The dof of each unknown, ascending.
  const std::vector<int>& free_dofs() const { return free_dofs_; }
  /// The unknown that a dof is; −1 when it is prescribed.
  int unknown_of(int dof) const { return unknown_of_[static_cast<std::size_t>(dof)]; }
  bool is_prescribed(int dof) const { return unknown_of(dof) < 0; }
  /// Ascending by dof.
  std::span<const PrescribedDof> prescribed() const { return prescribed_; }

  /// Tᵀ f: `full` has an entry a dof, the answer one an unknown.
  Eigen::VectorXd gather(const Eigen::VectorXd& full) const { return full(free_dofs_); }
  /// T q: `unknowns` has an entry an unknown, the answer one a dof, 0 on prescribed ones.
  Eigen::VectorXd scatter(const Eigen::VectorXd& unknowns) const;
  /// Tᵀ A T of a square matrix with a row a dof.
  SparseMatrix reduced(const SparseMatrix& matrix) const;

  /// g(t), an entry a dof [length].
  Eigen::VectorXd imposed(double t) const;
  /// Puts the prescribed displacements of instant t into u, an entry a dof [length].
  void impose(double t, Eigen::VectorXd& u) const;
  /// d with which u + d has the prescribed displacements of instant t and u's own elsewhere [length].
  Eigen::VectorXd correction(double t, const Eigen::VectorXd& u) const;

  /// What holds the prescribed dofs where `residual`, an entry a dof, is left of all other forces: its
  /// entries there, 0 on free dofs [force].
  Eigen::VectorXd reaction(const Eigen::VectorXd& residual) const;

private:
  std::vector<PrescribedDof> prescribed_;
  std::vector<int> free_dofs_;
  std::vector<int> unknown_of_; ///< by dof
};

} // namespace rubato::constraint
