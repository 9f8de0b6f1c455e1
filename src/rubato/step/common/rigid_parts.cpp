// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/rigid_parts.hpp"

#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/model/model.hpp"
#include "rubato/study/study.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>

namespace rubato::step {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using mesh::NodeIndex;
using model::Model;

/// A spring that a motion moves by less than this part of what it moves others by is not moved at all.
constexpr double row_rounding = 1e-12;

Index mode_count(const Model& model) {
  if (model.study.physics == study::Physics::axisymmetric)
    return 1;
  return model.dofs.components == 3 ? 6 : 3;
}

std::vector<mesh::CellIndex> constant_cells(const domain::Bulk& bulk) {
  std::vector<mesh::CellIndex> cells;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    if (bulk.is_constant(i))
      cells.push_back(bulk.cells[i]);
  return cells;
}

/// The motions in the span of the columns that do not move `row`.
void take_out(const VectorXd& row, MatrixXd& motions) {
  if (motions.cols() == 0)
    return;
  const VectorXd moved = linalg::transposed_product(motions, row);
  if (moved.norm() <= row_rounding * row.norm())
    return;
  const MatrixXd turned = linalg::orthogonal_factor(moved);
  MatrixXd others(turned.rows(), motions.cols() - 1);
  std::copy_n(turned.data() + turned.rows(), others.size(), others.data());
  motions = linalg::product(motions, others);
}

MatrixXd transposed(const MatrixXd& matrix) {
  MatrixXd turned(matrix.cols(), matrix.rows());
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < matrix.rows(); ++i)
      turned(j, i) = matrix(i, j);
  return turned;
}

// Of all bodies, a column each: a few operations a node, as each step asks for them.

void add_axial(std::span<const RigidParts::Lever> levers, const VectorXd& x, MatrixXd& sums) {
  for (const auto& lever : levers)
    sums(0, lever.body) += x[lever.dof + 1];
}

void add_plane(std::span<const RigidParts::Lever> levers, const VectorXd& x, MatrixXd& sums) {
  for (const auto& [body, dof, arm] : levers) {
    const double* value = x.data() + dof;
    double* sum = sums.data() + std::ptrdiff_t{3} * body;
    sum[0] += value[0];
    sum[1] += value[1];
    sum[2] += arm[0] * value[1] - arm[1] * value[0];
  }
}

void add_solid(std::span<const RigidParts::Lever> levers, const VectorXd& x, MatrixXd& sums) {
  for (const auto& [body, dof, arm] : levers) {
    const double* value = x.data() + dof;
    double* sum = sums.data() + std::ptrdiff_t{6} * body;
    sum[0] += value[0];
    sum[1] += value[1];
    sum[2] += value[2];
    sum[3] += arm[1] * value[2] - arm[2] * value[1];
    sum[4] += arm[2] * value[0] - arm[0] * value[2];
    sum[5] += arm[0] * value[1] - arm[1] * value[0];
  }
}

} // namespace

RigidParts::RigidParts(const Model& model)
    : model_(&model), number_(model.mesh, constant_cells(model.bulk)),
      bodies_(static_cast<std::size_t>(number_.count())) {
  place_bodies();
  find_held();
  collect_levers();
  fit_bodies();
}

/// Centres are means over the nodes, sizes reach from there to the farthest one.
void RigidParts::place_bodies() {
  std::vector<int> counts(bodies_.size(), 0);
  const auto for_each_node = [&](const auto& take) {
    for (const auto node : model_->dofs.nodes)
      if (const int body = number_.of(node); body >= 0)
        take(static_cast<std::size_t>(body), model_->mesh.points[static_cast<std::size_t>(node)]);
  };
  for_each_node([&](std::size_t body, const Vector3d& place) {
    bodies_[body].centre += place;
    ++counts[body];
  });
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    bodies_[body].centre /= counts[body];
  for_each_node([&](std::size_t body, const Vector3d& place) {
    bodies_[body].size = std::max(bodies_[body].size, (place - bodies_[body].centre).norm());
  });
}

/// A node's rows of Z.
RigidParts::Modes RigidParts::modes_at(NodeIndex node) const {
  const int components = model_->dofs.components;
  Modes modes = Modes::Zero(components, mode_count(*model_));
  if (modes.cols() == 1) { // axisymmetric
    modes(1, 0) = 1;
    return modes;
  }
  const auto& body = bodies_[static_cast<std::size_t>(number_.of(node))];
  const Vector3d arm = (model_->mesh.points[static_cast<std::size_t>(node)] - body.centre) / body.size;
  for (int a = 0; a < components; ++a)
    modes(a, a) = 1;
  if (components == 2) { // turns are axis × arm
    modes(0, 2) = -arm[1];
    modes(1, 2) = arm[0];
    return modes;
  }
  modes(1, 3) = -arm[2];
  modes(2, 3) = arm[1];
  modes(0, 4) = arm[2];
  modes(2, 4) = -arm[0];
  modes(0, 5) = -arm[1];
  modes(1, 5) = arm[0];
  return modes;
}

VectorXd RigidParts::row_of(const Modes& modes, int row) {
  VectorXd values(modes.cols());
  for (Index k = 0; k < values.size(); ++k)
    values[k] = modes(row, k);
  return values;
}

