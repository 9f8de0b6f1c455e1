// SPDX-License-Identifier: LGPL-3.0-or-later
// Blocks that fly, tumble and stretch: the forces of energy_momentum.hpp keep energy and angular momentum
// where the mean of the forces at both ends, the trapezoidal rule, does not.
#include "rubato/element/energy_momentum.hpp"
#include "rubato/material/point_law.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "kind_cases.hpp"
#include "support/dense.hpp"
#include <vector>

namespace rubato::element::tumbling_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using material::PointLaw;
using study::Physics;

enum class Rule { energy_momentum, trapezoidal };

/// Three cells of size 1 in a row, of density 1.
class Block {
public:
  Block(const CellKind& kind, const PointLaw& law)
      : kind_(kind), law_(law), laws_(law_), d_(component_count(kind.section.physics)) {
    for (int level = 0; level <= 3; ++level)
      for (const auto& corner : section())
        points_.push_back(corner + Vector3d(0, 0, level));
    if (d_ == 2)
      for (auto& point : points_)
        point = Vector3d(point[0], point[2], 0);
    for (int cell = 0; cell < 3; ++cell)
      cells_.push_back(nodes_of(cell));
    u_ = v_ = VectorXd::Zero(static_cast<Eigen::Index>(points_.size()) * d_);
    states_.assign(
        3, std::vector<double>(static_cast<std::size_t>(state_size_of_cell(kind_, laws_.state_size()))));
    set_mass();
  }

  /// ω × x, a flight, and the ends away from each other.
  void throw_it(const Vector3d& turn) {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector3d& x = points_[i];
      Vector3d v = turn.cross(x) + Vector3d(3, 1, -2);
      v[d_ - 1] += 2.5 * (x[d_ - 1] - 1.5);
      v_.segment(static_cast<Eigen::Index>(i) * d_, d_) = v.head(d_);
    }
    assemble(Rule::trapezoidal, u_);
    stored_ = stored_after_;
    force_before_ = force_;
    states_ = after_;
  }

  /// M [v]/h + f = 0, [u] = h {v}: Newton's method to rounding.
  bool advance(Rule rule, double h) {
    constexpr int most_iterations = 60;
    VectorXd u = u_ + h * v_;
    double before = 1e300;
    for (int i = 0; i < most_iterations; ++i) {
      if (!assemble(rule, u))
        return false;
      const VectorXd residual = mass_ * (2 * (u - u_) / h - 2 * v_) / h + force_;
      const double now = residual.norm(), size = force_.norm();
      if (now <= 1e-10 * size && now > 0.7 * before) {
        accept(u, h);
        return true;
      }
      before = now;
      u -= test::dense_solution(2 / (h * h) * mass_ + tangent_, residual);
    }
    return false;
  }

  double energy() const { return 0.5 * v_.dot(mass_ * v_) + stored_; }

  Vector3d angular_momentum() const {
    const VectorXd momentum = mass_ * v_;
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i) * d_;
      Vector3d x = points_[i], p = Vector3d::Zero();
      x.head(d_) += u_.segment(at, d_);
      p.head(d_) = momentum.segment(at, d_);
      sum += x.cross(p);
    }
    return sum;
  }

  double stored() const { return stored_; }

private:
  std::vector<Vector3d> section() const {
    if (d_ == 2)
      return {{0, 0, 0}, {1, 0, 0}};
    return {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  }

  std::vector<int> nodes_of(int cell) const {
    if (d_ == 2)
      return {2 * cell, 2 * cell + 1, 2 * cell + 3, 2 * cell + 2};
    std::vector<int> nodes(8);
    for (int i = 0; i < 8; ++i)
      nodes[static_cast<std::size_t>(i)] = 4 * cell + i;
    return nodes;
  }

  std::vector<Vector3d> points_of(const std::vector<int>& nodes) const {
    std::vector<Vector3d> points;
    for (const int node : nodes)
      points.push_back(points_[static_cast<std::size_t>(node)]);
    return points;
  }

  void set_mass() {
    mass_ = MatrixXd::Zero(u_.size(), u_.size());
    for (const auto& nodes : cells_) {
      const auto count = static_cast<Eigen::Index>(nodes.size());
      MatrixXd m(count, count);
      mass(kind_.type, points_of(nodes), 1., kind_.section, m);
      for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < count; ++j)
          for (int a = 0; a < d_; ++a)
            mass_(nodes[static_cast<std::size_t>(i)] * d_ + a, nodes[static_cast<std::size_t>(j)] * d_ + a) +=
                m(i, j);
    }
  }

  bool assemble(Rule rule, const VectorXd& u) {
    force_ = VectorXd::Zero(u.size());
    tangent_ = MatrixXd::Zero(u.size(), u.size());
    after_ = states_;
    stored_after_ = 0;
    for (std::size_t cell = 0; cell < cells_.size(); ++cell)
      if (!add_cell(rule, cell, u))
        return false;
    if (rule == Rule::trapezoidal) {
      force_after_ = force_;
      if (force_before_.size() > 0)
        force_ = (0.5 * (force_before_ + force_after_)).eval();
      tangent_ /= 2;
    }
    return true;
  }

  bool add_cell(Rule rule, std::size_t cell, const VectorXd& u) {
    const auto points = points_of(cells_[cell]);
    std::vector<int> dofs;
    for (const int node : cells_[cell])
      for (int a = 0; a < d_; ++a)
        dofs.push_back(node * d_ + a);
    const auto count = static_cast<Eigen::Index>(dofs.size());
    const VectorXd before = u_(dofs), here = u(dofs);
    VectorXd force(count);
    MatrixXd tangent(count, count);
    const auto size = dofs.size();
    const std::span<const double> start(before.data(), size), end(here.data(), size);
    const std::span f(force.data(), size), k(tangent.data(), size * size);
    CellResult result;
    if (rule == Rule::trapezoidal)
      result = evaluate(kind_, laws_, {points, end, states_[cell]}, {after_[cell], f, k});
    else
      result =
          evaluate_between(kind_, laws_, {points, start, end, states_[cell]}, {after_[cell], f, k}).after;
    force_(dofs) += force;
    tangent_(dofs, dofs) += tangent;
    stored_after_ += result.stored;
    return static_cast<bool>(result);
  }

  void accept(const VectorXd& u, double h) {
    v_ = (2 * (u - u_) / h - v_).eval();
    u_ = u;
    stored_ = stored_after_;
    force_before_ = force_after_;
    states_ = after_;
  }

  CellKind kind_;
  PointLaw law_;
  PointLaws laws_;
  int d_;
  std::vector<Vector3d> points_;
  std::vector<std::vector<int>> cells_;
  std::vector<std::vector<double>> states_, after_;
  MatrixXd mass_, tangent_;
  VectorXd u_, v_, force_, force_before_, force_after_;
  double stored_ = 0, stored_after_ = 0;
};

