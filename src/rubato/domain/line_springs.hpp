// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs and dashpots that act along the current line between two places (docs/theory/connectors.md).
///
/// d = D + rows · u is the vector between the places, l its length and n = d/l its direction. The elongation
/// is e = l − |D|. A spring has the force N(e) n, a dashpot s(ė) n with ė = n · (rows · v).
#pragma once

#include "rubato/core/linear_table.hpp"
#include "rubato/domain/evaluation.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace rubato::domain {

/// A force by one number: a table, or a slope times the number.
struct LineLaw {
  double slope = 0; ///< without effect where there is a table
  std::optional<LinearTable> table = {};

  bool acts() const { return slope != 0 || table.has_value(); }
  double at(double x) const;
  double slope_at(double x) const;
  /// The mean of the force between two numbers.
  double mean(double x0, double x1) const;
};

struct LineSpring {
  std::vector<int> dofs;
  Eigen::Matrix3Xd rows;                                ///< a column a dof
  Eigen::Vector3d undeformed = Eigen::Vector3d::Zero(); ///< D, not 0 [length]
  LineLaw spring;                                       ///< by e [length]
  LineLaw dashpot;                                      ///< by ė [length/time]
  mesh::CellIndex cell = -1;                            ///< at one of the ends, for messages
};

bool has_dashpots(std::span<const LineSpring> springs);

/// A failure where the ends of a spring come together, on the straight way from the start of the step to its
/// end: then the spring has no direction.
Failed find_without_length(std::span<const LineSpring> springs, const StepSpan& step);

/// Adds forces of the springs: rowsᵀ N n at the end of the step, or rowsᵀ N̄ (d₀ + d₁)/(l₀ + l₁) for the whole
/// step. N̄ is the mean of N between both elongations: the work is the change of the stored energy.
void add_line_forces(std::span<const LineSpring> springs, const StepSpan& step, Eigen::VectorXd& forces);
/// Adds the derivatives of these forces, as domain::Wanted has them. `tangent` has entries at all dofs of
/// each spring.
void add_line_tangents(std::span<const LineSpring> springs, const StepSpan& step, TangentOf of,
                       SparseMatrix& tangent);

/// Σ ∫ N de from 0 to e [force · length].
double line_energy(std::span<const LineSpring> springs, const Eigen::VectorXd& u);
/// Σ ½ (N₀ n₀ + N₁ n₁)·(d₁ − d₀) less the change of the stored energy: what forces at both ends of a step
/// miss of the work between them [force · length].
double missed_along_lines(std::span<const LineSpring> springs, const Eigen::VectorXd& u0,
                          const Eigen::VectorXd& u1);

/// Adds rowsᵀ s(ė) n.
void add_line_damping(std::span<const LineSpring> springs, const Eigen::VectorXd& u, const Eigen::VectorXd& v,
                      Eigen::VectorXd& forces);
/// Adds its derivatives by velocities and by displacements, the latter symmetrised, times factors.
struct DampingFactors {
  double by_velocity = 0;
  double by_displacement = 0;
};
void add_line_damping_tangents(std::span<const LineSpring> springs, const Eigen::VectorXd& u,
                               const Eigen::VectorXd& v, const DampingFactors& factors,
                               SparseMatrix& tangent);

/// y += B x, with B at least the stiffness of each spring in every direction. Elongations are those of its
/// table, and beyond it where the law goes on linearly.
void add_bound_of_stiffness(std::span<const LineSpring> springs, const Eigen::VectorXd& x,
                            Eigen::VectorXd& y);
/// y += B x, with B at least the damping of each dashpot in every direction.
void add_bound_of_damping(std::span<const LineSpring> springs, const Eigen::VectorXd& x, Eigen::VectorXd& y);

} // namespace rubato::domain
