// SPDX-License-Identifier: LGPL-3.0-or-later
/// Natural frequencies and shapes of a model (docs/theory/modes.md).
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/modes/closed_contact.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::modes {

struct ModeRequest {
  int number = 10; ///< ≥ 1, of the lowest ones
  Contact contact = Contact::open;
};

/// Modes by ascending frequency; all there are when these are fewer than asked for.
struct Modes {
  Eigen::VectorXd frequencies; ///< [1/time] ≥ 0; exactly 0 of motions that nothing resists
  /// A row for each dof and a column for each mode, 0 where supports hold; the longest displacement of a node
  /// is 1.
  Eigen::MatrixXd shapes;
  Eigen::VectorXd generalised_masses; ///< φ·M φ [mass]
  std::vector<int> directions;        ///< along which all bodies can move as one: of x, y, z (0, 1, 2)
  /// (φ·M r)²/(φ·M φ) as part of r·M r, r the unit translation of every node, held or not: a row for each
  /// mode and a column for each direction.
  Eigen::MatrixXd effective_masses;
  double mass = 0;           ///< r·M r [mass]; in axisymmetric physics of all around
  Eigen::VectorXd residuals; ///< relative, as linalg::EigenModes has them
  bool converged = false;    ///< likewise
  std::vector<std::string> notes;
  std::vector<std::string> warnings; ///< where they are not those of the study
};

/// Of a model that modal_study's study gives: small vibrations about the undeformed bodies, K φ = ω² M φ,
/// with supports at rest. Throws InputError when nothing can move, or moves without mass;
/// std::invalid_argument for a number below 1 or a model without masses.
Modes modes_of(const model::Model& model, const ModeRequest& request);

} // namespace rubato::modes
