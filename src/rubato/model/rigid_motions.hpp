// SPDX-License-Identifier: LGPL-3.0-or-later
/// The rigid motions of the bodies of a model, and what resists them: supports, springs, contact.
#pragma once

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/pairing.hpp"
#include "rubato/model/bodies.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/gauge.hpp"
#include "rubato/model/springs.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rubato::model {

/// A rigid motion of one body, small: every place x moves by shift + turn × (x − centre)/size, centre and
/// size of the whole model.
struct RigidMotion {
  int body = -1;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
};

class RigidMotions {
public:
  explicit RigidMotions(const Model& model);

  /// Supports, relations, springs, connectors and gauges.
  void add_supports();
  /// The same without soft springs.
  void add_firm_supports();
  /// Contact where surfaces face one another before the first step: across, with friction also along.
  void add_contact();

  /// By body: whether what was added leaves it no rigid motion, each body looked at alone, but for bodies
  /// that relations tie.
  std::vector<char> held() const;
  /// How each body that is not held can move, looked at alone.
  std::vector<RigidMotion> loose_alone() const;
  /// How a body can still move that nothing holds, all bodies looked at together; none when all are held. Of
  /// several such bodies the one that moves most is given.
  std::vector<RigidMotion> loose() const;
  /// Nodes without cells that nothing holds, all bodies and nodes looked at together.
  std::vector<mesh::NodeIndex> loose_nodes() const;

  /// Every motion that a body has if nothing resists.
  std::vector<RigidMotion> all_of(int body) const;
  /// Independent motions that span the same, of one body, turns about axes of their own first.
  std::vector<RigidMotion> told_apart(std::span<const RigidMotion> motions) const;
  /// How far a motion takes a place of its body.
  Eigen::Vector3d at(const RigidMotion& motion, const Eigen::Vector3d& place) const;

  const Bodies& bodies() const { return bodies_; }

private:
  Eigen::Index columns_of_bodies() const { return static_cast<Eigen::Index>(bodies_.count()) * modes_; }
  Eigen::Index columns() const {
    return columns_of_bodies() + static_cast<Eigen::Index>(lone_.size()) * model_.dofs.components;
  }
  void add_dof(int dof);
  void add_connector(const Connector& connector);
  void add_terms(const std::vector<constraint::Term>& terms);
  void add_relation(const constraint::DependentDof& dependent);
  void add_gauge(const Gauge& gauge);
  void add_row(const Eigen::VectorXd& row);
  Eigen::VectorXd row(mesh::NodeIndex node, const Eigen::Vector3d& direction) const;
  void add_point(const contact::Zone& zone, const contact::SlavePoint& point, const contact::Pair& pair,
                 const contact::Configuration& configuration);
  void carry_gap(const contact::Kinematics& kinematics, const Eigen::Vector3d& direction,
                 Eigen::VectorXd& relative) const;
  int body_of_dof(int dof) const;
  Eigen::VectorXd row_of_dof(int dof) const;
  Eigen::MatrixXd block_of(int body) const;
  Eigen::MatrixXd motions_left(int body) const;
  RigidMotion motion_of(int body, const Eigen::VectorXd& values) const;

  const Model& model_;
  Bodies bodies_;
  std::vector<mesh::NodeIndex> lone_; ///< nodes without cells that supports leave free, ascending
  Eigen::Index modes_;
  Eigen::Vector3d centre_;
  double size_ = 1;
  bool ties_bodies_ = false; ///< whether a relation concerns several bodies
  Eigen::MatrixXd gram_;     ///< Σ rowᵀ row over all that resists, columns the motions of all bodies
};

/// "along x", "along (0.6, 0.8, 0)", "by turning about z": how messages name a motion.
std::string direction_text(const RigidMotion& motion);

/// "the body 'upper' (of node N1 (0, 5))", or "the body of node N1 (0, 5)": how messages name a body.
std::string body_text(const Model& model, const Bodies& bodies, int body);

/// A body and what has to hold it.
struct LooseBody {
  mesh::NodeIndex node = -1; ///< its first
  std::string against;       ///< "along x, along y, against turning about z"
};

/// The bodies that supports and firm springs leave a rigid motion.
std::vector<LooseBody> loose_bodies(const Model& model);

/// Nodes of the bodies that supports and firm springs leave a rigid motion, ascending: in a static run
/// contact has to hold them.
std::vector<mesh::NodeIndex> free_body_nodes(const Model& model);

} // namespace rubato::model
