// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/rigid_motions.hpp"

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/model/lone_nodes.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using mesh::NodeIndex;

/// Eigenvalues below this part of the largest belong to motions nothing holds.
constexpr double rank_tolerance = 1e-9;
/// What is left of a relation below this part of its terms is rounding.
constexpr double relation_rounding = 1e-9;
/// Parts of a motion below this part of its largest are rounding.
constexpr double negligible = 1e-6;

Index mode_count(const Model& model) {
  if (model.study.physics == study::Physics::axisymmetric)
    return 1;
  return model.dofs.components == 3 ? 6 : 3;
}

Index count_above(const Eigen::VectorXd& values, double limit) {
  return std::count_if(values.begin(), values.end(), [limit](double value) { return value > limit; });
}

Index count_up_to(const Eigen::VectorXd& values, double limit) {
  return std::count_if(values.begin(), values.end(), [limit](double value) { return value <= limit; });
}

/// What resists a body's own motions alone.
Index rank_of(const MatrixXd& gram) {
  const auto values = linalg::symmetric_eigenvalues(gram);
  const double largest = values[values.size() - 1];
  return largest > 0 ? count_above(values, rank_tolerance * largest) : 0;
}

/// Some rows of some columns, both from the given ones on.
MatrixXd part_of(const MatrixXd& matrix, Index row, Index rows, Index column, Index columns) {
  MatrixXd part(rows, columns);
  for (Index j = 0; j < columns; ++j)
    for (Index i = 0; i < rows; ++i)
      part(i, j) = matrix(row + i, column + j);
  return part;
}

/// Root of the sum of the squares of some rows.
double size_of_rows(const MatrixXd& matrix, Index first, Index rows) {
  double sum = 0;
  for (Index j = 0; j < matrix.cols(); ++j)
    for (Index i = 0; i < rows; ++i)
      sum += matrix(first + i, j) * matrix(first + i, j);
  return std::sqrt(sum);
}

/// The column from `first` on whose entry in a row is largest.
Index pivot_column(const MatrixXd& columns, Index row, Index first) {
  Index pivot = first;
  for (Index k = first + 1; k < columns.cols(); ++k)
    if (std::abs(columns(row, k)) > std::abs(columns(row, pivot)))
      pivot = k;
  return pivot;
}

/// "x", or "(0.6, 0.8, 0)", with the largest component positive.
std::string axis_text(Vector3d axis) {
  Index largest = 0;
  axis = contact::unit_of(axis);
  for (Index i = 1; i < axis.size(); ++i)
    if (std::abs(axis[i]) > std::abs(axis[largest]))
      largest = i;
  if (axis[largest] < 0)
    axis = Vector3d(-axis[0], -axis[1], -axis[2]);
  for (auto& value : axis)
    if (std::abs(value) < negligible)
      value = 0;
  if (1 - axis[largest] < negligible)
    return std::string(1, "xyz"[largest]);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", axis[0], axis[1], axis[2]);
}

/// Independent motions that span the columns, turns told apart first: what is left then are shifts.
std::vector<Eigen::VectorXd> columns_told_apart(MatrixXd columns) {
  const double scale = linalg::largest_magnitude(columns);
  const Index rows = columns.rows();
  Index done = 0;
  for (Index row = rows - 1; row >= 0 && done < columns.cols(); --row) {
    const Index pivot = pivot_column(columns, row, done);
    if (std::abs(columns(row, pivot)) <= negligible * scale)
      continue;
    double* own = &columns(0, done);
    if (pivot != done)
      std::swap_ranges(own, own + rows, &columns(0, pivot));
    const double divisor = own[row];
    for (Index i = 0; i < rows; ++i)
      own[i] /= divisor;
    for (Index other = 0; other < columns.cols(); ++other) {
      if (other == done)
        continue;
      const double factor = columns(row, other);
      for (Index i = 0; i < rows; ++i)
        columns(i, other) -= factor * own[i];
    }
    ++done;
  }
  std::vector<Eigen::VectorXd> motions;
  for (Index k = 0; k < done; ++k) {
    Eigen::VectorXd& motion = motions.emplace_back(rows);
    std::copy_n(&columns(0, k), rows, motion.data());
  }
  return motions;
}

