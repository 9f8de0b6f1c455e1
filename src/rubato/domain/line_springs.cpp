// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/line_springs.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Part of the undeformed length below which a line has no direction.
constexpr double shortest_line = 1e-6;
/// Part of the undeformed length. Elongations that differ by less count as equal in derivatives of means,
/// which divide by the difference.
constexpr double equal_elongations = 1e-7;

/// The vector between the ends with displacements u.
struct LineVector {
  Vector3d vector;
  double length;
  double elongation; ///< without the rounding of the difference of two lengths

  Vector3d direction() const { return vector / length; }
};

Vector3d difference_along(const LineSpring& spring, const VectorXd& x) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < spring.dofs.size(); ++i)
    for (Index a = 0; a < sum.size(); ++a)
      sum[a] += spring.rows(a, static_cast<Index>(i)) * x[spring.dofs[i]];
  return sum;
}

LineVector line_at(const LineSpring& spring, const VectorXd& u) {
  const Vector3d moved = difference_along(spring, u);
  const Vector3d vector = spring.undeformed + moved;
  const double length = vector.norm();
  // l² − L² = (2 D + Δ)·Δ
  const double elongation = (spring.undeformed + vector).dot(moved) / (length + spring.undeformed.norm());
  return {vector, length, elongation};
}

/// forces += rowsᵀ f
void scatter_line(const LineSpring& spring, const Vector3d& force, VectorXd& forces) {
  for (std::size_t i = 0; i < spring.dofs.size(); ++i)
    for (Index a = 0; a < force.size(); ++a)
      forces[spring.dofs[i]] += spring.rows(a, static_cast<Index>(i)) * force[a];
}

/// matrix += rowsᵀ block rows
void scatter_line(const LineSpring& spring, const Matrix3d& block, SparseMatrix& matrix) {
  for (std::size_t j = 0; j < spring.dofs.size(); ++j) {
    const Vector3d column = block * spring.rows.col(static_cast<Index>(j));
    for (std::size_t i = 0; i < spring.dofs.size(); ++i)
      matrix.coeffRef(spring.dofs[i], spring.dofs[j]) += spring.rows.col(static_cast<Index>(i)).dot(column);
  }
}

/// I − n nᵀ
Matrix3d across(const Vector3d& n) {
  return Matrix3d::Identity() - n * n.transpose();
}

Matrix3d stiffness_at(const LineSpring& spring, const LineVector& line) {
  const Vector3d n = line.direction();
  return spring.spring.slope_at(line.elongation) * n * n.transpose() +
         spring.spring.at(line.elongation) / line.length * across(n);
}

/// N̄ (d₀ + d₁)/(l₀ + l₁)
Vector3d force_between(const LineSpring& spring, const LineVector& before, const LineVector& now) {
  return spring.spring.mean(before.elongation, now.elongation) / (before.length + now.length) *
         (before.vector + now.vector);
}

/// ∂N̄/∂e₁
double slope_of_mean(const LineLaw& law, double before, double now, double length) {
  const double change = now - before;
  if (!law.table || std::abs(change) <= equal_elongations * length)
    return 0.5 * law.slope_at(0.5 * (before + now));
  return (law.at(now) - law.mean(before, now)) / change;
}

/// Twice the derivative of `force_between` by d₁.
Matrix3d stiffness_between(const LineSpring& spring, const LineVector& before, const LineVector& now) {
  const double lengths = before.length + now.length;
  const Vector3d m = (before.vector + now.vector) / lengths;
  const Vector3d n = now.direction();
  const double mean = spring.spring.mean(before.elongation, now.elongation);
  const double slope =
      slope_of_mean(spring.spring, before.elongation, now.elongation, spring.undeformed.norm());
  return 2 * (slope * m * n.transpose() + mean / lengths * (Matrix3d::Identity() - m * n.transpose()));
}

/// The least length on the straight way between two vectors.
double shortest_between(const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  const double squared = way.squaredNorm();
  const double part = squared > 0 ? std::clamp(-from.dot(way) / squared, 0.0, 1.0) : 0;
  return (from + part * way).norm();
}

/// The largest N/l and slope, at the points of the table and undeformed.
double stiffest(const LineSpring& spring) {
  const auto& [slope, table] = spring.spring;
  if (!table)
    return slope;
  const double length = spring.undeformed.norm();
  double largest = std::max(steepest(*table), spring.spring.at(0) / length);
  for (std::size_t i = 0; i < table->at.size(); ++i)
    if (const double l = length + table->at[i]; l > shortest_line * length)
      largest = std::max(largest, table->values[i] / l);
  return largest;
}

void add_in_all_directions(const LineSpring& spring, double factor, const VectorXd& x, VectorXd& y) {
  scatter_line(spring, Vector3d(factor * difference_along(spring, x)), y);
}

} // namespace

double LineLaw::at(double x) const {
  return table ? interpolated(*table, x) : slope * x;
}

double LineLaw::slope_at(double x) const {
  return table ? rubato::slope_at(*table, x) : slope;
}

