// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinematics.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/build.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

namespace rubato::model {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::Vector3d;
using mesh::NodeIndex;

/// Singular values below this part of the largest belong to motions nothing holds.
constexpr double rank_tolerance = 1e-9;

/// Rows of what supports, springs and contact resist, columns the rigid motions of all bodies.
class Holds {
public:
  explicit Holds(const Model& model)
      : model_(model), bodies_(model.mesh, model.bulk),
        modes_(model.study.physics == deck::Physics::axisymmetric ? 1
               : model.dofs.components == 3                       ? 6
                                                                  : 3) {
    Vector3d low = model.mesh.points.front();
    Vector3d high = low;
    for (const auto& point : model.mesh.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    centre_ = (low + high) / 2;
    size_ = (high - low).norm();
  }

  void add_supports() {
    for (const auto& constraint : model_.constraints)
      add_dof(constraint.dof);
    for (const auto& spring : model_.springs)
      add_dof(spring.dof);
  }

  void add_contact() {
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

  /// A body that can still move, or −1.
  int loose_body() const {
    MatrixXd all = MatrixXd::Zero(std::max<Index>(static_cast<Index>(rows_.size()), columns()), columns());
    for (std::size_t i = 0; i < rows_.size(); ++i)
      all.row(static_cast<Index>(i)) = rows_[i];
    const MatrixXd gram = all.transpose() * all;
    const Eigen::JacobiSVD<MatrixXd> svd(gram, Eigen::ComputeFullV);
    const auto& values = svd.singularValues();
    if (values[columns() - 1] > rank_tolerance * values[0])
      return -1;
    Index largest = 0;
    svd.matrixV().col(columns() - 1).cwiseAbs().maxCoeff(&largest);
    return static_cast<int>(largest / modes_);
  }

  NodeIndex first_node(int body) const { return bodies_.first_node(body); }

private:
  Index columns() const { return static_cast<Index>(bodies_.count()) * modes_; }

  void add_dof(int dof) {
    const auto node = model_.dofs.nodes[static_cast<std::size_t>(dof / model_.dofs.components)];
    Vector3d direction = Vector3d::Zero();
    direction[dof % model_.dofs.components] = 1;
    rows_.push_back(row(node, direction));
  }

  /// Component along `direction` of a node's motion in every mode of its body.
  RowVectorXd row(NodeIndex node, const Vector3d& direction) {
    RowVectorXd r = RowVectorXd::Zero(columns());
    const Index first = static_cast<Index>(bodies_.of(node)) * modes_;
    const Vector3d arm = (model_.mesh.points[static_cast<std::size_t>(node)] - centre_) / size_;
    if (modes_ == 1) {
      r[first] = direction[1];
      return r;
    }
    const int components = model_.dofs.components;
    for (int i = 0; i < components; ++i)
      r[first + i] = direction[i];
    const Vector3d turn = arm.cross(direction);
    if (components == 3)
      r.segment(first + 3, 3) = turn.transpose();
    else
      r[first + 2] = turn[2];
    return r;
  }

  void add_point(const contact::Zone& zone, const contact::SlavePoint& point, const contact::Pair& pair,
                 const contact::Configuration& configuration) {
    const auto kinematics = contact::evaluate_kinematics(zone, point, pair, configuration);
    const int directions = zone.settings.friction > 0 ? zone.space_dimension : 1;
    for (int a = 0; a < directions; ++a) {
      const Vector3d direction = a == 0 ? kinematics.normal : Vector3d(kinematics.tangents.col(a - 1));
      RowVectorXd relative = RowVectorXd::Zero(columns());
      for (std::size_t i = 0; i < kinematics.nodes.size(); ++i)
        relative += kinematics.shape[static_cast<Index>(i)] * row(kinematics.nodes[i], direction);
      rows_.push_back(relative);
    }
  }

  const Model& model_;
  Bodies bodies_;
  Index modes_;
  Vector3d centre_;
  double size_ = 1;
  std::vector<RowVectorXd> rows_;
};

} // namespace

void check_supported(const Model& model, std::vector<Fault>& faults) {
  Holds holds(model);
  holds.add_supports();
  holds.add_contact();
  const int loose = holds.loose_body();
  if (loose < 0)
    return;
  faults.push_back(
      {model.study.time.at,
       fmt::format(
           "the body of node {} is not held: it can move as a rigid body, and a static run has no inertia; "
           "expected supports, springs, or contact with something that is held",
           node_label(model.mesh, holds.first_node(loose)))});
}

} // namespace rubato::model
