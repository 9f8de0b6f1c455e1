// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/projected_cg.hpp"

#include "rubato/core/tolerances.hpp"
#include "rubato/study/contact_methods.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using RowMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// Gaps that are left, in lengths of the largest one without contact forces.
constexpr double gap_tolerance = 1e-13;
/// Products of the power method that bounds ‖F‖ from below; the step length leaves the rest as margin.
constexpr int norm_products = 12;
constexpr int iterations_per_unknown = 20;
constexpr int least_iterations = 500;

/// The gradient's part on unknowns that are free to move, and its part that pushes bound ones inwards.
struct Gradients {
  VectorXd free;
  VectorXd chopped;
  Gradients(const VectorXd& x, const VectorXd& gradient)
      : free(VectorXd::Zero(x.size())), chopped(VectorXd::Zero(x.size())) {
    for (Index i = 0; i < x.size(); ++i)
      (x[i] > 0 ? free[i] : chopped[i]) = x[i] > 0 ? gradient[i] : std::min(gradient[i], 0.0);
  }
  double largest() const {
    return std::max(free.lpNorm<Eigen::Infinity>(), chopped.lpNorm<Eigen::Infinity>());
  }
  /// The free gradient as far as one step of that length can follow it.
  VectorXd reduced_free(const VectorXd& x, double length) const {
    return (free.array() > 0).select(free.cwiseMin(x / length), free);
  }
};

class Minimisation {
public:
  Minimisation(const BoundedProblem& problem, VectorXd start)
      : problem_(problem), x_(std::move(start)), gradient_(problem.multiply(x_) + problem.linear) {
    length_ = 1 / operator_norm();
  }

  std::optional<VectorXd> run() {
    restart();
    for (int iteration = 0; iteration < problem_.max_iterations; ++iteration) {
      const Gradients gradients(x_, gradient_);
      if (gradients.largest() <= problem_.tolerance)
        return x_;
      const bool proportional =
          gradients.chopped.squaredNorm() <= gradients.reduced_free(x_, length_).dot(gradients.free);
      if (proportional)
        conjugate_step();
      else
        proportion(gradients.chopped);
      if (problem_.pulse != nullptr && !problem_.pulse->beat())
        return std::nullopt;
    }
    return std::nullopt;
  }

private:
  double operator_norm() const {
    VectorXd v = VectorXd::LinSpaced(x_.size(), 1, 2);
    double norm = 0;
    for (int i = 0; i < norm_products; ++i) {
      v.normalize();
      v = problem_.multiply(v);
      norm = v.norm();
    }
    return std::max(norm, std::numeric_limits<double>::min());
  }

  VectorXd preconditioned() const {
    const Gradients gradients(x_, gradient_);
    VectorXd z = problem_.precondition(gradients.free);
    for (Index i = 0; i < z.size(); ++i)
      if (!(x_[i] > 0))
        z[i] = 0;
    return z;
  }

  void restart() { direction_ = preconditioned(); }

  void conjugate_step() {
    const VectorXd product = problem_.multiply(direction_);
    const double curvature = direction_.dot(product);
    const double wanted = gradient_.dot(direction_) / curvature;
    const double feasible = largest_feasible_step();
    if (wanted <= feasible) {
      x_ = (x_ - wanted * direction_).cwiseMax(0.0);
      gradient_ -= wanted * product;
      const VectorXd z = preconditioned();
      direction_ = z - z.dot(product) / curvature * direction_;
      return;
    }
    x_ = (x_ - feasible * direction_).cwiseMax(0.0);
    gradient_ -= feasible * product;
    x_ = (x_ - length_ * Gradients(x_, gradient_).free).cwiseMax(0.0);
    gradient_ = problem_.multiply(x_) + problem_.linear;
    restart();
  }

  double largest_feasible_step() const {
    double step = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < x_.size(); ++i)
      if (direction_[i] > 0)
        step = std::min(step, x_[i] / direction_[i]);
    return step;
  }

  void proportion(const VectorXd& chopped) {
    const VectorXd product = problem_.multiply(chopped);
    const double step = gradient_.dot(chopped) / chopped.dot(product);
    x_ = (x_ - step * chopped).cwiseMax(0.0);
    gradient_ -= step * product;
    restart();
  }

  const BoundedProblem& problem_;
  VectorXd x_;
  VectorXd gradient_;
  VectorXd direction_;
  double length_ = 1; ///< of a gradient step that never overshoots
};

