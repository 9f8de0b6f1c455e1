// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs, connectors and point masses of a model.
#pragma once

#include "rubato/constraint/reduction.hpp"
#include "rubato/core/linear_table.hpp"
#include "rubato/domain/line_springs.hpp"
#include "rubato/mesh/mesh.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rubato::model {

/// A spring from a dof to the ground, slack at displacement 0.
struct Spring {
  int dof = 0;
  double stiffness = 0; ///< [force/length] > 0
  bool soft = false;    ///< too soft to say where a body in contact is (model/soft_springs.hpp)
};

/// The way between the two ends of a connector that acts along it.
struct ConnectorWay {
  std::string on, to; ///< as the study calls the ends; `to`: none of an anchor
  Eigen::Vector3d undeformed = Eigen::Vector3d::Zero(); ///< from one to the other
  std::array<std::vector<constraint::Term>, 3> moved;   ///< by direction, of the other against the one
};

/// Forces along the current way between two ends.
struct LineLaws {
  domain::LineLaw spring;  ///< by the elongation
  domain::LineLaw dashpot; ///< by its rate
};

/// A spring, a dashpot and a mass side by side on the displacement Σ row · u. Where tables give forces, the
/// numbers are their steepest slopes, which matrices have.
struct Connector {
  std::vector<constraint::Term> row;
  double stiffness = 0; ///< [force/length]
  double damping = 0;   ///< [force · time/length]
  double mass = 0;      ///< [mass]
  std::optional<LinearTable> force = {};
  std::optional<LinearTable> damper = {};
  std::optional<ConnectorWay> way = {}; ///< whose undeformed direction `row` has
  /// Laws of a connector that acts along the current way; its other numbers are 0, its other tables empty.
  std::optional<LineLaws> line = {};

  /// Whether displacements along the undeformed direction have forces.
  bool resists() const { return stiffness > 0 || (line && line->spring.acts()); }
};

struct PointMass {
  mesh::NodeIndex node = -1;
  double mass = 0;
};

} // namespace rubato::model
