// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact that is closed in the undeformed bodies, as linear relations between displacements.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <string>
#include <vector>

namespace rubato::modes {

/// What becomes of points that touch undeformed: nothing, or they are held together in every direction, or
/// along the normal only. Ties hold in any case.
enum class Contact { open, stuck, sliding };

struct ClosedContact {
  model::SparseMatrix relations;     ///< Cᵀ u = 0: a row for each dof, a column for each relation
  std::vector<std::string> notes;    ///< of each zone, how many of its points touch
  std::vector<std::string> warnings; ///< of each zone whose friction is left out
};

/// Σ w_i u_i · d = 0 for the weights of each point that touches (contact/stencil.hpp) and the directions d
/// that are held. Points between the nodes are averaged by the shape functions of the slave's nodes, as the
/// multipliers of contact are: one relation each would leave the surfaces no deformation.
ClosedContact closed_contact(const model::Model& model, Contact contact);

} // namespace rubato::modes