/// The linear relations of all zones, one row a multiplier; rows of points that face nothing are empty.
struct Relations {
  RowMatrix rows;          ///< B on free dofs
  VectorXd gaps;           ///< at the present configuration; infinite where nothing is faced
  VectorXd forces;         ///< present N
  std::vector<int> active; ///< multipliers that may become positive: their points face what can move
};

Relations relations_of(const LinearProblem& problem,
                       const std::vector<std::vector<contact::PointEvaluation>>& points,
                       const std::vector<contact::ZoneState>& zones) {
  const auto& model = problem.model;
  Relations relations;
  relations.gaps.resize(model.multiplier_count);
  relations.forces.resize(model.multiplier_count);
  std::vector<Eigen::Triplet<double, int>> triplets;
  for (std::size_t z = 0; z < points.size(); ++z)
    for (std::size_t i = 0; i < points[z].size(); ++i) {
      const auto& point = model.zones[z].points[i];
      const int row = model.multiplier_offsets[z] + point.node_position;
      relations.gaps[row] = points[z][i].variables.gap;
      relations.forces[row] = zones[z].multipliers[point.node_position];
      if (!points[z][i].kinematics || point.excluded)
        continue;
      const auto& k = *points[z][i].kinematics;
      double largest = 0;
      for (std::size_t node = 0; node < k.stencil.nodes.size(); ++node)
        for (int c = 0; c < k.stencil.components; ++c)
          if (const int free = model.reduction.unknown_of(model.dofs.dof(k.stencil.nodes[node], c));
              free >= 0) {
            const double entry = k.d_gap[static_cast<Index>(node) * k.stencil.components + c];
            triplets.emplace_back(row, free, entry);
            largest = std::max(largest, std::abs(entry));
          }
      if (largest > tolerances.empty_row)
        relations.active.push_back(row);
    }
  relations.rows.resize(model.multiplier_count, problem.matrix.rows());
  relations.rows.setFromTriplets(triplets.begin(), triplets.end());
  return relations;
}

} // namespace

std::optional<VectorXd> minimise_over_nonnegative(const BoundedProblem& problem, VectorXd start) {
  return Minimisation(problem, std::move(start)).run();
}

bool finds_forces(const model::Model& model) {
  return !model.zones.empty() && study::entry_of(model.zones.front().settings.method).finds_forces;
}

std::optional<LinearSolution>
solve_projected_cg(const LinearProblem& problem, const Compliance* compliance,
                   const std::vector<std::vector<contact::PointEvaluation>>& points,
                   const std::vector<contact::ZoneState>& zones, Pulse& pulse) {
  if (!compliance)
    return std::nullopt;
  const auto relations = relations_of(problem, points, zones);
  const auto count = static_cast<Index>(relations.active.size());
  RowMatrix b(count, problem.matrix.rows());
  for (Index i = 0; i < count; ++i)
    b.row(i) = relations.rows.row(relations.active[static_cast<std::size_t>(i)]);
  const double f = problem.force_weight;
  // The lumped preconditioner of Farhat and Roux (Int. J. Numer. Methods Eng. 32, 1991).
  const VectorXd scale = (b.cwiseProduct(b) * VectorXd::Ones(b.cols())).cwiseInverse();

  const VectorXd free_motion = compliance->solve(-problem.residual);
  const VectorXd now = relations.forces(relations.active);
  BoundedProblem bounded;
  bounded.multiply = [&](const VectorXd& n) {
    return VectorXd(f * (b * compliance->solve(VectorXd(b.transpose() * n))));
  };
  bounded.precondition = [&](const VectorXd& g) {
    const VectorXd spread = b.transpose() * scale.cwiseProduct(g);
    return VectorXd(scale.cwiseProduct(b * (problem.matrix * spread)) / f);
  };
  const VectorXd gaps = relations.gaps(relations.active);
  bounded.linear = gaps + b * free_motion - bounded.multiply(now);
  bounded.tolerance = gap_tolerance * bounded.linear.lpNorm<Eigen::Infinity>();
  bounded.max_iterations = least_iterations + iterations_per_unknown * static_cast<int>(count);
  bounded.pulse = &pulse;
  const auto forces = minimise_over_nonnegative(bounded, now.cwiseMax(0.0));
  if (!forces)
    return std::nullopt;

  LinearSolution solution{VectorXd(), -relations.forces};
  solution.multipliers(relations.active) = *forces - now;
  solution.displacement = free_motion + f * compliance->solve(VectorXd(b.transpose() * (*forces - now)));
  return solution;
}

} // namespace rubato::step
