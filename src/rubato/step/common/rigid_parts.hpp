// SPDX-License-Identifier: LGPL-3.0-or-later
/// The rigid parts of motions, on which internal forces do no work.
///
/// K r = 0 for the rigid motions r of a body that neither springs nor gauges resist. K u as computed has the
/// rounding of |K||u| in it, which has a resultant. Where a body moves far beside its deformation the work of
/// that resultant exceeds the rounding of all other works: docs/theory/energy.md, "Rigid motions". A body is
/// here what cells of a constant stiffness connect. Forces of other cells are sums of stresses, in balance in
/// each cell for itself, and have no such resultant.
#pragma once

#include "rubato/model/bodies.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/gauge.hpp"

#include <Eigen/Core>

#include <array>
#include <map>
#include <vector>

namespace rubato::step {

class RigidParts {
public:
  /// The model must outlive this.
  explicit RigidParts(const model::Model& model);

  /// Zᵀ x, a column a body: Z has the body's rigid motions about its own centre in its columns. Of forces:
  /// their resultants and, over the body's size, moments.
  Eigen::MatrixXd resultants(const Eigen::VectorXd& x) const;
  /// r·f by the resultants of u and f: r is the rigid motion nearest to u at the nodes of each body, of those
  /// that the stiffness does not resist. [force · length]
  double work(const Eigen::MatrixXd& motion, const Eigen::MatrixXd& force) const;

  /// A node of a body, with its arm from the body's centre over the body's size.
  struct Lever {
    int body = 0;
    int dof = 0; ///< the node's first
    std::array<double, 3> arm{};
  };

private:
  struct Body {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    double size = 0;
    bool held = false;   ///< by supports that do not move
    Eigen::MatrixXd fit; ///< r = Z fit Zᵀ u
  };
  /// At most 3 components and 6 modes.
  using Modes = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 3, 6>;

  Modes modes_at(mesh::NodeIndex node) const;
  static Eigen::VectorXd row_of(const Modes& modes, int row);
  void place_bodies();
  void find_held();
  void collect_levers();
  std::map<int, Eigen::VectorXd> rows_of(const model::Gauge& gauge) const;
  std::vector<Eigen::MatrixXd> unresisted() const;
  void fit_bodies();

  const model::Model* model_;
  model::Bodies number_;
  std::vector<Body> bodies_;
  std::vector<Lever> levers_;
};

} // namespace rubato::step