/// Nodes without cells that supports do not hold whole.
std::vector<NodeIndex> free_lone_nodes(const Model& model) {
  auto nodes = lone_nodes_of(model);
  std::erase_if(nodes, [&](NodeIndex node) {
    for (int i = 0; i < model.dofs.components; ++i)
      if (!model.reduction.is_prescribed(model.dofs.dof(node, i)))
        return false;
    return true;
  });
  return nodes;
}

bool turns(const RigidMotion& motion) {
  return contact::length_of(motion.turn) > negligible * contact::length_of(motion.shift);
}

} // namespace

RigidMotions::RigidMotions(const Model& model)
    : model_(model), bodies_(model.mesh, model.bulk), lone_(free_lone_nodes(model)),
      modes_(mode_count(model)), ties_bodies_(!lone_.empty()), gram_(MatrixXd::Zero(columns(), columns())) {
  Vector3d low = model.mesh.points.front();
  Vector3d high = low;
  for (const auto& point : model.mesh.points)
    for (Index i = 0; i < point.size(); ++i) {
      low[i] = std::min(low[i], point[i]);
      high[i] = std::max(high[i], point[i]);
    }
  for (Index i = 0; i < low.size(); ++i)
    centre_[i] = (low[i] + high[i]) / 2;
  size_ = contact::length_of(contact::difference_of(high, low));
}

void RigidMotions::add_supports() {
  add_firm_supports();
  for (const auto& spring : model_.springs)
    if (spring.soft)
      add_dof(spring.dof);
}

void RigidMotions::add_firm_supports() {
  for (const auto& support : model_.reduction.prescribed())
    add_dof(support.dof);
  for (const auto& dependent : model_.reduction.dependents())
    add_relation(dependent);
  for (const auto& spring : model_.springs)
    if (!spring.soft)
      add_dof(spring.dof);
  for (const auto& connector : model_.connectors)
    if (connector.resists())
      add_connector(connector);
  for (const auto& gauge : model_.gauges)
    add_gauge(gauge);
}

void RigidMotions::add_contact() {
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model_.dofs.dof_count);
  const contact::Configuration configuration{
      &model_.mesh, &model_.dofs, &rest, &rest, model_.study.time.begin, model_.study.time.begin};
  for (const auto& zone : model_.zones) {
    const auto pairs = contact::find_pairs(zone, configuration);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      if (pairs[i].paired() && !zone.points[i].excluded)
        add_point(zone, zone.points[i], pairs[i], configuration);
  }
}

std::vector<char> RigidMotions::held() const {
  std::vector<char> held;
  held.reserve(static_cast<std::size_t>(bodies_.count()));
  for (int body = 0; body < bodies_.count(); ++body)
    held.push_back(motions_left(body).cols() == 0 ? 1 : 0);
  return held;
}

MatrixXd RigidMotions::block_of(int body) const {
  return part_of(gram_, body * modes_, modes_, body * modes_, modes_);
}

/// Columns that span the motions that a body has left: alone, or together with those that relations tie to
/// it.
MatrixXd RigidMotions::motions_left(int body) const {
  if (!ties_bodies_) {
    const auto block = block_of(body);
    return part_of(linalg::symmetric_eigen(block).vectors, 0, modes_, 0, modes_ - rank_of(block));
  }
  const auto [values, vectors] = linalg::symmetric_eigen(gram_);
  const Index count = count_up_to(values, rank_tolerance * values[columns() - 1]);
  MatrixXd spanned = MatrixXd::Zero(modes_, modes_);
  for (Index k = 0; k < count; ++k)
    linalg::add_square(1, Eigen::Map<const Eigen::VectorXd>(&vectors(body * modes_, k), modes_), spanned);
  const auto eigen = linalg::symmetric_eigen(spanned);
  const Index left = count_above(eigen.values, rank_tolerance);
  return part_of(eigen.vectors, 0, modes_, modes_ - left, left);
}