struct Tumble {
  CellKind kind;
  PointLaw law;
};

/// Largest changes of energy and angular momentum by their values at the start, over 400 steps.
struct Drift {
  double energy = 0, momentum = 0, most_stored = 0;
};

Drift drift_of(const Tumble& tumble, Rule rule) {
  constexpr int steps = 400;
  constexpr double h = 0.02;
  Block block(tumble.kind, tumble.law);
  block.throw_it(component_count(tumble.kind.section.physics) == 3 ? Vector3d(2, 3, 1) : Vector3d(0, 0, 3));
  const double energy = block.energy();
  const Vector3d momentum = block.angular_momentum();
  Drift drift;
  for (int step = 0; step < steps; ++step) {
    if (!block.advance(rule, h)) {
      ADD_FAILURE() << "no end of Newton's method in step " << step;
      return drift;
    }
    drift.energy = std::max(drift.energy, std::abs(block.energy() - energy) / energy);
    drift.momentum = std::max(drift.momentum, (block.angular_momentum() - momentum).norm() / momentum.norm());
    drift.most_stored = std::max(drift.most_stored, block.stored() / energy);
  }
  return drift;
}

std::vector<Tumble> every_tumble() {
  const PointLaw rubber = material::MooneyRivlin{50., 10., 1000.},
                 stiff = material::make_elastic_point(300., 0.3);
  const CellKind plane{CellType::quad4, {Physics::plane_strain, 1}, StrainKind::green_lagrange};
  const CellKind solid{CellType::hexa8, {Physics::solid, 1}, StrainKind::green_lagrange};
  std::vector<Tumble> tumbles;
  for (const auto& kind : {plane, solid}) {
    for (const auto formulation : {Formulation::full, Formulation::mean_dilatation, Formulation::enhanced})
      tumbles.push_back({{kind.type, kind.section, StrainKind::green_lagrange, formulation}, rubber});
    for (const auto formulation : {Formulation::full, Formulation::mean_dilatation})
      tumbles.push_back({{kind.type, kind.section, StrainKind::logarithmic, formulation}, stiff});
    tumbles.push_back({{kind.type, kind.section, StrainKind::green_lagrange, Formulation::enhanced}, stiff});
  }
  tumbles.push_back({{CellType::quad4, {Physics::plane_stress, 1}, StrainKind::green_lagrange},
                     material::PlaneStress{material::MooneyRivlin{50., 10., 1000.}}});
  return tumbles;
}

TEST(TumblingBlock, KeepsItsEnergyAndAngularMomentum) {
  for (const auto& tumble : every_tumble()) {
    const auto drift = drift_of(tumble, Rule::energy_momentum);
    EXPECT_LT(drift.energy, 5e-12) << name_of(tumble.kind);
    EXPECT_LT(drift.momentum, 5e-12) << name_of(tumble.kind);
    EXPECT_GT(drift.most_stored, 0.02) << name_of(tumble.kind) << ": too stiff to tell anything";
  }
}

TEST(TumblingBlock, LosesThemByTheTrapezoidalRule) {
  const Tumble tumble{{CellType::quad4, {Physics::plane_strain, 1}, StrainKind::green_lagrange},
                      material::MooneyRivlin{50., 10., 1000.}};
  const auto drift = drift_of(tumble, Rule::trapezoidal);
  EXPECT_GT(drift.energy, 1e-3);
  EXPECT_GT(drift.momentum, 1e-4);
}

} // namespace
} // namespace rubato::element::tumbling_test
