// SPDX-License-Identifier: LGPL-3.0-or-later
/// How the pressing forces of many points are predicted, by products with S.
#include "rubato/linalg/sparse_products.hpp"
#include "rubato/step/interface/contact_predictor.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Gaps that are left, in parts of the largest one without forces.
constexpr double gaps_left = 3e-2;
constexpr int most_mprgp_products = 60;
/// Points up to which columns of S that cost a solve each are computed, once a step length.
constexpr std::size_t most_columns = 500;
/// Of the power method, from a motion that goes one way: S answers to these most.
constexpr int power_products = 2;

/// Between the pressing forces of points and what they put on the surface, one an interface dof.
class PressedSurface {
public:
  PressedSurface(std::span<PredictorPoint* const> points, const Compliance& compliance)
      : points_(points), compliance_(compliance) {}

  VectorXd spread(const VectorXd& forces) const {
    VectorXd spread = VectorXd::Zero(compliance_.size());
    for (std::size_t k = 0; k < points_.size(); ++k)
      if (const double force = forces[static_cast<Index>(k)]; force != 0)
        points_[k]->stencil.scatter(force * normal_of(k), spread);
    return spread;
  }

  VectorXd gaps(const VectorXd& d) const {
    VectorXd gaps(static_cast<Index>(points_.size()));
    for (std::size_t k = 0; k < points_.size(); ++k)
      gaps[static_cast<Index>(k)] = normal_of(k).dot(points_[k]->stencil.gather(d));
    return gaps;
  }

private:
  Eigen::Vector3d normal_of(std::size_t k) const { return Eigen::Vector3d(points_[k]->frame.data()); }

  std::span<PredictorPoint* const> points_;
  const Compliance& compliance_;
};

/// A between interface dofs: the stiffness of the surface with the bulk held.
VectorXd held_stiffness(const linalg::SparseMatrix& matrix, const Compliance& compliance,
                        const VectorXd& moved) {
  VectorXd of_unknowns = VectorXd::Zero(matrix.cols());
  for (Index i = 0; i < moved.size(); ++i)
    compliance.for_each_unknown(static_cast<int>(i), [&](int unknown, double coefficient) {
      of_unknowns[unknown] += coefficient * moved[i];
    });
  const VectorXd forces = linalg::product(matrix, of_unknowns);
  VectorXd on_surface = VectorXd::Zero(moved.size());
  for (Index i = 0; i < moved.size(); ++i)
    compliance.for_each_unknown(static_cast<int>(i), [&](int unknown, double coefficient) {
      on_surface[i] += coefficient * forces[unknown];
    });
  return on_surface;
}

} // namespace

bool ContactPredictor::are_too_many() const {
  const auto most = compliance_.has_dear_columns() ? std::min(most_columns, most_formed_) : most_formed_;
  return how_far_ == NormalSolution::near && chosen_.size() > most;
}

/// All points at once: MPRGP joins and releases them. Friction stays what it was, within its limit.
void ContactPredictor::improve_by_products(std::span<PredictorPoint> points, const VectorXd& free,
                                           const linalg::WholeMatrix& matrix, Progress& progress) {
  VectorXd unpressed = free;
  add_motion(points, 1, 2, unpressed);
  forget_points();
  for (auto& point : points)
    if (!point.stencil.nodes.empty())
      chosen_.push_back(&point);
  const PressedSurface surface(chosen_, compliance_);
  const auto count = static_cast<Index>(chosen_.size());
  VectorXd values(count), forces(count), springs(count);
  for (Index k = 0; k < count; ++k) {
    const auto& point = *chosen_[static_cast<std::size_t>(k)];
    values[k] = measures_of(point, unpressed)[0];
    forces[k] = point.force[0];
    springs[k] = point.penalty_compliance;
  }
  const NormalProducts products{[&](const VectorXd& by) {
                                  VectorXd moved = VectorXd::Zero(compliance_.size());
                                  compliance_.add(factor_, surface.spread(by), moved);
                                  VectorXd gaps = surface.gaps(moved);
                                  for (Index k = 0; k < count; ++k)
                                    gaps[k] += springs[k] * by[k];
                                  return gaps;
                                },
                                [&](const VectorXd& by) {
                                  return surface.gaps(
                                      held_stiffness(matrix.get(), compliance_, surface.spread(by)));
                                },
                                power_products};
  const double deepest = -std::min(0.0, values.minCoeff());
  const auto found = minimise_over_nonnegative(products, values, forces,
                                               {gaps_left * deepest, most_mprgp_products}, progress);
  if (found)
    forces = *found;
  for (Index k = 0; k < count; ++k) {
    auto& point = *chosen_[static_cast<std::size_t>(k)];
    point.force[0] = forces[k];
    const double limit = point.friction * point.force[0];
    if (const double length = std::sqrt(point.force[1] * point.force[1] + point.force[2] * point.force[2]);
        length > limit) {
      point.force[1] *= limit / length;
      point.force[2] *= limit / length;
    }
  }
}

} // namespace rubato::step