std::vector<RigidMotion> RigidMotions::loose_alone() const {
  std::vector<RigidMotion> loose;
  for (int body = 0; body < bodies_.count(); ++body)
    if (const auto left = motions_left(body); left.cols() > 0)
      for (const auto& motion : columns_told_apart(left))
        loose.push_back(motion_of(body, motion));
  return loose;
}

std::vector<RigidMotion> RigidMotions::loose() const {
  const auto [values, vectors] = linalg::symmetric_eigen(gram_);
  const double allowed = rank_tolerance * values[columns() - 1];
  const Index count = count_up_to(values, allowed);
  if (count == 0)
    return {};
  const auto motions = part_of(vectors, 0, columns(), 0, count);
  Index body = 0;
  double largest = 0;
  for (Index b = 0; b < bodies_.count(); ++b)
    if (const double moved = size_of_rows(motions, b * modes_, modes_); moved > largest) {
      largest = moved;
      body = b;
    }
  std::vector<RigidMotion> loose;
  if (largest <= negligible) // of nodes without cells
    return loose;
  for (const auto& motion : columns_told_apart(part_of(motions, body * modes_, modes_, 0, count)))
    loose.push_back(motion_of(static_cast<int>(body), motion));
  return loose;
}

std::vector<NodeIndex> RigidMotions::loose_nodes() const {
  std::vector<NodeIndex> nodes;
  if (lone_.empty())
    return nodes;
  const auto [values, vectors] = linalg::symmetric_eigen(gram_);
  const Index count = count_up_to(values, rank_tolerance * values[columns() - 1]);
  const auto motions = part_of(vectors, 0, columns(), 0, count);
  const Index components = model_.dofs.components;
  for (std::size_t k = 0; k < lone_.size(); ++k) {
    const Index first = columns_of_bodies() + static_cast<Index>(k) * components;
    if (size_of_rows(motions, first, components) > negligible)
      nodes.push_back(lone_[k]);
  }
  return nodes;
}

std::vector<RigidMotion> RigidMotions::all_of(int body) const {
  std::vector<RigidMotion> motions;
  for (Index mode = 0; mode < modes_; ++mode) {
    Eigen::VectorXd values = Eigen::VectorXd::Zero(modes_);
    values[mode] = 1;
    motions.push_back(motion_of(body, values));
  }
  return motions;
}

std::vector<RigidMotion> RigidMotions::told_apart(std::span<const RigidMotion> motions) const {
  std::vector<RigidMotion> apart;
  if (motions.empty())
    return apart;
  MatrixXd values(6, static_cast<Index>(motions.size()));
  for (std::size_t k = 0; k < motions.size(); ++k)
    for (Index i = 0; i < 3; ++i) {
      values(i, static_cast<Index>(k)) = motions[k].shift[i];
      values(3 + i, static_cast<Index>(k)) = motions[k].turn[i];
    }
  for (const auto& column : columns_told_apart(values))
    apart.push_back({motions.front().body, Vector3d(column[0], column[1], column[2]),
                     Vector3d(column[3], column[4], column[5])});
  return apart;
}

Vector3d RigidMotions::at(const RigidMotion& motion, const Vector3d& place) const {
  const auto turned = contact::cross(motion.turn, contact::difference_of(place, centre_));
  Vector3d moved = motion.shift;
  for (Index i = 0; i < moved.size(); ++i)
    moved[i] += turned[i] / size_;
  return moved;
}

int RigidMotions::body_of_dof(int dof) const {
  return bodies_.of(model_.dofs.nodes[static_cast<std::size_t>(dof / model_.dofs.components)]);
}

