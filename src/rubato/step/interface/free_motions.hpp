// SPDX-License-Identifier: LGPL-3.0-or-later
/// Newton's iterations along the rigid motions of bodies that only contact holds.
///
/// Contact is linearised with the surfaces' operators held. What these contribute where a body turns or
/// slides as a whole is small beside the stiffness of a held body. A free body has nothing else there, but
/// its weak springs: where all its points slide, a turn is resisted by the change of geometry alone. So that
/// part is measured: Newton's correction c(x) of the surface's motion is computed at x and at x + ε mₖ, mₖ
/// the rigid motions, and is taken as linear between. The next iterate is x + Σ βₖ ε mₖ + c(x) + Σ βₖ (cₖ −
/// c(x)), with β such that nothing of the last two terms is a rigid motion. With operators that do not
/// change, cₖ − c = −ε mₖ, and that is Newton's iterate itself.
#pragma once

#include "rubato/linalg/pivoted_qr.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/step/interface/compliance.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::step {

/// The motions that supports and firm springs leave to the bodies of a model, on their surfaces: a row an
/// interface dof, a column a motion whose largest entry is 1. In axisymmetry these bodies also have the turn
/// of their section. Motions without a place on a surface are left out.
Eigen::MatrixXd free_motions(const model::Model& model, const Compliance& compliance);

class FreeMotions {
public:
  /// None where the columns depend on one another.
  explicit FreeMotions(Eigen::MatrixXd motions);

  Eigen::Index count() const { return motions_.cols(); }
  auto operator[](Eigen::Index k) const { return motions_.col(k); }
  /// β by motion. `correction`: c(x); `shifted`: a column cₖ each. Nothing comes back where the motions are
  /// not told apart by their corrections.
  std::optional<Eigen::VectorXd> shares(const Eigen::VectorXd& correction,
                                        const Eigen::MatrixXd& shifted) const;

private:
  Eigen::MatrixXd motions_;
  std::optional<linalg::PivotedQr> fit_; ///< of the motions to others; none without motions
};

} // namespace rubato::step
