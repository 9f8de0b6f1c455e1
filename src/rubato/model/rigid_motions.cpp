// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/rigid_motions.hpp"

#include "rubato/contact/kinematics.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
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

/// What resists a body's own motions alone.
int rank_of(const MatrixXd& gram) {
  const auto values = linalg::symmetric_eigenvalues(gram);
  const double largest = values[values.size() - 1];
  return largest > 0 ? static_cast<int>((values.array() > rank_tolerance * largest).count()) : 0;
}

/// "x", or "(0.6, 0.8, 0)", with the largest component positive.
std::string axis_text(Vector3d axis) {
  Index largest = 0;
  axis.normalize();
  axis.cwiseAbs().maxCoeff(&largest);
  if (axis[largest] < 0)
    axis = -axis;
  for (auto& value : axis)
    if (std::abs(value) < negligible)
      value = 0;
  if (1 - axis[largest] < negligible)
    return std::string(1, "xyz"[largest]);
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", axis[0], axis[1], axis[2]);
}

/// Independent motions that span the columns, turns told apart first: what is left then are shifts.
std::vector<VectorXd> columns_told_apart(MatrixXd columns) {
  std::vector<VectorXd> motions;
  const double scale = columns.cwiseAbs().maxCoeff();
  for (Index row = columns.rows() - 1; row >= 0; --row) {
    const auto done = static_cast<Index>(motions.size());
    Index pivot = 0;
    const auto candidates = columns.row(row).tail(columns.cols() - done);
    if (candidates.size() == 0 || candidates.cwiseAbs().maxCoeff(&pivot) <= negligible * scale)
      continue;
    columns.col(done).swap(columns.col(done + pivot));
    columns.col(done) /= columns(row, done);
    for (Index other = 0; other < columns.cols(); ++other)
      if (other != done)
        columns.col(other) -= columns(row, other) * columns.col(done).eval();
    motions.emplace_back();
  }
  for (std::size_t k = 0; k < motions.size(); ++k)
    motions[k] = columns.col(static_cast<Index>(k));
  return motions;
}

bool turns(const RigidMotion& motion) {
  return motion.turn.norm() > negligible * motion.shift.norm();
}

} // namespace

