// SPDX-License-Identifier: LGPL-3.0-or-later
/// What all steps of one length share: the effective matrix, factored or set up for iterations once, and the
/// contact coefficients that follow from it.
#pragma once

#include "rubato/contact/discretisation.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"
#include "rubato/step/common/slope_changes.hpp"
#include "rubato/step/interface/compliance.hpp"
#include "rubato/step/state.hpp"
#include "rubato/time/scheme.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace rubato::step {

struct CondensedScratch;

/// Between two components of one node.
struct NodeSpring {
  int row = 0; ///< dofs
  int column = 0;
  double stiffness = 0; ///< [force/length]
};

/// The effective matrix A = m M + c C + k K of one step length, on free dofs. K is the domain's tangent: of a
/// linear domain A and its factor serve every step of that length, of others they are renewed
/// (common/bulk_tangent.hpp).
///
/// Bodies that only contact holds have weak springs in it, so that it can be factored. They act on the
/// correction of an iteration, never on the motion itself: iterations with them are the proximal point
/// method (Rockafellar 1976), which ends where their forces are gone.
struct EffectiveSystem {
  double step = 0;
  time::StepCoefficients coefficients;
  model::SparseMatrix matrix;   ///< of several ranks this one's part (linalg/ranked_matrix.hpp)
  double entries = 0;           ///< of those of all ranks
  Tangent tangent;              ///< K that the matrix is made of, of nonlinear domains; else null
  Tangent factored;             ///< the same of the factor
  double weak_spring = 0;       ///< on each free unknown of bodies that only contact holds [force/length]
  bool has_free_bodies = false; ///< whether there are such springs
  std::vector<NodeSpring> held; ///< where contact holds bodies that are not stable without (held_surface.hpp)
  Eigen::VectorXd diagonal;     ///< of every dof, constrained ones included
  std::vector<contact::ZoneCoefficients> zones;
  std::vector<contact::Discretisation> discretisations; ///< of every zone, kept from one iterate to the next
  /// The factored matrix, or what solves with it by iterations; nothing when every iteration solves the whole
  /// system.
  std::unique_ptr<Compliance> compliance;
  SlopeChanges slopes; ///< of springs by tables; empty when every iteration solves the whole system
  std::shared_ptr<CondensedScratch> scratch; ///< of condensed steps with this matrix
};

/// Factors the matrix, or sets conjugate gradients up where the study's solver is iterative, unless the
/// solver is full or the matrix is not positive definite, as when only contact holds a body. Before that
/// `tell_memory` hears what the factor needs [bytes], and may wait until others have given memory back;
/// throws InputError when it does not fit into what is left then, and where an iterative solver is missing or
/// does not converge.
/// Of a nonlinear domain the matrix is that of its initial tangent.
EffectiveSystem make_effective_system(
    const model::Model& model, const time::Scheme& scheme, double step,
    const std::function<void(std::size_t)>& tell_memory = [](std::size_t) {});

/// Makes the matrix anew with a tangent of the domain. Its factor, where there is one, stays what it is.
/// Coefficients of contact stay.
void renew_matrix(EffectiveSystem& system, const model::Model& model, const Tangent& tangent);

/// The same with the factor; where every iteration solves the whole system there is none. False when the
/// matrix is not positive definite: then the factor means nothing until there is another one.
bool renew(EffectiveSystem& system, const model::Model& model, const Tangent& tangent);

/// Puts springs into the matrix of a nonlinear domain in place of those it has, from the next renewal on;
/// none: takes them out.
void hold(EffectiveSystem& system, std::vector<NodeSpring> springs);

/// Whether they have the same values on all ranks of the model, or both none.
bool same_values(const model::Model& model, const Tangent& a, const Tangent& b);

Tangent values_of(const model::SparseMatrix& tangent);
/// The matrix with these values.
model::SparseMatrix matrix_of(const model::Model& model, const Tangent& tangent);

/// The residual that iterations are to come below, if they can: what weak springs still carry displaces whole
/// bodies.
double wanted_residual(const EffectiveSystem& system, double tolerance);

} // namespace rubato::step