/// Piece by piece of the table: each is a straight line, whose mean is the force in its middle.
double LineLaw::mean(double x0, double x1) const {
  const auto [low, high] = std::minmax(x0, x1);
  if (!table || !(low < high))
    return at(0.5 * (x0 + x1));
  double sum = 0;
  double from = low;
  const auto add_to = [&](double to) {
    sum += at(0.5 * (from + to)) * (to - from);
    from = to;
  };
  for (const double corner : table->at)
    if (corner > low && corner < high)
      add_to(corner);
  add_to(high);
  return sum / (high - low);
}

bool has_dashpots(std::span<const LineSpring> springs) {
  return std::ranges::any_of(springs, [](const auto& one) { return one.dashpot.acts(); });
}

Failed find_without_length(std::span<const LineSpring> springs, const StepSpan& step) {
  for (const auto& spring : springs) {
    const Vector3d from = spring.undeformed + difference_along(spring, step.u0);
    const Vector3d to = spring.undeformed + difference_along(spring, step.u1);
    if (!(shortest_between(from, to) > shortest_line * spring.undeformed.norm()))
      return CellFailure{element::Failure::no_length, spring.cell};
  }
  return {};
}

void add_line_forces(std::span<const LineSpring> springs, const StepSpan& step, VectorXd& forces) {
  for (const auto& spring : springs) {
    if (!spring.spring.acts())
      continue;
    const auto now = line_at(spring, step.u1);
    if (step.of == ForcesOf::end)
      scatter_line(spring, Vector3d(spring.spring.at(now.elongation) * now.direction()), forces);
    else
      scatter_line(spring, force_between(spring, line_at(spring, step.u0), now), forces);
  }
}

void add_line_tangents(std::span<const LineSpring> springs, const StepSpan& step, TangentOf of,
                       SparseMatrix& tangent) {
  for (const auto& spring : springs) {
    if (!spring.spring.acts())
      continue;
    const auto now = line_at(spring, step.u1);
    if (step.of == ForcesOf::end) {
      scatter_line(spring, stiffness_at(spring, now), tangent);
      continue;
    }
    const Matrix3d exact = stiffness_between(spring, line_at(spring, step.u0), now);
    scatter_line(spring, of == TangentOf::exact ? exact : Matrix3d(0.5 * (exact + exact.transpose())),
                 tangent);
  }
}

double line_energy(std::span<const LineSpring> springs, const VectorXd& u) {
  double sum = 0;
  for (const auto& spring : springs)
    if (spring.spring.acts()) {
      const double e = line_at(spring, u).elongation;
      sum += spring.spring.mean(0, e) * e;
    }
  return sum;
}

double missed_along_lines(std::span<const LineSpring> springs, const VectorXd& u0, const VectorXd& u1) {
  double sum = 0;
  for (const auto& spring : springs) {
    if (!spring.spring.acts())
      continue;
    const auto before = line_at(spring, u0);
    const auto now = line_at(spring, u1);
    const Vector3d forces = spring.spring.at(before.elongation) * before.direction() +
                            spring.spring.at(now.elongation) * now.direction();
    sum += 0.5 * forces.dot(now.vector - before.vector) -
           spring.spring.mean(before.elongation, now.elongation) * (now.elongation - before.elongation);
  }
  return sum;
}

void add_line_damping(std::span<const LineSpring> springs, const VectorXd& u, const VectorXd& v,
                      VectorXd& forces) {
  for (const auto& spring : springs)
    if (spring.dashpot.acts()) {
      const Vector3d n = line_at(spring, u).direction();
      const double rate = n.dot(difference_along(spring, v));
      scatter_line(spring, Vector3d(spring.dashpot.at(rate) * n), forces);
    }
}

/// With w the part of the relative velocity across n, ∂ė/∂d = wᵀ/l: of s n by d it is s' n wᵀ/l + s/l (I − n
/// nᵀ).
void add_line_damping_tangents(std::span<const LineSpring> springs, const VectorXd& u, const VectorXd& v,
                               const DampingFactors& factors, SparseMatrix& tangent) {
  for (const auto& spring : springs) {
    if (!spring.dashpot.acts())
      continue;
    const auto line = line_at(spring, u);
    const Vector3d n = line.direction();
    const Vector3d relative = difference_along(spring, v);
    const double rate = n.dot(relative);
    const Vector3d w = relative - rate * n;
    const double slope = spring.dashpot.slope_at(rate);
    const Matrix3d turned = 0.5 * slope * (n * w.transpose() + w * n.transpose());
    scatter_line(
        spring,
        Matrix3d(factors.by_velocity * slope * n * n.transpose() +
                 factors.by_displacement / line.length * (turned + spring.dashpot.at(rate) * across(n))),
        tangent);
  }
}

void add_bound_of_stiffness(std::span<const LineSpring> springs, const VectorXd& x, VectorXd& y) {
  for (const auto& spring : springs)
    add_in_all_directions(spring, stiffest(spring), x, y);
}

void add_bound_of_damping(std::span<const LineSpring> springs, const VectorXd& x, VectorXd& y) {
  for (const auto& spring : springs)
    add_in_all_directions(
        spring, spring.dashpot.table ? steepest(*spring.dashpot.table) : spring.dashpot.slope, x, y);
}

} // namespace rubato::domain