RigidMotions::RigidMotions(const Model& model)
    : model_(model), bodies_(model.mesh, model.bulk), modes_(mode_count(model)),
      gram_(MatrixXd::Zero(columns(), columns())) {
  Vector3d low = model.mesh.points.front();
  Vector3d high = low;
  for (const auto& point : model.mesh.points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  centre_ = (low + high) / 2;
  size_ = (high - low).norm();
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
    if (connector.stiffness > 0)
      add_connector(connector);
  for (const auto& gauge : model_.gauges)
    add_gauge(gauge);
}

void RigidMotions::add_contact() {
  const VectorXd rest = VectorXd::Zero(model_.dofs.dof_count);
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
  return gram_.block(body * modes_, body * modes_, modes_, modes_);
}

/// Columns that span the motions that a body has left: alone, or together with those that relations tie to
/// it.
MatrixXd RigidMotions::motions_left(int body) const {
  if (!ties_bodies_) {
    const auto block = block_of(body);
    return linalg::symmetric_eigen(block).vectors.leftCols(modes_ - rank_of(block));
  }
  const auto [values, vectors] = linalg::symmetric_eigen(gram_);
  const Index count = (values.array() <= rank_tolerance * values[columns() - 1]).count();
  const MatrixXd of_body = vectors.middleRows(body * modes_, modes_).leftCols(count);
  const MatrixXd spanned = of_body * of_body.transpose();
  const auto eigen = linalg::symmetric_eigen(spanned);
  return eigen.vectors.rightCols((eigen.values.array() > rank_tolerance).count());
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
  const Index count = (values.array() <= allowed).count();
  if (count == 0)
    return {};
  const MatrixXd motions = vectors.leftCols(count);
  Index body = 0;
  double largest = 0;
  for (Index b = 0; b < bodies_.count(); ++b)
    if (const double moved = motions.middleRows(b * modes_, modes_).norm(); moved > largest) {
      largest = moved;
      body = b;
    }
  std::vector<RigidMotion> loose;
  for (const auto& motion : columns_told_apart(motions.middleRows(body * modes_, modes_)))
    loose.push_back(motion_of(static_cast<int>(body), motion));
  return loose;
}

std::vector<RigidMotion> RigidMotions::all_of(int body) const {
  std::vector<RigidMotion> motions;
  for (Index mode = 0; mode < modes_; ++mode)
    motions.push_back(motion_of(body, VectorXd::Unit(modes_, mode)));
  return motions;
}

std::vector<RigidMotion> RigidMotions::told_apart(std::span<const RigidMotion> motions) const {
  std::vector<RigidMotion> apart;
  if (motions.empty())
    return apart;
  MatrixXd values(6, static_cast<Index>(motions.size()));
  for (std::size_t k = 0; k < motions.size(); ++k)
    values.col(static_cast<Index>(k)) << motions[k].shift, motions[k].turn;
  for (const auto& column : columns_told_apart(values))
    apart.push_back({motions.front().body, column.head<3>(), column.tail<3>()});
  return apart;
}

Vector3d RigidMotions::at(const RigidMotion& motion, const Vector3d& place) const {
  return motion.shift + motion.turn.cross(place - centre_) / size_;
}

int RigidMotions::body_of_dof(int dof) const {
  return bodies_.of(model_.dofs.nodes[static_cast<std::size_t>(dof / model_.dofs.components)]);
}

RowVectorXd RigidMotions::row_of_dof(int dof) const {
  Vector3d direction = Vector3d::Zero();
  direction[dof % model_.dofs.components] = 1;
  return row(model_.dofs.nodes[static_cast<std::size_t>(dof / model_.dofs.components)], direction);
}

void RigidMotions::add_connector(const Connector& connector) {
  RowVectorXd sum = RowVectorXd::Zero(columns());
  for (const auto& term : connector.row) {
    sum += term.coefficient * row_of_dof(term.dof);
    ties_bodies_ = ties_bodies_ || body_of_dof(term.dof) != body_of_dof(connector.row.front().dof);
  }
  add_row(sum);
}

void RigidMotions::add_dof(int dof) {
  add_row(row_of_dof(dof));
}

/// Relations of a body that is rigid by them say nothing of its rigid motions: their rows are rounding.
void RigidMotions::add_relation(const constraint::DependentDof& dependent) {
  RowVectorXd sum = row_of_dof(dependent.dof);
  double summed = sum.lpNorm<Eigen::Infinity>();
  for (const auto* terms : {&dependent.of, &dependent.prescribed})
    for (const auto& term : *terms) {
      const RowVectorXd part = term.coefficient * row_of_dof(term.dof);
      summed = std::max(summed, part.lpNorm<Eigen::Infinity>());
      sum -= part;
      ties_bodies_ = ties_bodies_ || body_of_dof(term.dof) != body_of_dof(dependent.dof);
    }
  if (sum.lpNorm<Eigen::Infinity>() > relation_rounding * summed)
    add_row(sum);
}

void RigidMotions::add_gauge(const Gauge& gauge) {
  const int components = model_.dofs.components;
  RowVectorXd sum = RowVectorXd::Zero(columns());
  for (std::size_t i = 0; i < gauge.nodes.size(); ++i) {
    Vector3d direction = Vector3d::Zero();
    direction.head(components) = gauge.values.segment(static_cast<Index>(i) * components, components);
    sum += row(gauge.nodes[i], direction);
  }
  add_row(sum / gauge.values.norm());
}

void RigidMotions::add_row(const RowVectorXd& row) {
  gram_.noalias() += row.transpose() * row;
}

/// Component along `direction` of a node's motion in every mode of its body.
RowVectorXd RigidMotions::row(NodeIndex node, const Vector3d& direction) const {
  RowVectorXd r = RowVectorXd::Zero(columns());
  const int body = bodies_.of(node);
  if (body < 0)
    return r;
  const Index first = static_cast<Index>(body) * modes_;
  if (modes_ == 1) {
    r[first] = direction[1];
    return r;
  }
  const int components = model_.dofs.components;
  r.segment(first, components) = direction.head(components).transpose();
  const Vector3d arm = (model_.mesh.points[static_cast<std::size_t>(node)] - centre_) / size_;
  const Vector3d turn = arm.cross(direction);
  if (components == 3)
    r.segment(first + 3, 3) = turn.transpose();
  else
    r[first + 2] = turn[2];
  return r;
}

void RigidMotions::add_point(const contact::Zone& zone, const contact::SlavePoint& point,
                             const contact::Pair& pair, const contact::Configuration& configuration) {
  const auto kinematics = contact::evaluate_kinematics(zone, point, pair, configuration);
  const int directions = zone.settings.friction > 0 || zone.settings.tie ? zone.space_dimension : 1;
  for (int a = 0; a < directions; ++a) {
    const Vector3d direction = a == 0 ? kinematics.normal : Vector3d(kinematics.tangents.col(a - 1));
    RowVectorXd relative = RowVectorXd::Zero(columns());
    for (std::size_t i = 0; i < kinematics.stencil.nodes.size(); ++i)
      relative +=
          kinematics.stencil.weights[static_cast<Index>(i)] * row(kinematics.stencil.nodes[i], direction);
    add_row(relative);
  }
}

RigidMotion RigidMotions::motion_of(int body, const VectorXd& values) const {
  RigidMotion motion{.body = body};
  const int components = model_.dofs.components;
  if (modes_ == 1)
    motion.shift[1] = values[0];
  else {
    motion.shift.head(components) = values.head(components);
    if (components == 3)
      motion.turn = values.tail(3);
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