/// What a gauge has of the modes of each body: cells between two of them may join what it holds.
std::map<int, VectorXd> RigidParts::rows_of(const model::Gauge& gauge) const {
  const int components = model_->dofs.components;
  std::map<int, VectorXd> rows;
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i)
    if (const int body = number_.of(gauge.nodes[i]); body >= 0) {
      VectorXd& row = rows.try_emplace(body, VectorXd::Zero(mode_count(*model_))).first->second;
      const auto modes = modes_at(gauge.nodes[i]);
      for (Index k = 0; k < row.size(); ++k)
        for (int a = 0; a < components; ++a)
          row[k] += modes(a, k) * gauge.values[static_cast<Index>(i) * components + a];
    }
  return rows;
}

/// By body: independent combinations of its modes that move no spring and no gauge, a column each.
std::vector<MatrixXd> RigidParts::unresisted() const {
  const int components = model_->dofs.components;
  const Index modes = mode_count(*model_);
  std::vector<MatrixXd> motions(bodies_.size(), MatrixXd::Identity(modes, modes));
  const auto resist = [&](NodeIndex node, const VectorXd& row) {
    take_out(row, motions[static_cast<std::size_t>(number_.of(node))]);
  };
  for (const auto& spring : model_->springs)
    if (const auto node = model_->node_of(spring.dof); number_.of(node) >= 0)
      resist(node, row_of(modes_at(node), spring.dof % components));
  for (const auto& connector : model_->connectors)
    if (connector.stiffness > 0)
      for (const auto& term : connector.row)
        if (const auto node = model_->node_of(term.dof); number_.of(node) >= 0)
          resist(node, row_of(modes_at(node), term.dof % components));
  for (const auto& gauge : model_->gauges)
    for (const auto& [body, row] : rows_of(gauge))
      take_out(row, motions[static_cast<std::size_t>(body)]);
  return motions;
}

/// fit = N (Nᵀ ZᵀZ N)⁻¹ Nᵀ with the unresisted motions in the columns of N.
void RigidParts::fit_bodies() {
  const Index modes = mode_count(*model_);
  std::vector<MatrixXd> grams(bodies_.size(), MatrixXd::Zero(modes, modes));
  for (const auto node : model_->dofs.nodes)
    if (const int body = number_.of(node); body >= 0) {
      const auto rows = modes_at(node);
      auto& gram = grams[static_cast<std::size_t>(body)];
      for (Index j = 0; j < modes; ++j)
        for (Index i = 0; i < modes; ++i)
          for (Index a = 0; a < rows.rows(); ++a)
            gram(i, j) += rows(a, i) * rows(a, j);
    }
  const auto motions = unresisted();
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const auto& n = motions[body];
    const MatrixXd gram = linalg::transposed_product(n, linalg::product(grams[body], n));
    bodies_[body].fit = MatrixXd::Zero(modes, modes);
    if (n.cols() > 0 && !bodies_[body].held)
      bodies_[body].fit = linalg::product(n, linalg::solve_symmetric(gram, transposed(n)));
  }
}

/// A body is held when supports that do not move leave it no rigid motion: its displacements are
/// deformations.
void RigidParts::find_held() {
  const Index modes = mode_count(*model_);
  std::vector<MatrixXd> motions(bodies_.size(), MatrixXd::Identity(modes, modes));
  for (const auto& support : model_->reduction.prescribed()) {
    const auto node = model_->node_of(support.dof);
    const int body = number_.of(node);
    if (support.imposed.value == 0 && !model_->reduction.moves(support) && body >= 0)
      take_out(row_of(modes_at(node), support.dof % model_->dofs.components),
               motions[static_cast<std::size_t>(body)]);
  }
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    bodies_[body].held = motions[body].cols() == 0;
}

void RigidParts::collect_levers() {
  levers_.reserve(model_->dofs.nodes.size());
  for (const auto node : model_->dofs.nodes)
    if (const int number = number_.of(node); number >= 0) {
      const auto& body = bodies_[static_cast<std::size_t>(number)];
      if (body.held)
        continue;
      const Vector3d arm = (model_->mesh.points[static_cast<std::size_t>(node)] - body.centre) / body.size;
      levers_.push_back({number, model_->dofs.dof(node, 0), {arm[0], arm[1], arm[2]}});
    }
}

MatrixXd RigidParts::resultants(const VectorXd& x) const {
  MatrixXd sums = MatrixXd::Zero(mode_count(*model_), number_.count());
  if (sums.rows() == 1)
    add_axial(levers_, x, sums);
  else if (sums.rows() == 3)
    add_plane(levers_, x, sums);
  else
    add_solid(levers_, x, sums);
  return sums;
}

double RigidParts::work(const MatrixXd& motion, const MatrixXd& force) const {
  double sum = 0;
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    if (bodies_[body].held)
      continue;
    const auto column = static_cast<Index>(body);
    const auto& fit = bodies_[body].fit;
    for (Index i = 0; i < fit.rows(); ++i) {
      double fitted = 0;
      for (Index j = 0; j < fit.cols(); ++j)
        fitted += fit(i, j) * motion(j, column);
      sum += force(i, column) * fitted;
    }
  }
  return sum;
}

} // namespace rubato::step