Eigen::VectorXd RigidMotions::row_of_dof(int dof) const {
  Vector3d direction = Vector3d::Zero();
  direction[dof % model_.dofs.components] = 1;
  return row(model_.dofs.nodes[static_cast<std::size_t>(dof / model_.dofs.components)], direction);
}

/// A connector that rotates also resists motions across it if it has a force in the undeformed model.
void RigidMotions::add_connector(const Connector& connector) {
  add_terms(connector.row);
  if (connector.line && connector.line->spring.at(0) != 0)
    for (const auto& direction : connector.way->moved)
      if (!direction.empty())
        add_terms(direction);
}

void RigidMotions::add_terms(const std::vector<constraint::Term>& terms) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns());
  for (const auto& term : terms) {
    linalg::add_scaled(term.coefficient, row_of_dof(term.dof), sum);
    ties_bodies_ = ties_bodies_ || body_of_dof(term.dof) != body_of_dof(terms.front().dof);
  }
  add_row(sum);
}

void RigidMotions::add_dof(int dof) {
  add_row(row_of_dof(dof));
}

/// Relations of a body that is rigid by them say nothing of its rigid motions: their rows are rounding.
void RigidMotions::add_relation(const constraint::DependentDof& dependent) {
  Eigen::VectorXd sum = row_of_dof(dependent.dof);
  double summed = linalg::largest_magnitude(sum);
  for (const auto* terms : {&dependent.of, &dependent.prescribed})
    for (const auto& term : *terms) {
      const auto row = row_of_dof(term.dof);
      summed = std::max(summed, std::abs(term.coefficient) * linalg::largest_magnitude(row));
      linalg::add_scaled(-term.coefficient, row, sum);
      ties_bodies_ = ties_bodies_ || body_of_dof(term.dof) != body_of_dof(dependent.dof);
    }
  if (linalg::largest_magnitude(sum) > relation_rounding * summed)
    add_row(sum);
}

void RigidMotions::add_gauge(const Gauge& gauge) {
  const int components = model_.dofs.components;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(columns());
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    Vector3d direction = Vector3d::Zero();
    for (int a = 0; a < components; ++a)
      direction[a] = gauge.values[static_cast<Index>(i) * components + a];
    linalg::add_scaled(1, row(gauge.nodes[i], direction), sum);
  }
  const double length = gauge.values.norm();
  for (auto& value : sum)
    value /= length;
  add_row(sum);
}

/// Most entries are 0: those of the other bodies.
void RigidMotions::add_row(const Eigen::VectorXd& row) {
  for (Index j = 0; j < row.size(); ++j)
    if (row[j] != 0)
      for (Index i = 0; i < row.size(); ++i)
        gram_(i, j) += row[i] * row[j];
}

/// Component along `direction` of a node's motion in every mode of its body.
Eigen::VectorXd RigidMotions::row(NodeIndex node, const Vector3d& direction) const {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(columns());
  const int body = bodies_.of(node);
  if (body < 0) {
    const auto found = std::ranges::lower_bound(lone_, node);
    if (found != lone_.end() && *found == node)
      for (Index a = 0; a < model_.dofs.components; ++a)
        r[columns_of_bodies() + (found - lone_.begin()) * model_.dofs.components + a] = direction[a];
    return r;
  }
  const Index first = static_cast<Index>(body) * modes_;
  if (modes_ == 1) {
    r[first] = direction[1];
    return r;
  }
  const int components = model_.dofs.components;
  const auto& place = model_.mesh.points[static_cast<std::size_t>(node)];
  Vector3d arm;
  for (Index a = 0; a < arm.size(); ++a)
    arm[a] = (place[a] - centre_[a]) / size_;
  const auto turn = contact::cross(arm, direction);
  for (int a = 0; a < components; ++a)
    r[first + a] = direction[a];
  for (Index a = components == 3 ? 0 : 2; a < 3; ++a)
    r[first + (components == 3 ? 3 + a : a)] = turn[a];
  return r;
}

void RigidMotions::add_point(const contact::Zone& zone, const contact::SlavePoint& point,
                             const contact::Pair& pair, const contact::Configuration& configuration) {
  const auto kinematics = contact::evaluate_kinematics(zone, point, pair, configuration);
  const int directions = zone.settings.friction > 0 || zone.settings.tie ? zone.space_dimension : 1;
  for (int a = 0; a < directions; ++a) {
    const Vector3d direction = a == 0 ? kinematics.normal : contact::column_of(kinematics.tangents, a - 1);
    Eigen::VectorXd relative = Eigen::VectorXd::Zero(columns());
    for (std::size_t i = 0; i < kinematics.stencil.nodes.size(); ++i)
      linalg::add_scaled(kinematics.stencil.weights[static_cast<Index>(i)],
                         row(kinematics.stencil.nodes[i], direction), relative);
    if (zone.settings.tie)
      carry_gap(kinematics, direction, relative);
    add_row(relative);
  }
}

/// The gap of a tie turns with the master: the master's motion counts where the slave's point is.
void RigidMotions::carry_gap(const contact::Kinematics& kinematics, const Vector3d& direction,
                             Eigen::VectorXd& relative) const {
  const int body = kinematics.stencil.nodes.empty() ? -1 : bodies_.of(kinematics.stencil.nodes.back());
  if (body < 0 || modes_ == 1)
    return;
  const auto gap = kinematics.stencil.sum(
      [&](NodeIndex node) { return model_.mesh.points[static_cast<std::size_t>(node)]; });
  const auto turn = contact::cross(contact::scaled(1 / size_, gap), direction);
  const int components = model_.dofs.components;
  const Index first = static_cast<Index>(body) * modes_;
  for (Index a = components == 3 ? 0 : 2; a < 3; ++a)
    relative[first + (components == 3 ? 3 + a : a)] -= turn[a];
}

RigidMotion RigidMotions::motion_of(int body, const Eigen::VectorXd& values) const {
  RigidMotion motion{.body = body};
  const int components = model_.dofs.components;
  if (modes_ == 1)
    motion.shift[1] = values[0];
  else {
    for (int a = 0; a < components; ++a)
      motion.shift[a] = values[a];
    if (components == 3)
      motion.turn = Vector3d(values[3], values[4], values[5]);
    else
      motion.turn[2] = values[2];
  }
  return motion;
}

std::string direction_text(const RigidMotion& motion) {
  return turns(motion) ? "by turning about " + axis_text(motion.turn) : "along " + axis_text(motion.shift);
}

namespace {

/// What a support would have to do.
std::string holding_text(const RigidMotion& motion) {
  return turns(motion) ? "against turning about " + axis_text(motion.turn)
                       : "along " + axis_text(motion.shift);
}

} // namespace

std::vector<LooseBody> loose_bodies(const Model& model) {
  RigidMotions motions(model);
  motions.add_firm_supports();
  std::vector<LooseBody> loose;
  for (const auto& motion : motions.loose_alone()) {
    const auto node = motions.bodies().first_node(motion.body);
    if (loose.empty() || loose.back().node != node)
      loose.push_back({node, ""});
    auto& against = loose.back().against; // turns come first, shifts are what a reader looks for
    against.insert(0, holding_text(motion) + (against.empty() ? "" : ", "));
  }
  return loose;
}

std::vector<NodeIndex> free_body_nodes(const Model& model) {
  RigidMotions motions(model);
  motions.add_firm_supports();
  const auto held = motions.held();
  std::vector<NodeIndex> nodes;
  for (const auto node : model.dofs.nodes)
    if (const int body = motions.bodies().of(node); body >= 0 && held[static_cast<std::size_t>(body)] == 0)
      nodes.push_back(node);
  return nodes;
}

} // namespace rubato::model
